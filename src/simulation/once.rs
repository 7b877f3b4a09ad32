//! A problem without time: its operations, once.

use std::time::{Duration, Instant};

use glam::DVec2;

use super::{Outcome, Run, SimulationError, State, Stop};
use crate::engine::{Clock, Data, EngineError};
use crate::known::Known;
use crate::snapshot::{Derivatives, Snapshot};
use crate::step::Buffer;

impl Run<'_> {
    /// A problem without time: its operations, once.
    pub(super) fn once(mut self, ladder: [u64; 3], setup: Duration) -> Result<Outcome, SimulationError> {
        let started = Instant::now();
        let clock = self.unit_clock();
        for &operation in &self.scene.plan.kick {
            self.engine.apply(operation, &clock)?;
        }
        let stepping = started.elapsed();
        let iterations = u64::from(self.engine.solve_info().iterations);
        let snapshot = match self.scene.plan.form {
            Some(_) => self.snapshot(0.0)?,
            None => self.derivatives()?,
        };
        if let Some((field, point)) = not_finite(&snapshot) {
            let place = self.scene.cloud.position[point];
            let field = field.to_owned();
            return Err(SimulationError::NotFinite { field, point, x: place.x, y: place.y });
        }
        let fallbacks = u64::from(self.engine.advance(0, &clock)?.fallbacks);
        let warnings = self.warnings;
        let (stop, state) = (Stop::End, State::default());
        Ok(Outcome { stop, steps: 0, snapshot, state, fallbacks, iterations, ladder, setup, stepping, warnings })
    }

    /// The clock by which the tolerance of a pressure solve is relative to the root mean square of its source.
    fn unit_clock(&self) -> Clock {
        let Some(known) = Known::of(&self.scene.case) else { return self.scene.clock(1.0) };
        let cloud = &self.scene.cloud;
        let square: f64 = cloud.position.iter().map(|&place| known.laplacian(place).powi(2)).sum();
        let rms = (square / cloud.len() as f64).sqrt();
        self.scene.clock((self.scene.constants.density / rms).sqrt())
    }

    /// What the operators made of a known field.
    fn derivatives(&mut self) -> Result<Snapshot, EngineError> {
        let points = self.scene.sizes.points;
        let mut read = |buffer: Buffer| match self.engine.read(buffer) {
            Ok(Data::Real(values)) => Ok(values),
            Ok(Data::Index(_)) | Err(EngineError::Absent(_)) => Ok(Vec::new()),
            Err(error) => Err(error),
        };
        let mut value = read(Buffer::FieldAverage)?;
        if value.is_empty() {
            value = read(Buffer::Field)?;
        }
        let mut laplacian = read(Buffer::FieldLaplacian)?;
        let gradient = read(Buffer::FieldGradient)?.chunks_exact(2).take(points).map(DVec2::from_slice).collect();
        value.truncate(points);
        laplacian.truncate(points);
        let derivatives = Some(Derivatives { value, gradient, laplacian });
        Ok(Snapshot { position: self.scene.cloud.position.clone(), derivatives, ..Snapshot::default() })
    }
}

/// The first value of a snapshot that is no finite number: its column and its point.
fn not_finite(snapshot: &Snapshot) -> Option<(&str, usize)> {
    let columns = snapshot.columns();
    columns.iter().find_map(|column| {
        let found = |point| column.at(point).find(|(_, value)| !value.is_finite()).map(|(name, _)| (name, point));
        (0..column.len()).find_map(found)
    })
}
