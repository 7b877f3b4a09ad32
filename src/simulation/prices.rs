//! What a step costs: each operation's time, and the step's own.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use super::{Run, SimulationError};
use crate::engine::{Engine, EngineError, Spent};
use crate::scene::Scene;
use crate::step::{Effect, Operation};

/// Seconds a step.
#[derive(Debug, Clone, PartialEq)]
pub struct Prices {
    /// Steps that were timed.
    pub steps: u32,
    /// Of a whole step, by the clock on the wall.
    pub step: f64,
    /// Of each operation of the step, in its order; what stands twice in it counts once, for both.
    pub operations: Vec<(Operation, f64)>,
}

impl Prices {
    /// Of each effect.
    pub fn effects(&self) -> BTreeMap<Effect, f64> {
        let mut effects = BTreeMap::new();
        for &(operation, seconds) in &self.operations {
            *effects.entry(operation.effect()).or_default() += seconds;
        }
        effects
    }

    /// Of all operations.
    pub fn sum(&self) -> f64 {
        self.operations.iter().map(|(_, seconds)| seconds).sum()
    }
}

/// Steps that nobody times: the flow develops, and memory warms up.
const BEFORE: u32 = 20;
/// Steps between two looks at the clock, and the time after which it is enough.
const STRETCH: u32 = 20;
const ENOUGH: Duration = Duration::from_millis(500);

/// Times the steps of `scene` on an engine that takes times, from the beginning of the run on.
pub fn prices(scene: &Scene, engine: &mut dyn Engine) -> Result<Prices, SimulationError> {
    let mut observer = ();
    let mut run = Run::new(scene, engine, &mut observer);
    let any = scene.clock(1.0);
    for &operation in &scene.plan.setup {
        run.engine.apply(operation, &any)?;
    }
    run.limit = run.stability_limit()?;
    let speed = scene.initial_velocity().iter().map(|velocity| velocity.length()).fold(0.0, f64::max);
    let (clock, _) = run.step(speed, 0.0, 0)?;
    run.begin_steps(&clock)?;
    run.first_kick(&clock)?;
    run.engine.advance(BEFORE, &clock)?;
    let (before, started, mut steps) = (run.engine.seconds(), Instant::now(), 0);
    while started.elapsed() < ENOUGH {
        steps += advanced(run.engine.advance(STRETCH, &clock)?.steps)?;
    }
    let (step, after) = (started.elapsed().as_secs_f64() / f64::from(steps), run.engine.seconds());
    let spent = |spent: &Spent, operation| spent.get(operation).copied().unwrap_or(0.0);
    let mut operations: Vec<(Operation, f64)> = Vec::new();
    for operation in scene.plan.drift.iter().chain(&scene.plan.kick) {
        if operations.iter().all(|(known, _)| known != operation) {
            let seconds = spent(&after, operation) - spent(&before, operation);
            operations.push((*operation, seconds / f64::from(steps)));
        }
    }
    Ok(Prices { steps, step, operations })
}

/// A flow that is no longer one has no price.
fn advanced(steps: u32) -> Result<u32, EngineError> {
    match steps {
        STRETCH => Ok(steps),
        _ => Err(EngineError::Device("the flow turned non-finite while it was timed".to_owned())),
    }
}
