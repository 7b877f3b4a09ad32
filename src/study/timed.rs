//! An engine with a stopwatch: what leaves it, and what its operations take once the steps have begun.

use std::time::Instant;

use crate::engine::{Advance, Clock, Data, Engine, EngineError, EngineInfo, Measurement, SolveInfo, Spent};
use crate::step::{Buffer, Operation};

/// Passes everything on to the engine inside.
pub(super) struct Timed<'a> {
    inner: &'a mut dyn Engine,
    /// s
    reading: f64,
    /// What the operations had taken before the first step.
    setup: Option<Spent>,
}

/// Seconds of the parts of the steps; the operations' are none where the engine takes no times.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Parts {
    /// All pressure solves, a factorisation among them.
    pub solve: Option<f64>,
    /// The other operations of the steps.
    pub operations: Option<f64>,
    /// Measuring for the rows of diagnostics, and reading fields back.
    pub reading: f64,
}

impl<'a> Timed<'a> {
    pub fn new(inner: &'a mut dyn Engine) -> Self {
        Self { inner, reading: 0.0, setup: None }
    }

    pub fn parts(&self) -> Parts {
        let all = self.inner.seconds();
        let setup = self.setup.clone().unwrap_or_else(|| all.clone());
        if all.is_empty() {
            return Parts { solve: None, operations: None, reading: self.reading };
        }
        let (mut solve, mut operations) = (0.0, 0.0);
        for (operation, seconds) in &all {
            match operation {
                Operation::ConjugateGradient | Operation::Bicgstab | Operation::DirectSolve => solve += seconds,
                _ => operations += seconds - setup.get(operation).unwrap_or(&0.0),
            }
        }
        Parts { solve: Some(solve), operations: Some(operations), reading: self.reading }
    }

    fn read_timed<T>(&mut self, body: impl FnOnce(&mut dyn Engine) -> T) -> T {
        let started = Instant::now();
        let result = body(self.inner);
        if self.setup.is_some() {
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
        if self.setup.is_none() {
            self.setup = Some(self.inner.seconds());
        }
        self.inner.advance(steps, clock)
    }

    fn solve_info(&self) -> SolveInfo {
        self.inner.solve_info()
    }

    fn measure(&mut self, elapsed: f64) -> Result<Measurement, EngineError> {
        self.read_timed(|engine| engine.measure(elapsed))
    }

    fn seconds(&self) -> Spent {
        self.inner.seconds()
    }
}
