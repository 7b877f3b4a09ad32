//! An engine that loses a velocity in the middle of a run.

use stillpoint::engine::{Advance, Clock, Data, Engine, EngineError, EngineInfo, Measurement, SolveInfo};
use stillpoint::step::{Buffer, Operation};

/// An engine that spoils one number of the velocity after some steps, once.
pub struct Spoiled {
    inner: Box<dyn Engine>,
    velocity: Buffer,
    point: usize,
    after: u32,
    steps: u32,
    done: bool,
}

impl Spoiled {
    /// `velocity` of `point` is lost at the beginning of the advance in which step `after` ends.
    pub fn new(inner: Box<dyn Engine>, velocity: Buffer, point: usize, after: u32) -> Self {
        Self { inner, velocity, point, after, steps: 0, done: false }
    }
}

impl Engine for Spoiled {
    fn info(&self) -> EngineInfo {
        self.inner.info()
    }

    fn write(&mut self, buffer: Buffer, data: &Data) -> Result<(), EngineError> {
        self.inner.write(buffer, data)
    }

    fn read(&mut self, buffer: Buffer) -> Result<Data, EngineError> {
        self.inner.read(buffer)
    }

    fn apply(&mut self, operation: Operation, clock: &Clock) -> Result<(), EngineError> {
        self.inner.apply(operation, clock)
    }

    fn advance(&mut self, steps: u32, clock: &Clock) -> Result<Advance, EngineError> {
        if !self.done
            && self.steps + steps > self.after
            && let Data::Real(mut values) = self.inner.read(self.velocity)?
        {
            values[2 * self.point] = f64::NAN;
            self.inner.write(self.velocity, &Data::Real(values))?;
            self.done = true;
        }
        let done = self.inner.advance(steps, clock)?;
        self.steps += done.steps;
        Ok(done)
    }

    fn solve_info(&self) -> SolveInfo {
        self.inner.solve_info()
    }

    fn measure(&mut self, elapsed: f64) -> Result<Measurement, EngineError> {
        self.inner.measure(elapsed)
    }
}
