//! The plan's operations as dispatches, and how a stretch of them is written into a pass.

use std::collections::BTreeMap;

use wgpu::{Buffer as GpuBuffer, ComputePass};

use super::bindings::arrays_of;
use super::device::Gpu;
use super::launch::{Compiler, Launch};
use super::memory::Memory;
use super::sources::{self, Stage, Stages};
use crate::engine::EngineError;
use crate::scene::Scene;
use crate::step::{Buffer, Equation, Operation, Points};

/// What one operation dispatches.
enum Part {
    Once(Vec<Launch>),
    Solve { begin: Launch, check: Vec<Launch>, iterate: Vec<Launch>, end: Launch },
}

/// How many iterations a batch holds for each solve. A guess: a solve that takes more is taken up again.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Budget {
    /// Iterations before the residual is recomputed.
    pub iterations: u32,
    /// Times that it is recomputed after them.
    pub rounds: u32,
}

/// Every operation of a plan, compiled.
pub(super) struct Program {
    parts: BTreeMap<Operation, Part>,
    /// Looks for numbers that are none, and counts the step.
    end_step: Vec<Launch>,
    pub measure: Vec<Launch>,
}

impl Program {
    pub fn new(gpu: &Gpu, scene: &Scene, memory: &Memory) -> Result<Self, EngineError> {
        let mut compiler = Compiler::new(gpu, scene, memory);
        let mut parts = BTreeMap::new();
        for operation in scene.plan.operations() {
            let arrays = arrays_of(operation, scene);
            let mut all = |stages: &[Stage]| -> Result<Vec<Launch>, EngineError> {
                stages.iter().map(|stage| compiler.launch(stage, &arrays)).collect()
            };
            let part = match sources::stages(operation, &scene.plan) {
                Stages::Once(stages) => Part::Once(all(&stages)?),
                Stages::Solve { check, iterate } => {
                    let (check, iterate) = (all(&check)?, all(&iterate)?);
                    let equation = operation.solves().unwrap_or(Equation::Pressure);
                    let begin = compiler.launch(&sources::begin(equation), &arrays)?;
                    Part::Solve { begin, check, iterate, end: compiler.launch(&sources::END_SOLVE, &arrays)? }
                }
            };
            parts.insert(operation, part);
        }
        let mut end_step = Vec::new();
        for (stage, arrays) in end_step_stages(scene) {
            end_step.push(compiler.launch(&stage, &arrays)?);
        }
        let arrays = measured_arrays(scene);
        let measured: &[Stage] = if scene.plan.flows { &sources::MEASURE } else { &[] };
        let measure = measured.iter().map(|stage| compiler.launch(stage, &arrays)).collect::<Result<_, _>>()?;
        Ok(Self { parts, end_step, measure })
    }

    pub fn has(&self, operation: Operation) -> bool {
        self.parts.contains_key(&operation)
    }

    /// Writes one operation of the plan into a pass; `resumed` takes up the solve that the last batch left unfinished;
    /// `budgets` are those of the pressure's solve and of viscosity's.
    /// Returns how many dispatches that took.
    pub fn encode(
        &self,
        operation: Operation,
        resumed: bool,
        budgets: [Budget; 2],
        pass: &mut ComputePass<'_>,
        dispatches: &GpuBuffer,
    ) -> usize {
        let mut count = 0;
        let mut run = |launches: &[Launch]| {
            launches.iter().for_each(|launch| launch.encode(pass, dispatches));
            count += launches.len();
        };
        match self.parts.get(&operation) {
            None => {}
            Some(Part::Once(launches)) => run(launches),
            Some(Part::Solve { begin, check, iterate, end }) => {
                let budget = budgets[operation.solves().unwrap_or(Equation::Pressure) as usize];
                if !resumed {
                    run(std::slice::from_ref(begin));
                    run(check);
                }
                for _ in 0..budget.rounds {
                    (0..budget.iterations).for_each(|_| run(iterate));
                    run(check);
                }
                run(std::slice::from_ref(end));
            }
        }
        count
    }

    pub fn encode_end_step(&self, pass: &mut ComputePass<'_>, dispatches: &GpuBuffer) {
        self.end_step.iter().for_each(|launch| launch.encode(pass, dispatches));
    }
}

pub(super) type Arrays = [Vec<(Buffer, String)>; 2];

fn reading(buffers: impl IntoIterator<Item = Buffer>) -> Arrays {
    [buffers.into_iter().map(|buffer| (buffer, buffer.name())).collect(), Vec::new()]
}

/// The kernels at the end of a step, and what they may bind.
pub(super) fn end_step_stages(scene: &Scene) -> Vec<(Stage, Arrays)> {
    let mut stages = Vec::new();
    if scene.plan.flows {
        stages.push((sources::WATCH_VELOCITY, reading([Buffer::Projected])));
    }
    if scene.plan.buffers().contains(&Buffer::Pressure) {
        stages.push((sources::WATCH_PRESSURE, reading([Buffer::Pressure])));
    }
    for &field in &scene.plan.carried {
        let array = (Buffer::Carried(field), "carried".to_owned());
        stages.push((sources::WATCH_CARRIED, [vec![array], Vec::new()]));
    }
    stages.push((sources::END_STEP, reading([])));
    stages
}

/// What the measuring kernels may bind.
pub(super) fn measured_arrays(scene: &Scene) -> Arrays {
    let standing = Points::Standing;
    let fits = [
        Buffer::Neighbours(standing),
        Buffer::NeighbourCount(standing),
        Buffer::Support(standing),
        Buffer::Factor(standing),
    ];
    let faces = [Buffer::FaceNeighbours, Buffer::FaceWeight, Buffer::FaceCount];
    let fluxes = [Buffer::FluxPoints, Buffer::FluxCount, Buffer::FluxRow, Buffer::WallFlux];
    let fields = [Buffer::Position(standing), Buffer::Volume, Buffer::Projected, Buffer::Reported, Buffer::Surface];
    let used = scene.plan.buffers();
    reading(fits.into_iter().chain(faces).chain(fluxes).chain(fields).filter(|buffer| used.contains(buffer)))
}
