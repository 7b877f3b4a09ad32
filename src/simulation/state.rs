//! What a run goes on from as if it had not been away: its place in time, and the arrays that a step reads before it
//! writes them (`Plan::state`).

use serde::{Deserialize, Serialize};

use crate::engine::{Data, Engine, EngineError, NonFinite};
use crate::scene::Scene;
use crate::step::Buffer;

/// Where a run stands, after a row of diagnostics.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Progress {
    pub step: u64,
    /// s
    pub time: f64,
    /// The last step, s.
    pub dt: f64,
    /// Fastest fluid, m/s: the next step is chosen by it.
    pub speed: f64,
    /// Longest step that viscosity and diffusion allow, s; none without.
    pub viscous: Option<f64>,
    /// Rows in a row that were steady.
    pub steady_rows: u32,
    /// Times that the run went back and on with half the step.
    pub halvings: u32,
    /// Of points that move: rows since it did.
    #[serde(default)]
    pub calm_rows: u32,
    /// Solves that were handed to the direct solver.
    pub fallbacks: u64,
    /// Pressure iterations of all steps.
    pub iterations: u64,
    pub warnings: Vec<String>,
    /// Of points that move.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub motion: Option<Motion>,
}

/// What points that move are held against, and how many of their frames there are.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Motion {
    /// Area that the fluid covered at the start, m^2.
    pub area: f64,
    /// Energy at the start above that of all fluid on the floor, m^4/s^2.
    pub energy: f64,
    /// Frames that have been kept.
    pub frames: u32,
}

/// Rows after which points that move are given back a step twice as long: what went wrong was a splash, and is over.
const CALM: u32 = 20;

impl Progress {
    /// Counts a row in which nothing went wrong.
    pub(super) fn calm(&mut self) {
        self.calm_rows = if self.halvings > 0 { self.calm_rows + 1 } else { 0 };
        if self.calm_rows == CALM {
            (self.halvings, self.calm_rows) = (self.halvings - 1, 0);
        }
    }

    /// What no run writes is refused.
    pub fn check(&self) -> Result<(), &'static str> {
        let positive = |value: f64| value.is_finite() && value > 0.0;
        match self {
            _ if !(self.time.is_finite() && self.time >= 0.0) => Err("its time is none"),
            _ if !positive(self.dt) => Err("its time step is none"),
            _ if !(self.speed.is_finite() && self.speed >= 0.0) => Err("its speed is none"),
            _ if !self.viscous.is_none_or(positive) => Err("its viscous limit is none"),
            Self { motion: Some(Motion { area, energy, .. }), .. } if !(positive(*area) && energy.is_finite()) => {
                Err("its first area or energy is none")
            }
            _ => Ok(()),
        }
    }
}

/// A run between two steps.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct State {
    pub progress: Progress,
    /// In the order of `Plan::state`, padding and all.
    pub arrays: Vec<(Buffer, Data)>,
}

impl State {
    /// Reads the arrays from an engine.
    pub fn read(scene: &Scene, engine: &mut dyn Engine, progress: &Progress) -> Result<Self, EngineError> {
        let mut state = Self { progress: progress.clone(), arrays: Vec::new() };
        state.renew(scene, engine)?;
        Ok(state)
    }

    /// Reads them anew, into the memory of a state of the same scene; the first entry that is no finite number.
    pub fn renew(&mut self, scene: &Scene, engine: &mut dyn Engine) -> Result<Option<NonFinite>, EngineError> {
        if self.arrays.is_empty() {
            let empty = |buffer: Buffer| (buffer, Data::empty(buffer.element()));
            self.arrays = scene.plan.state().into_iter().map(empty).collect();
        }
        let lost = engine.read_all(&mut self.arrays)?;
        Ok(lost.map(|(buffer, entry)| placed(scene, buffer, entry)))
    }

    /// Writes the arrays to an engine, whose setup is done.
    pub fn write(&self, engine: &mut dyn Engine) -> Result<(), EngineError> {
        self.arrays.iter().try_for_each(|(buffer, data)| engine.write(*buffer, data))
    }

    pub fn array(&self, buffer: Buffer) -> Option<&Data> {
        self.arrays.iter().find(|(known, _)| *known == buffer).map(|(_, data)| data)
    }

    /// The first entry that is no finite number.
    pub fn non_finite(&self, scene: &Scene) -> Option<NonFinite> {
        let lost = |(buffer, data): &(Buffer, Data)| data.first_non_finite().map(|entry| placed(scene, *buffer, entry));
        self.arrays.iter().find_map(lost)
    }
}

/// The point of an entry.
fn placed(scene: &Scene, buffer: Buffer, entry: usize) -> NonFinite {
    let width = (buffer.length(&scene.sizes) / scene.padded()).max(1);
    NonFinite { buffer, point: (entry / width).min(scene.sizes.points - 1) }
}
