//! An engine with a stopwatch: what leaves it, and what its operations take once the steps have begun.

use std::time::Instant;

use crate::engine::{Advance, Clock, Data, Engine, EngineError, EngineInfo, Measurement, SolveInfo, Spent};
use crate::step::{Buffer, Operation, Plan};

/// Passes everything on to the engine inside.
pub(super) struct Timed<'a> {
    inner: &'a mut dyn Engine,
    plan: &'a Plan,
    /// s
    reading: f64,
    /// What the operations had taken before the first step: of the steps' own, the search for the longest stable step.
    before: Option<Spent>,
}

/// Seconds of the parts of the steps; the operations' are none where the engine takes no times.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Parts {
    /// All operations, of the setup and of the steps.
    pub all: Option<f64>,
    /// All pressure solves, a factorisation among them.
    pub solve: Option<f64>,
    /// The other operations of the steps.
    pub operations: Option<f64>,
    /// Measuring for the rows of diagnostics, and reading fields back.
    pub reading: f64,
}

impl<'a> Timed<'a> {
    pub fn new(inner: &'a mut dyn Engine, plan: &'a Plan) -> Self {
        Self { inner, plan, reading: 0.0, before: None }
    }

    pub fn parts(&self) -> Parts {
        let all = self.inner.seconds();
        if all.is_empty() {
            return Parts { reading: self.reading, ..Parts::default() };
        }
        let (mut solve, mut operations) = (0.0, 0.0);
        let repeated = |operation| self.plan.drift.contains(operation) || self.plan.kick.contains(operation);
        for (operation, seconds) in all.iter().filter(|(operation, _)| repeated(operation)) {
            match operation {
                Operation::ConjugateGradient | Operation::Bicgstab | Operation::DirectSolve => solve += seconds,
                _ => {
                    operations += seconds - self.before.as_ref().and_then(|spent| spent.get(operation)).unwrap_or(&0.0)
                }
            }
        }
        // A solve that stalls is handed to the direct solver, which is no operation of the plan then.
        if !repeated(&Operation::DirectSolve) {
            solve += all.get(&Operation::DirectSolve).unwrap_or(&0.0);
        }
        let total = all.values().sum();
        Parts { all: Some(total), solve: Some(solve), operations: Some(operations), reading: self.reading }
    }

    fn read_timed<T>(&mut self, body: impl FnOnce(&mut dyn Engine) -> T) -> T {
        let started = Instant::now();
        let result = body(self.inner);
        // Without time there is nothing but the setup before.
        if self.before.is_some() || !self.plan.flows {
            self.reading += started.elapsed().as_secs_f64();
        }
        result
    }
}

impl Engine for Timed<'_> {
    fn info(&self) -> EngineInfo {
        self.inner.info()
    }

    fn write(&mut self, buffer: Buffer, data: &Data) -> Result<(), EngineError> {
        self.inner.write(buffer, data)
    }

    fn read(&mut self, buffer: Buffer) -> Result<Data, EngineError> {
        self.read_timed(|engine| engine.read(buffer))
    }

    fn apply(&mut self, operation: Operation, clock: &Clock) -> Result<(), EngineError> {
        self.inner.apply(operation, clock)
    }

    fn advance(&mut self, steps: u32, clock: &Clock) -> Result<Advance, EngineError> {
        if self.before.is_none() && steps > 0 {
            self.before = Some(self.inner.seconds());
        }
        self.inner.advance(steps, clock)
    }

    fn solve_info(&self) -> SolveInfo {
        self.inner.solve_info()
    }

    fn viscous_solve_info(&self) -> Option<SolveInfo> {
        self.inner.viscous_solve_info()
    }

    fn measure(&mut self, elapsed: f64) -> Result<Measurement, EngineError> {
        self.read_timed(|engine| engine.measure(elapsed))
    }

    fn seconds(&self) -> Spent {
        self.inner.seconds()
    }
}
