//! The GPU engine's side of the trait that both engines implement.

use std::sync::Arc;
use std::time::Instant;

use super::batch::{Batch, Cursor, Pace, Report};
use super::bindings::Own;
use super::device::Gpu;
use super::layout::{Halted, NO_POINT, Scalar, Time, Word};
use super::memory::Memory;
use super::program::Program;
use super::timer::Timer;
use crate::direct::DirectSolver;
use crate::engine::{
    Advance, Clock, Data, Engine, EngineError, EngineInfo, Measurement, NonFinite, Outcome, SolveInfo, Spent,
};
use crate::scene::Scene;
use crate::step::{Buffer, Equation, Operation};

/// The plan's operations on one GPU.
pub struct GpuEngine {
    gpu: Gpu,
    scene: Arc<Scene>,
    memory: Memory,
    program: Program,
    /// The operations of one step.
    step: Vec<Operation>,
    pace: Pace,
    direct: Option<DirectSolver>,
    solve: SolveInfo,
    viscous_solve: SolveInfo,
    fallbacks: u32,
    timer: Option<Timer>,
    spent: Spent,
}

impl GpuEngine {
    /// Allocates the plan's arrays, compiles its operations, and fills in what the scene begins with. The setup operations
    /// are yet to run.
    pub fn new(scene: Arc<Scene>, gpu: Gpu) -> Result<Self, EngineError> {
        let memory = Memory::new(&gpu, &scene)?;
        for (buffer, data) in scene.initial() {
            memory.write(&gpu, buffer, &data)?;
        }
        let program = Program::new(&gpu, &scene, &memory)?;
        let step = scene.plan.drift.iter().chain(&scene.plan.kick).copied().collect();
        let (pace, solve, viscous_solve) = (Pace::default(), SolveInfo::default(), SolveInfo::default());
        let (timer, spent) = (Timer::new(&gpu)?, Spent::default());
        let (direct, fallbacks) = (None, 0);
        Ok(Self { gpu, scene, memory, program, step, pace, direct, solve, viscous_solve, fallbacks, timer, spent })
    }

    /// The GPU that computes.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// True on a GPU that was opened for it and has timestamps.
    pub fn takes_times(&self) -> bool {
        self.timer.is_some()
    }

    /// Bytes that the arrays take on the GPU: the plan's, and the engine's own.
    pub fn allocated_bytes(&self) -> u64 {
        self.memory.bytes()
    }

    /// Lets the next batch hold this many iterations for each solve, and returns how many it was going to.
    #[cfg(test)]
    pub(super) fn hold_iterations(&mut self, iterations: u32) -> u32 {
        let [pressure, viscosity] = &mut self.pace.budgets;
        viscosity.iterations = iterations;
        std::mem::replace(&mut pressure.iterations, iterations)
    }

    fn set_clock(&self, clock: &Clock) -> Result<(), EngineError> {
        let constants = &self.scene.constants;
        let density_per_kick = constants.density / clock.kick;
        let values: Vec<f64> = Time::ALL
            .iter()
            .map(|time| match time {
                Time::Dt => clock.dt,
                Time::Kick => clock.kick,
                Time::SecondKick => clock.second_kick,
                Time::Source => -density_per_kick,
                Time::DensityPerKick => density_per_kick,
                Time::Correction => clock.kick / constants.density,
                Time::Diffusion => clock.kick * constants.viscosity,
                Time::Stiffness => self.scene.stiffness(clock),
                Time::Stop => constants.tolerance * density_per_kick / clock.dt,
                Time::ViscousStop => constants.viscous_tolerance / clock.dt,
                Time::Share => clock.share,
                Time::Seen => self.scene.seen_share(clock.kick),
            })
            .collect();
        self.memory.upload(&self.gpu, self.memory.own(Own::Clock), &values)
    }

    /// Runs `step` over and over. Returns early at a field that is not finite.
    fn run(&mut self, step: &[Operation], steps: u32, counted: bool) -> Result<Advance, EngineError> {
        let mut cursor = Cursor::default();
        let mut pace = self.pace;
        let mut done = Advance::default();
        self.batch(step, counted).reset()?;
        loop {
            let rest = steps - done.steps;
            let report = self.batch(step, counted).send(&mut cursor, rest, &mut pace)?;
            done.steps = report.word(Word::Steps);
            done.iterations = u64::from(report.word(Word::TotalIterations));
            self.solve = report.solve_info(Equation::Pressure);
            self.viscous_solve = report.solve_info(Equation::Viscosity);
            report.spent.iter().for_each(|(&operation, seconds)| self.spend(operation, *seconds));
            let halted = report.halted();
            match halted {
                Halted::ForDirectSolve if report.equation() == Equation::Viscosity => {
                    // Numbers that are none are trouble; a solve that stands still is an error.
                    done.trouble = self.first_non_finite(Buffer::Projected, 2)?;
                    done.steps += u32::from(done.trouble.is_some());
                    if done.trouble.is_none() {
                        return Err(EngineError::viscosity(&self.viscous_solve));
                    }
                }
                Halted::ForDirectSolve => {
                    let started = Instant::now();
                    done.trouble = self.solve_directly(report)?;
                    self.spend(Operation::DirectSolve, started.elapsed().as_secs_f64());
                    // Trouble ends the step that it was met in.
                    done.steps += u32::from(done.trouble.is_some());
                    let fallback = done.trouble.is_none() && !step.contains(&Operation::DirectSolve);
                    self.fallbacks += u32::from(fallback);
                }
                Halted::ByNonFinite => done.trouble = self.trouble(&report)?,
                Halted::Not | Halted::InSolve | Halted::ByOverflow => {}
            }
            // Of a single operation nothing is left once it came to rest.
            let over =
                if counted { done.steps >= steps } else { cursor.operation >= step.len() || halted == Halted::Not };
            if over || done.trouble.is_some() {
                break;
            }
        }
        if counted {
            self.pace = pace;
            done.fallbacks = std::mem::take(&mut self.fallbacks);
        }
        Ok(done)
    }

    fn batch<'a>(&'a self, step: &'a [Operation], counted: bool) -> Batch<'a> {
        let Self { gpu, scene, memory, program, timer, .. } = self;
        Batch { gpu, scene, memory, program, timer: timer.as_ref(), step, counted }
    }

    /// Kept on a GPU alone that was opened for it.
    fn spend(&mut self, operation: Operation, seconds: f64) {
        if self.timer.is_some() {
            *self.spent.entry(operation).or_default() += seconds;
        }
    }

    /// Solves the pressure equation on the host; a source that is not finite is trouble instead. `report` is that of the
    /// batch that waits for it, and learns how the solve ended.
    fn solve_directly(&mut self, mut report: Report) -> Result<Option<NonFinite>, EngineError> {
        let Data::Real(source) = self.read(Buffer::Source)? else { return Err(EngineError::Absent(Buffer::Source)) };
        if source.iter().any(|value| !value.is_finite()) {
            self.solve.outcome = Outcome::BrokeDown;
            let velocity = match self.scene.plan.flows {
                true => self.first_non_finite(Buffer::Projected, 2)?,
                false => None,
            };
            return match velocity {
                Some(cause) => Ok(Some(cause)),
                None => self.first_non_finite(Buffer::Source, 1),
            };
        }
        let direct = match self.direct.take() {
            // The matrix of points that move is another one in every step.
            Some(direct) if !self.scene.plan.moves() => direct,
            _ => DirectSolver::new(&self.scene, &mut |buffer| self.memory.read(&self.gpu, buffer))?,
        };
        let pressure = direct.solve(&source)?;
        self.memory.write(&self.gpu, Buffer::Pressure, &self.scene.scalars(&pressure, 0.0))?;
        // As it is stored: rounded.
        if let Data::Real(pressure) = self.read(Buffer::Pressure)? {
            report.solved(direct.residual(&self.scene, &source, &pressure));
        }
        self.direct = Some(direct);
        self.memory.write_state(&self.gpu, report.state())?;
        self.solve = report.solve_info(Equation::Pressure);
        Ok(None)
    }

    /// What a report found that is no number.
    fn trouble(&mut self, report: &Report) -> Result<Option<NonFinite>, EngineError> {
        let found = [(Word::BadVelocity, Buffer::Projected), (Word::BadPressure, Buffer::Pressure)]
            .into_iter()
            .map(|(word, buffer)| (report.word(word), buffer))
            .find(|&(point, _)| point != NO_POINT)
            .map(|(point, buffer)| NonFinite { buffer, point: point as usize });
        if found.is_some() {
            return Ok(found);
        }
        // The kernels do not say in which of the carried fields.
        for field in self.scene.plan.carried.clone() {
            let first = self.first_non_finite(Buffer::Carried(field), 1)?;
            if first.is_some() {
                return Ok(first);
            }
        }
        Ok(None)
    }

    /// The first point whose `width` entries are not all finite.
    fn first_non_finite(&mut self, buffer: Buffer, width: usize) -> Result<Option<NonFinite>, EngineError> {
        let Data::Real(values) = self.read(buffer)? else { return Ok(None) };
        let entry = values.iter().position(|value| !value.is_finite());
        Ok(entry.map(|entry| NonFinite { buffer, point: entry / width }))
    }
}

impl Engine for GpuEngine {
    fn info(&self) -> EngineInfo {
        EngineInfo { engine: "gpu", adapter: Some(self.gpu.info.clone()), precision: self.gpu.precision.name() }
    }

    fn write(&mut self, buffer: Buffer, data: &Data) -> Result<(), EngineError> {
        self.memory.write(&self.gpu, buffer, data)
    }

    fn read(&mut self, buffer: Buffer) -> Result<Data, EngineError> {
        self.memory.read(&self.gpu, buffer)
    }

    fn read_all(&mut self, arrays: &mut [(Buffer, Data)]) -> Result<Option<(Buffer, usize)>, EngineError> {
        self.memory.read_all(&self.gpu, arrays)?;
        let lost = |(buffer, data): &(Buffer, Data)| data.first_non_finite().map(|entry| (*buffer, entry));
        Ok(arrays.iter().find_map(lost))
    }

    fn apply(&mut self, operation: Operation, clock: &Clock) -> Result<(), EngineError> {
        if !self.program.has(operation) {
            let touched = [operation.reads(&self.scene.plan), operation.writes()].concat();
            let lacking = touched.into_iter().find(|&buffer| self.memory.field(buffer).is_err());
            let unknown = || EngineError::Device(format!("this plan has no operation {}", operation.name()));
            return Err(lacking.map_or_else(unknown, EngineError::Absent));
        }
        self.set_clock(clock)?;
        self.run(&[operation], 1, false).map(|_| ())
    }

    fn advance(&mut self, steps: u32, clock: &Clock) -> Result<Advance, EngineError> {
        if steps == 0 {
            return Ok(Advance { fallbacks: std::mem::take(&mut self.fallbacks), ..Advance::default() });
        }
        self.set_clock(clock)?;
        let step = std::mem::take(&mut self.step);
        let result = self.run(&step, steps, true);
        self.step = step;
        result
    }

    fn solve_info(&self) -> SolveInfo {
        self.solve
    }

    fn viscous_solve_info(&self) -> Option<SolveInfo> {
        self.scene.case.implicit_viscosity().then_some(self.viscous_solve)
    }

    fn seconds(&self) -> Spent {
        self.spent.clone()
    }

    fn measure(&mut self, elapsed: f64) -> Result<Measurement, EngineError> {
        let batch = self.batch(&[], false);
        batch.reset()?;
        let report = batch.measure()?;
        let points = self.scene.sizes.points as f64;
        Ok(Measurement {
            kinetic_energy: report.scalar(Scalar::Energy),
            max_speed: report.scalar(Scalar::SpeedSquare).sqrt(),
            divergence: (report.scalar(Scalar::DivergenceSquare) / points).sqrt(),
            change: report.scalar(Scalar::ChangeSquare).sqrt() / elapsed,
        })
    }
}
