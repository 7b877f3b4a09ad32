//! The CPU engine: the plan's operations on arrays in memory, on all cores.

mod carry;
mod drift;
mod field;
mod geometry;
mod kick;
mod moving;
mod pressure;
mod views;
mod viscosity;

use std::sync::Arc;
use std::time::Instant;

use crate::cpu::fields::Fields;
use crate::cpu::operations::coarse;
use crate::cpu::operations::space::Domain;
use crate::cpu::operations::{conservative, fits, measure};
use crate::cpu::real::Real;
use crate::direct::DirectSolver;
use crate::engine::{
    Advance, Clock, Data, Engine, EngineError, EngineInfo, Measurement, NonFinite, SolveInfo, Spent, first_lost,
};
use crate::scene::Scene;
use crate::step::coarse::{Level, levels};
use crate::step::{Buffer, Operation, Points};
use crate::{with_order, with_space};

/// Arrays that an operation changes are taken out together and put back together.
macro_rules! with_taken {
    ($fields:expr, [$($name:ident = $buffer:expr),*], $body:expr) => {{
        $(let mut $name = $fields.take($buffer)?;)*
        let result = $body;
        $($fields.put($buffer, $name);)*
        result
    }};
}
use with_taken;

/// Steps between two looks for numbers that are none.
const WATCH_EVERY: u32 = 10;

/// The CPU engine in floats of type `T`.
pub struct CpuEngine<T: Real> {
    scene: Arc<Scene>,
    fields: Fields<T>,
    /// The shape of the domain.
    domain: Domain<T>,
    /// Reciprocals of `Volume`: the solvers' loops divide by it in every iteration.
    per_volume: Vec<T>,
    /// The grids of a coarse pressure over cells; empty without one.
    levels: Vec<Level>,
    /// What is computed of a coarse pressure.
    coarse: coarse::Vectors<T>,
    direct: Option<DirectSolver>,
    solve: SolveInfo,
    viscous_solve: SolveInfo,
    fallbacks: u32,
    spent: Spent,
}

impl<T: Real> CpuEngine<T> {
    /// Allocates the plan's arrays and fills in what the scene begins with. The setup operations are yet to run.
    pub fn new(scene: Arc<Scene>) -> Result<Self, EngineError> {
        let mut fields = Fields::new(&scene.plan, scene.sizes);
        for (buffer, data) in scene.initial() {
            fields.write(buffer, &data)?;
        }
        let per_volume = fields.real(Buffer::Volume).map(reciprocals).unwrap_or_default();
        let domain = Domain::new(scene.constants.size, scene.constants.period);
        let levels = if scene.plan.coarsens_over_cells() { levels(&scene.constants.grid) } else { Vec::new() };
        let coarse = coarse::Vectors::new(scene.sizes.coarse);
        let (solve, viscous_solve, spent) = (SolveInfo::default(), SolveInfo::default(), Spent::default());
        let direct = None;
        Ok(Self {
            scene,
            fields,
            domain,
            per_volume,
            levels,
            coarse,
            direct,
            solve,
            viscous_solve,
            fallbacks: 0,
            spent,
        })
    }

    /// The first entry that is not a number among the fields that carry the flow from step to step, and the source of the
    /// pressure: one that overflows leaves the pressure as it was.
    fn non_finite(&self) -> Result<Option<NonFinite>, EngineError> {
        let points = self.scene.sizes.points;
        let carried = self.scene.plan.carried.iter().map(|&field| Buffer::Carried(field));
        for buffer in [Buffer::Projected, Buffer::Pressure, Buffer::Source].into_iter().chain(carried) {
            let Ok(values) = self.fields.real(buffer) else { continue };
            let width = values.len() / self.scene.padded();
            if let Some(entry) = first_lost(&values[..points * width], |value| !value.is_finite()) {
                return Ok(Some(NonFinite { buffer, point: entry / width }));
            }
        }
        Ok(None)
    }
}

impl<T: Real> Engine for CpuEngine<T> {
    fn info(&self) -> EngineInfo {
        EngineInfo { engine: "cpu", adapter: None, precision: T::NAME }
    }

    fn write(&mut self, buffer: Buffer, data: &Data) -> Result<(), EngineError> {
        self.fields.write(buffer, data)?;
        if buffer == Buffer::Volume {
            self.per_volume = reciprocals(self.fields.real(buffer)?);
        }
        Ok(())
    }

    fn read(&mut self, buffer: Buffer) -> Result<Data, EngineError> {
        self.fields.read(buffer)
    }

    fn read_all(&mut self, arrays: &mut [(Buffer, Data)]) -> Result<Option<(Buffer, usize)>, EngineError> {
        let mut lost = None;
        for (buffer, data) in arrays {
            let entry = self.fields.read_into(*buffer, data)?;
            lost = lost.or(entry.map(|entry| (*buffer, entry)));
        }
        Ok(lost)
    }

    fn apply(&mut self, operation: Operation, clock: &Clock) -> Result<(), EngineError> {
        let started = Instant::now();
        let done = match operation {
            Operation::BuildCells(_)
            | Operation::FindNeighbours(_)
            | Operation::FindLocalNeighbours
            | Operation::Factorise(_)
            | Operation::WidenSupport(_)
            | Operation::AssembleLaplacian
            | Operation::AssembleGradient
            | Operation::AssembleIntegralLaplacian
            | Operation::AssembleIntegralGradient
            | Operation::AssembleCollocated
            | Operation::HoldOutlets => self.geometry(operation),
            Operation::FitVelocity(_)
            | Operation::RemapDeparture
            | Operation::MovePoints
            | Operation::RemapForward
            | Operation::KeepVelocity => self.drift(operation, clock),
            Operation::FindDepartures
            | Operation::CarryVelocity
            | Operation::FitScalar(_)
            | Operation::CarryScalar(_)
            | Operation::Diffuse(..)
            | Operation::HeatWalls(_)
            | Operation::Buoyancy => self.carry(operation, clock),
            Operation::ClearKick
            | Operation::Gravity
            | Operation::EstimateMiddle
            | Operation::Drag
            | Operation::Viscosity(_)
            | Operation::Predict
            | Operation::CorrectByFit
            | Operation::CorrectByAdjoint
            | Operation::HoldWalls
            | Operation::OpenSides(_)
            | Operation::Reflect => self.kick(operation, clock),
            Operation::AdvancePoints
            | Operation::FactoriseMirrored
            | Operation::FitPredicted
            | Operation::FitMirrored
            | Operation::FittedViscosity
            | Operation::FindSurface
            | Operation::AssembleMirrored
            | Operation::AssembleDensity
            | Operation::CorrectMirrored
            | Operation::BoundPush
            | Operation::CorrectByLeast
            | Operation::CorrectByMoments
            | Operation::ShiftPoints
            | Operation::DisplacePoints
            | Operation::Collide => self.move_points(operation, clock),
            Operation::ImplicitViscosity
            | Operation::ImplicitKick
            | Operation::PredictImplicit
            | Operation::AddMeanPressure
            | Operation::RelaxPressure
            | Operation::MeanKickByFit
            | Operation::MeanKickByAdjoint => self.diffuse_velocity(operation, clock),
            Operation::Average | Operation::Gradient | Operation::Laplacian => self.field(operation),
            Operation::Divergence
            | Operation::DivergenceByFit
            | Operation::AddWallFlux
            | Operation::CollocatedSource
            | Operation::Coarsen
            | Operation::ConjugateGradient
            | Operation::Bicgstab
            | Operation::DirectSolve => self.pressure(operation, clock),
        };
        *self.spent.entry(operation).or_default() += started.elapsed().as_secs_f64();
        done
    }

    fn advance(&mut self, steps: u32, clock: &Clock) -> Result<Advance, EngineError> {
        let scene = Arc::clone(&self.scene);
        let mut done = Advance::default();
        while done.steps < steps {
            for &operation in scene.plan.drift.iter().chain(&scene.plan.kick) {
                self.apply(operation, clock)?;
            }
            done.steps += 1;
            done.iterations += u64::from(self.solve.iterations);
            if done.steps % WATCH_EVERY == 0 || done.steps == steps {
                done.trouble = self.non_finite()?;
                if done.trouble.is_some() {
                    break;
                }
            }
        }
        done.fallbacks = std::mem::take(&mut self.fallbacks);
        Ok(done)
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
        let scene = Arc::clone(&self.scene);
        let points = scene.sizes.points;
        let mut reported = self.fields.take(Buffer::Reported)?;
        let velocity = self.fields.real(Buffer::Projected)?;
        let mut measurement =
            measure::speeds(velocity, self.fields.real(Buffer::Volume)?, &mut reported, points, elapsed);
        if scene.cells().is_some() {
            let mut flux = vec![T::zero(); scene.padded()];
            let position = self.standing(Buffer::Position)?;
            let (faces, one) = (self.faces()?, T::from_f64(1.0));
            if scene.fluxes().is_some() {
                conservative::divergence_by_fit(self.fluxes()?, velocity, one, &mut flux);
            } else {
                with_space!(self.domain, space =>
                    conservative::divergence(faces, space, position, velocity, one, &mut flux));
            }
            if scene.plan.through_flow {
                conservative::add_wall_flux(self.fields.real(Buffer::WallFlux)?, one, &mut flux);
            }
            measurement.divergence = measure::rms_density(&flux, self.fields.real(Buffer::Volume)?, points);
        } else if scene.plan.moves() {
            measurement.divergence = self.divergence_of_moving()?;
        } else {
            let mut divergence = vec![T::zero(); scene.padded()];
            let (order, standing, end) = (scene.constants.order, Points::Standing, scene.sizes.interior);
            with_space!(self.domain, space => with_order!(order, [N, F, M] => fits::fitted_divergence(
                self.fits::<_, N, F>(standing, space)?, velocity, end, &mut divergence)));
            measurement.divergence = measure::rms(&divergence, points);
        }
        self.fields.put(Buffer::Reported, reported);
        Ok(measurement)
    }
}

fn reciprocals<T: Real>(values: &[T]) -> Vec<T> {
    values.iter().map(|&value| T::from_f64(1.0) / value).collect()
}
