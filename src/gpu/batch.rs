//! Batches: many steps in one submission, and what the host does when one stops early.
//!
//! A batch that meets something only the host can settle freezes: every dispatch behind has no workgroups. The host reads
//! why, settles it, and sends the rest. So what is computed depends neither on the length of batches nor on how many
//! iterations they hold.

use std::time::{Duration, Instant};

use super::bindings::Own;
use super::device::Gpu;
use super::layout::{Ended, Extent, Halted, NO_POINT, Scalar, Word};
use super::memory::Memory;
use super::prelude::Shape;
use super::program::{Budget, Program};
use super::timer::{Marks, Timer};
use crate::engine::{EngineError, Outcome, SolveInfo, Spent};
use crate::scene::Scene;
use crate::step::{Buffer, Equation, Operation};

/// A submission is made longer below the first of these times and shorter above the second: long enough to keep the GPU
/// busy, short enough that no watchdog takes it for hung.
const SHORT: Duration = Duration::from_millis(50);
const LONG: Duration = Duration::from_millis(200);
/// Most dispatches of a submission.
const MOST_DISPATCHES: usize = 20_000;
/// Fewest and most iterations that a batch holds for a solve.
const ITERATIONS: [u32; 2] = [8, 1024];

/// Where a run of steps stands.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Cursor {
    /// The operation to go on with, within the first step of the next batch.
    pub operation: usize,
    /// That operation is a solve, begun already.
    pub resumed: bool,
}

/// What a batch left behind.
pub(super) struct Report {
    words: Vec<u32>,
    scalars: Vec<f64>,
    /// Of the operations of this batch, where it was timed.
    pub spent: Spent,
}

impl Report {
    pub fn word(&self, word: Word) -> u32 {
        self.words[word as usize]
    }

    /// The word of an equation: that of viscosity stands behind the pressure's.
    pub fn word_of(&self, word: Word, equation: Equation) -> u32 {
        self.words[word as usize + equation as usize]
    }

    /// What is being solved, or was last.
    pub fn equation(&self) -> Equation {
        let number = self.word(Word::Equation) as usize;
        Equation::ALL.get(number).copied().unwrap_or(Equation::Pressure)
    }

    pub fn scalar(&self, scalar: Scalar) -> f64 {
        self.scalars[scalar as usize]
    }

    pub fn halted(&self) -> Halted {
        Halted::ALL.get(self.word(Word::Halted) as usize).copied().unwrap_or(Halted::Not)
    }

    /// Notes that the pressure was solved for, and how well, by other means.
    pub fn solved(&mut self, residual: f64) {
        self.words[Word::Outcome as usize] = Ended::Converged as u32;
        self.scalars[Scalar::LastResidual as usize] = residual;
    }

    /// The words and the scalars, to be put back.
    pub fn state(&self) -> (&[u32], &[f64]) {
        (&self.words, &self.scalars)
    }

    /// Of the last solve of an equation.
    pub fn solve_info(&self, equation: Equation) -> SolveInfo {
        let outcome = self.word_of(Word::Outcome, equation);
        let scalar = |scalar: Scalar| self.scalars[scalar as usize + equation as usize];
        SolveInfo {
            iterations: self.word_of(Word::Iterations, equation),
            first_residual: scalar(Scalar::FirstResidual),
            last_residual: scalar(Scalar::LastResidual),
            outcome: match Ended::ALL.get(outcome as usize) {
                Some(Ended::BrokeDown) => Outcome::BrokeDown,
                Some(Ended::Stagnated) => Outcome::Stagnated,
                _ => Outcome::Converged,
            },
        }
    }
}

/// How much goes into one submission, learnt from those before.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pace {
    pub steps: u32,
    /// Of the pressure's solve and of viscosity's.
    pub budgets: [Budget; 2],
}

impl Default for Pace {
    fn default() -> Self {
        Self { steps: 1, budgets: [Budget { iterations: 4 * ITERATIONS[0], rounds: 1 }; 2] }
    }
}

impl Pace {
    fn learn(&mut self, report: &Report, elapsed: Duration) {
        let [least, most] = ITERATIONS;
        for (equation, budget) in Equation::ALL.into_iter().zip(&mut self.budgets) {
            if report.halted() != Halted::InSolve {
                let used = report.word_of(Word::MostIterations, equation);
                budget.iterations = (used + used / 4 + 4).clamp(least, most);
                budget.rounds = report.word_of(Word::MostStarts, equation).max(1);
            } else if equation == report.equation() {
                budget.iterations = (2 * budget.iterations).min(most);
            }
        }
        if elapsed < SHORT && report.halted() == Halted::Not {
            self.steps = (2 * self.steps).min(256);
        } else if elapsed > LONG {
            self.steps = (self.steps / 2).max(1);
        }
    }
}

/// All that a batch is made of.
pub(super) struct Batch<'a> {
    pub gpu: &'a Gpu,
    pub scene: &'a Scene,
    pub memory: &'a Memory,
    pub program: &'a Program,
    pub timer: Option<&'a Timer>,
    /// The operations of one step.
    pub step: &'a [Operation],
    /// These are steps of the flow, to be watched and counted, and not one operation on its own.
    pub counted: bool,
}

impl Batch<'_> {
    /// Forgets what earlier runs counted and found.
    pub fn reset(&self) -> Result<(), EngineError> {
        let mut words = vec![0; Word::NAMES.len()];
        words[Word::BadVelocity as usize] = NO_POINT;
        words[Word::BadPressure as usize] = NO_POINT;
        words[Word::BadCarried as usize] = NO_POINT;
        // The state of the last solve stays, to be told.
        words.truncate(Word::Phase as usize);
        self.memory.upload_words(self.gpu, self.memory.own(Own::Control), &words)
    }

    /// Sends at most `steps` steps from `cursor` on, waits, and moves the cursor to where the rest begins.
    pub fn send(&self, cursor: &mut Cursor, steps: u32, pace: &mut Pace) -> Result<Report, EngineError> {
        self.open(cursor.resumed)?;
        let dispatches = self.memory.own(Own::Dispatches);
        let (commands, marks) = self.gpu.checked("encode", |device| {
            let mut encoder = device.create_command_encoder(&Default::default());
            let mut pass = encoder.begin_compute_pass(&Default::default());
            let mut marks = Marks::begin(self.timer, &mut pass);
            let mut count = 0;
            for step in 0..steps.min(pace.steps) {
                let begin = if step == 0 { *cursor } else { Cursor::default() };
                for (k, &operation) in self.step.iter().enumerate().skip(begin.operation) {
                    let resumed = begin.resumed && k == begin.operation;
                    count += self.program.encode(operation, resumed, pace.budgets, &mut pass, dispatches);
                    marks.after(operation, &mut pass);
                }
                if self.counted {
                    self.program.encode_end_step(&mut pass, dispatches);
                }
                if count > MOST_DISPATCHES || !marks.hold(self.step.len()) {
                    break;
                }
            }
            drop(pass);
            marks.resolve(&mut encoder);
            (encoder.finish(), marks)
        })?;
        let started = Instant::now();
        self.gpu.run(commands)?;
        let (words, scalars) = self.memory.read_state(self.gpu)?;
        let mut report = Report { words, scalars, spent: Spent::default() };
        pace.learn(&report, started.elapsed());
        marks.add_to(self.gpu, &mut report.spent)?;
        let halted_at = Some(report.equation());
        let solve = self.step.iter().position(|operation| operation.solves() == halted_at).unwrap_or(0);
        *cursor = match report.halted() {
            Halted::InSolve => Cursor { operation: solve, resumed: true },
            Halted::ForDirectSolve => Cursor { operation: solve + 1, resumed: false },
            _ => Cursor::default(),
        };
        match report.word(Word::MostNeighbours) {
            0 => Ok(report),
            found => Err(EngineError::NeighbourOverflow { found, capacity: self.scene.sizes.capacity }),
        }
    }

    /// Sums over the points; afterwards what is reported is what is projected.
    pub fn measure(&self) -> Result<Report, EngineError> {
        self.open(false)?;
        let dispatches = self.memory.own(Own::Dispatches);
        let (projected, reported) = (self.memory.field(Buffer::Projected)?, self.memory.field(Buffer::Reported)?);
        let commands = self.gpu.checked("measure", |device| {
            let mut encoder = device.create_command_encoder(&Default::default());
            let mut pass = encoder.begin_compute_pass(&Default::default());
            self.program.measure.iter().for_each(|launch| launch.encode(&mut pass, dispatches));
            drop(pass);
            encoder.copy_buffer_to_buffer(projected, 0, reported, 0, projected.size());
            encoder.finish()
        })?;
        self.gpu.run(commands)?;
        let (words, scalars) = self.memory.read_state(self.gpu)?;
        Ok(Report { words, scalars, spent: Spent::default() })
    }

    /// Sets the state going.
    fn open(&self, resumed: bool) -> Result<(), EngineError> {
        let shape = Shape::new(self.scene);
        let mut table = Vec::with_capacity(3 * Extent::NAMES.len());
        for extent in Extent::ALL {
            let groups = match extent {
                Extent::Points => shape.points,
                Extent::Cells => shape.cells,
                Extent::Iterate if resumed => shape.points,
                Extent::IterateOnce if resumed => 1,
                Extent::IterateCells if resumed => shape.coarse,
                Extent::IterateFours if resumed => shape.fours,
                _ => 0,
            };
            let [x, y] = Shape::extent(groups);
            table.extend([x, y, 1]);
        }
        self.memory.upload_words(self.gpu, self.memory.own(Own::Dispatches), &table)?;
        // Halted, and what a batch learns from.
        self.memory.upload_words(self.gpu, self.memory.own(Own::Control), &[Halted::Not as u32, 0, 0, 0, 0])
    }
}
