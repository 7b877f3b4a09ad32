//! One run of one trial: what it gives, and how long each part of it takes.

use std::fmt::{self, Display, Formatter};
use std::sync::Arc;
use std::time::Instant;

use cpu_time::ProcessTime;
use rayon::ThreadPoolBuilder;
use serde::{Deserialize, Serialize};

use super::timed::Timed;
use super::{EngineKind, Precision, Trial};
use crate::case::{Case, Guard};
use crate::engine::{Engine, EngineError};
use crate::gpu::adapter::{self, Candidate};
use crate::gpu::{self, Gpu, GpuEngine};
use crate::scene::{Scene, SceneError};
use crate::simulation::{Diagnostics, Observer, SimulationError, Stop, Trouble, simulate};
use crate::{cpu, measure, run};

/// What one run gave. The case is read before the clocks start, the error is measured after they stop.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Run {
    pub end: End,
    pub points: usize,
    pub steps: u64,
    /// Pressure iterations of all steps.
    pub iterations: u64,
    /// Relative, as the case's expectation has it.
    pub error: Option<f64>,
    /// What that is the error of, in words.
    pub quantity: Option<String>,
    pub seconds: RunSeconds,
}

/// s; the parts are wall-clock time.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct RunSeconds {
    pub wall: f64,
    /// User and system time of the process.
    pub cpu: f64,
    /// All operations of the engine, those of the setup among them; none where it takes no times.
    #[serde(default)]
    pub engine: Option<f64>,
    /// Points, geometry, arrays, compiled kernels, the setup operations.
    pub setup: f64,
    pub stepping: f64,
    /// Of the steps, the pressure solves; none where the engine takes no times.
    pub solve: Option<f64>,
    /// Of the steps, the other operations.
    pub operations: Option<f64>,
    /// Of the steps, measuring for the rows of diagnostics and reading fields back.
    pub reading: f64,
}

/// How a run ended.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum End {
    /// Nothing changed any more.
    Steady,
    /// The end of the simulated time, or of a problem without.
    Time,
    /// A field turned non-finite after the state at this time, s.
    Diverged {
        after: f64,
    },
    Failed {
        reason: String,
    },
}

impl Display for End {
    fn fmt(&self, out: &mut Formatter<'_>) -> fmt::Result {
        match self {
            End::Steady => write!(out, "steady"),
            End::Time => write!(out, "to the end"),
            End::Diverged { after } => write!(out, "diverged after t = {after:.4} s"),
            End::Failed { reason } => write!(out, "failed: {reason}"),
        }
    }
}

impl End {
    /// True where the run came to its end.
    pub fn is_good(&self) -> bool {
        matches!(self, End::Steady | End::Time)
    }
}

/// Why there is nothing that could be called a run.
#[derive(Debug, thiserror::Error)]
enum Failure {
    #[error(transparent)]
    Scene(#[from] SceneError),
    #[error(transparent)]
    Engine(#[from] EngineError),
    #[error(transparent)]
    Simulation(#[from] SimulationError),
    #[error(transparent)]
    Threads(#[from] rayon::ThreadPoolBuildError),
    #[error(transparent)]
    Reference(#[from] crate::case::ReferenceError),
    #[error(transparent)]
    Measure(#[from] measure::MeasureError),
}

impl Trial {
    /// Runs it once; `None` where `stop` turned true before it was over. A run that fails says so in its result.
    pub fn run(&self, stop: &(dyn Fn() -> bool + Sync)) -> Option<Run> {
        let gpu = match self.engine {
            EngineKind::Cpu => None,
            EngineKind::Gpu => Some(adapter::choose(self.adapter.as_deref())),
        };
        let (cpu, wall) = (ProcessTime::now(), Instant::now());
        let result = gpu.transpose().map_err(Failure::from).and_then(|gpu| {
            let pool = ThreadPoolBuilder::new().num_threads(self.threads).build()?;
            pool.install(|| self.timed(gpu.as_ref(), (cpu, wall), stop))
        });
        result.unwrap_or_else(|failure| {
            Some(Run {
                end: End::Failed { reason: failure.to_string() },
                points: 0,
                steps: 0,
                iterations: 0,
                error: None,
                quantity: None,
                seconds: RunSeconds {
                    wall: wall.elapsed().as_secs_f64(),
                    cpu: cpu.elapsed().as_secs_f64(),
                    ..RunSeconds::default()
                },
            })
        })
    }

    fn timed(
        &self,
        gpu: Option<&Candidate>,
        (cpu, wall): (ProcessTime, Instant),
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Result<Option<Run>, Failure> {
        // A setting is measured as it is: with the steps that it asks for, or not at all.
        let guard = Guard { retries: 0, ..self.case.guard.clone() };
        let scene = Arc::new(Scene::build(&Case { guard, ..self.case.clone() })?);
        let mut engine = self.open(&scene, gpu)?;
        let mut engine = Timed::new(engine.as_mut(), &scene.plan);
        let opened = wall.elapsed().as_secs_f64();
        let outcome = simulate(&scene, &mut engine, &mut Stopper(stop))?;
        let parts = engine.parts();
        let seconds = RunSeconds {
            wall: wall.elapsed().as_secs_f64(),
            cpu: cpu.elapsed().as_secs_f64(),
            engine: parts.all,
            setup: opened + outcome.setup.as_secs_f64(),
            stepping: outcome.stepping.as_secs_f64(),
            solve: parts.solve,
            operations: parts.operations,
            reading: parts.reading,
        };
        let end = match outcome.stop {
            Stop::Interrupted => return Ok(None),
            Stop::Steady => End::Steady,
            Stop::End => End::Time,
            Stop::Trouble { trouble: trouble @ (Trouble::Engine(_) | Trouble::Refused(_)), .. } => {
                End::Failed { reason: trouble.to_string() }
            }
            Stop::Trouble { .. } => End::Diverged { after: outcome.snapshot.time },
        };
        let measured = match end.is_good() {
            true => measure::evaluate(&self.case, &outcome.snapshot, &run::profiles(&self.case)?)?.into_iter().next(),
            false => None,
        };
        let (error, quantity) = measured.map_or((None, None), |row| (row.error, Some(row.quantity)));
        let (steps, iterations, points) = (outcome.steps, outcome.iterations, scene.sizes.points);
        Ok(Some(Run { end, points, steps, iterations, error, quantity, seconds }))
    }

    fn open(&self, scene: &Arc<Scene>, gpu: Option<&Candidate>) -> Result<Box<dyn Engine>, EngineError> {
        match (gpu, self.precision) {
            (None, Precision::F32) => cpu::single(scene),
            (None, Precision::F64) => cpu::double(scene),
            (Some(gpu), precision) => {
                let precision = match precision {
                    Precision::F32 => gpu::Precision::Single,
                    Precision::F64 => gpu::Precision::Double,
                };
                Ok(Box::new(GpuEngine::new(Arc::clone(scene), Gpu::open_timed(gpu, precision)?)?))
            }
        }
    }
}

/// Passes a request to stop on to the run.
struct Stopper<'a>(&'a (dyn Fn() -> bool + Sync));

impl Observer for Stopper<'_> {
    fn report(&mut self, _: &Diagnostics) {}

    fn stop_requested(&self) -> bool {
        (self.0)()
    }
}
