//! One run: steps until the end, a steady state, a request to stop, or trouble that shorter steps do not mend.

mod change;
mod fields;
mod guard;
mod length;
mod moving;
mod once;
mod prices;
mod row;
mod state;

use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use crate::case::MOST_STEPS;
use crate::engine::{Engine, EngineError};
use crate::measure::{MeasureError, Probe};
use crate::motion;
use crate::scene::Scene;
use crate::snapshot::Snapshot;
pub use guard::{Limit, Trouble};
pub use prices::{Prices, prices};
use row::Row;
pub use state::{Motion, Progress, State};

/// One row of `diagnostics.csv`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Diagnostics {
    pub step: u64,
    /// s
    pub time: f64,
    /// s
    pub dt: f64,
    /// Integral of `|u|^2 / 2` over the domain, m^4/s^2.
    pub kinetic_energy: f64,
    /// m/s
    pub max_speed: f64,
    /// Root mean square of `div u` over the points, 1/s.
    pub divergence: f64,
    /// Iterations of the pressure solve of this step.
    pub pressure_iterations: u32,
    /// Recomputed residual of the pressure solve of this step, as the volume change it leaves, `|div u| dt` (rms).
    pub residual: f64,
    /// Largest rate of change of a velocity since the last row, m/s^2.
    pub change: f64,
    /// What kept the step from being longer.
    pub limit: Limit,
    /// Iterations of the solve of implicit viscosity of this step; a column of its own where there is one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub viscous_iterations: Option<u32>,
    /// Forces, differences and fluxes, in the order of [`Probe::of_case`]; columns of their own.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub probes: Vec<f64>,
}

/// Told of a run as it goes: draws the bar, writes the rows, asks it to stop.
pub trait Observer {
    /// A row of diagnostics is ready.
    fn report(&mut self, row: &Diagnostics);
    /// A row about points that move is ready.
    fn moved(&mut self, _: &motion::Row) {}
    /// A frame of points that move is to be kept.
    fn frame(&mut self, _: &Snapshot) {}
    /// True once the run is to stop after the steps it is in.
    fn stop_requested(&self) -> bool;
    /// The run can go on from here: at its beginning, and after each row that was reported.
    fn keep(&mut self, _: &State) {}
}

/// Watches nothing.
impl Observer for () {
    fn report(&mut self, _: &Diagnostics) {}

    fn stop_requested(&self) -> bool {
        false
    }
}

/// Why a run ended.
#[derive(Debug, Clone, PartialEq)]
pub enum Stop {
    /// No velocity changed faster than `time.steady`.
    Steady,
    /// `time.end` was reached.
    End,
    /// The observer asked.
    Interrupted,
    /// Something went wrong in the steps that ended with this one, and again with every shorter step that was tried.
    Trouble { trouble: Trouble, step: u64 },
}

/// What a run gave.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    pub stop: Stop,
    pub steps: u64,
    /// The fields at the end; after trouble, at the last row of diagnostics before it.
    pub snapshot: Snapshot,
    /// What the run could go on from: its state at the last row of diagnostics that was asked for. Empty of a problem
    /// without time.
    pub state: State,
    /// Solves that were handed to the direct solver.
    pub fallbacks: u64,
    /// Pressure iterations of all steps.
    pub iterations: u64,
    /// Points whose fit was widened, is of a lower order, is the nearest value.
    pub ladder: [u64; 3],
    /// Wall-clock time of the setup operations, and of the steps with their reports.
    pub setup: Duration,
    pub stepping: Duration,
    pub warnings: Vec<String>,
}

/// Why a run could not be made or go on.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SimulationError {
    #[error(transparent)]
    Engine(#[from] EngineError),
    #[error(transparent)]
    Measure(#[from] MeasureError),
    #[error(
        "time.step = {step}: at {speed} m/s points move {courant:.2} spacings a step; \
         allowed with the forward remap: at most 1"
    )]
    TooFastForForward { step: f64, speed: f64, courant: f64 },
    #[error("{field} of point {point} at ({x}, {y}) m is not finite: its numbers are beyond those of the precision")]
    NotFinite { field: String, point: usize, x: f64, y: f64 },
    #[error(
        "time.end = {end:e}: steps of at most {longest:e} s ({limit}) make more than {MOST_STEPS:e} of them; \
         allowed: a larger cloud.spacing, a smaller effects.viscosity.kinematic, or a sooner end"
    )]
    TooManySteps { end: f64, longest: f64, limit: Limit },
}

/// Rows in a row that must be steady.
const STEADY_ROWS: u32 = 2;

/// Runs `scene` on `engine`, whose arrays hold what [`Scene::initial`] says.
pub fn simulate(
    scene: &Scene,
    engine: &mut dyn Engine,
    observer: &mut dyn Observer,
) -> Result<Outcome, SimulationError> {
    Run::new(scene, engine, observer).run(None)
}

/// Goes on with a run of `scene` from a state that it was in; the rest is as in [`simulate`], and so are the numbers, to the
/// last bit.
pub fn resume(
    scene: &Scene,
    engine: &mut dyn Engine,
    observer: &mut dyn Observer,
    state: State,
) -> Result<Outcome, SimulationError> {
    Run::new(scene, engine, observer).run(Some(state))
}

struct Run<'a> {
    scene: &'a Scene,
    engine: &'a mut dyn Engine,
    observer: &'a mut dyn Observer,
    /// Longest step that viscosity and diffusion allow, s.
    limit: f64,
    /// m/s
    wall_speed: f64,
    /// Kinetic energy above which something is wrong, m^4/s^2.
    most_energy: f64,
    warnings: Vec<String>,
    moving: moving::Watch,
    /// Memory for the state of the next row.
    spare: State,
    /// Forces, differences and fluxes for the diagnostics.
    probes: Vec<Probe>,
}

impl<'a> Run<'a> {
    pub(super) fn new(scene: &'a Scene, engine: &'a mut dyn Engine, observer: &'a mut dyn Observer) -> Self {
        let (limit, warnings, moving) = (f64::INFINITY, Vec::new(), moving::Watch::new(scene));
        let (wall_speed, most_energy, probes) = (0.0, f64::MAX, Vec::new());
        let spare = State::default();
        Self { scene, engine, observer, limit, wall_speed, most_energy, warnings, moving, spare, probes }
    }

    fn run(mut self, resumed: Option<State>) -> Result<Outcome, SimulationError> {
        let started = Instant::now();
        let any = self.scene.clock(1.0);
        for &operation in &self.scene.plan.setup {
            self.engine.apply(operation, &any)?;
        }
        self.limit = match &resumed {
            Some(state) => state.progress.viscous.unwrap_or(f64::INFINITY),
            None => self.stability_limit()?,
        };
        let ladder = self.ladder()?;
        if self.scene.groups > 1 && resumed.is_none() {
            let groups = self.scene.groups;
            self.warnings.push(format!("the points fall into {groups} groups out of each other's sight"));
        }
        let setup = started.elapsed();
        if !self.scene.plan.flows {
            return self.once(ladder, setup);
        }

        let started = Instant::now();
        let time = &self.scene.case.time;
        let begun = self.scene.initial_velocity();
        self.most_energy = self.scene.energy_scale().map_or(f64::MAX, |scale| self.scene.case.guard.energy * scale);
        self.wall_speed = self.fastest(&begun, self.scene.sizes.interior);
        self.probes = Probe::of_case(&self.scene.case, &self.scene.cloud.position)?;
        let mut good = match resumed {
            Some(state) => {
                state.write(self.engine)?;
                self.begin_steps(&self.scene.clock(state.progress.dt))?;
                self.warnings.clone_from(&state.progress.warnings);
                state
            }
            None => self.begin(self.fastest(&begun, 0))?,
        };
        let mut progress = good.progress.clone();
        let mut taken = 0;
        let (stop, snapshot) = loop {
            if progress.time >= time.end * (1.0 - 1e-12) {
                break (Stop::End, self.snapshot(progress.time)?);
            }
            if progress.steady_rows == STEADY_ROWS {
                break (Stop::Steady, self.snapshot(progress.time)?);
            }
            let next = self.next_step(&mut progress);
            let row = next.and_then(|next| self.row(&mut progress, next, &started, &mut taken));
            let step = progress.step;
            let interrupted = match row {
                Ok(Row::Full(row, state)) => {
                    self.observer.report(&row);
                    self.spare = std::mem::replace(&mut good, state);
                    self.tell_moved();
                    self.observer.keep(&good);
                    self.observer.stop_requested()
                }
                Ok(Row::Interrupted(row)) => {
                    self.observer.report(&row);
                    self.tell_moved();
                    true
                }
                Ok(Row::Trouble(trouble)) => {
                    if trouble.may_be_mended() && good.progress.halvings < self.scene.case.guard.retries {
                        progress = self.go_back(&mut good, &trouble, step)?;
                        continue;
                    }
                    break (Stop::Trouble { trouble, step }, self.snapshot_of(&good, good.progress.time)?);
                }
                Err(error) if step == 0 && progress.halvings == 0 => return Err(error),
                Err(error) => {
                    let trouble = match error {
                        SimulationError::Engine(error) => Trouble::Engine(error),
                        error => Trouble::Refused(error.to_string()),
                    };
                    break (Stop::Trouble { trouble, step }, self.snapshot_of(&good, good.progress.time)?);
                }
            };
            if interrupted {
                break (Stop::Interrupted, self.snapshot(progress.time)?);
            }
        };
        let stepping = started.elapsed();
        let warnings = self.warnings;
        let Progress { step: steps, fallbacks, iterations, .. } = match stop {
            Stop::Trouble { step, .. } => Progress { step, ..progress },
            _ => progress,
        };
        Ok(Outcome { stop, steps, snapshot, state: good, fallbacks, iterations, ladder, setup, stepping, warnings })
    }
}
