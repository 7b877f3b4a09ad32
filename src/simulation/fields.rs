//! The fields of a run as they are reported.

use glam::DVec2;

use super::{Run, State};
use crate::engine::{Data, EngineError};
use crate::scene::Scene;
use crate::snapshot::Snapshot;
use crate::step::{Buffer, Points, Rung};

impl Run<'_> {
    /// Points whose fit was widened, is of a lower order, is the nearest value.
    pub(super) fn ladder(&mut self) -> Result<[u64; 3], EngineError> {
        let mut tally = [0; 3];
        let rung = Buffer::Rung(Points::Standing);
        if self.scene.plan.buffers().contains(&rung)
            && let Data::Index(rungs) = self.engine.read(rung)?
        {
            for &rung in rungs[..self.scene.sizes.points].iter().filter(|&&rung| rung > 0) {
                tally[match rung {
                    Rung::NEAREST => 2,
                    rung if rung > Rung::WIDER.len() as u32 => 1,
                    _ => 0,
                }] += 1;
            }
        }
        Ok(tally)
    }

    /// The fields as they are reported: the divergence-free velocity, the pressure relative to its mean.
    pub(super) fn snapshot(&mut self, time: f64) -> Result<Snapshot, EngineError> {
        let Self { scene, engine, .. } = self;
        snapshot(scene, time, &mut |buffer| engine.read(buffer))
    }

    /// The same of a state, whatever has become of the engine since; `time` is its time, s.
    pub(super) fn snapshot_of(&self, state: &State, time: f64) -> Result<Snapshot, EngineError> {
        let of = |buffer| state.array(buffer).cloned().ok_or(EngineError::Absent(buffer));
        snapshot(self.scene, time, &mut |buffer| of(buffer))
    }
}

fn snapshot(
    scene: &Scene,
    time: f64,
    read: &mut dyn FnMut(Buffer) -> Result<Data, EngineError>,
) -> Result<Snapshot, EngineError> {
    // Of points that move the fluid's alone: walls of points stand where they stood.
    let moves = scene.plan.moves();
    let points = if moves { scene.sizes.interior } else { scene.sizes.points };
    let mut velocity = vec![DVec2::ZERO; points];
    if scene.plan.flows
        && let Data::Real(values) = read(Buffer::Projected)?
    {
        velocity = values[..2 * points].chunks_exact(2).map(DVec2::from_slice).collect();
    }
    let mut pressure = vec![0.0; points];
    if scene.plan.form.is_some()
        && let Data::Real(values) = read(Buffer::Pressure)?
    {
        let singular = scene.constants.singular;
        let mean = if singular { values[..points].iter().sum::<f64>() / points as f64 } else { 0.0 };
        pressure = values[..points].iter().map(|p| p - mean).collect();
    }
    let mut carried = Vec::new();
    for &field in &scene.plan.carried {
        if let Data::Real(mut values) = read(Buffer::Carried(field))? {
            values.truncate(points);
            carried.push((scene.case.field_name(field), values));
        }
    }
    let position = match moves.then(|| read(Buffer::Position(Points::Standing))).transpose()? {
        Some(Data::Real(values)) => values[..2 * points].chunks_exact(2).map(DVec2::from_slice).collect(),
        _ => scene.cloud.position.clone(),
    };
    Ok(Snapshot { time, position, velocity, pressure, carried, derivatives: None })
}
