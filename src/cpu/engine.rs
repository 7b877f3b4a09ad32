//! The CPU engine: the plan's operations on arrays in memory, on all cores.

use std::sync::Arc;
use std::time::Instant;

use crate::cpu::fields::Fields;
use crate::cpu::operations::conservative::{self, Conservative, Faces, Fluxes};
use crate::cpu::operations::derivative::{self, Gradient, Laplacian};
use crate::cpu::operations::fits::{self, Fits};
use crate::cpu::operations::integral::{self, Means};
use crate::cpu::operations::neighbours::Search;
use crate::cpu::operations::pressure::{self, Stop};
use crate::cpu::operations::rows::{self, Lists};
use crate::cpu::operations::space::{Domain, Space};
use crate::cpu::operations::{bicgstab, collocated, conjugate_gradient, fit, kick, measure, neighbours, remap};
use crate::cpu::real::Real;
use crate::direct::DirectSolver;
use crate::engine::{
    Advance, Clock, Data, Engine, EngineError, EngineInfo, Measurement, NonFinite, Outcome, SolveInfo, Spent,
};
use crate::scene::Scene;
use crate::step::{Buffer, Operation, Points};
use crate::{with_order, with_space};

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
    direct: Option<DirectSolver>,
    solve: SolveInfo,
    fallbacks: u32,
    spent: Spent,
}

/// The arrays of a solver are taken out together and put back together.
macro_rules! with_taken {
    ($fields:expr, [$($name:ident = $buffer:expr),*], $body:expr) => {{
        $(let mut $name = $fields.take($buffer)?;)*
        let result = $body;
        $($fields.put($buffer, $name);)*
        result
    }};
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
        let (solve, spent) = (SolveInfo::default(), Spent::default());
        Ok(Self { scene, fields, domain, per_volume, direct: None, solve, fallbacks: 0, spent })
    }

    fn fits<S: Space<T>, const N: usize, const F: usize>(
        &self,
        points: Points,
        space: S,
    ) -> Result<Fits<'_, T, S, N, F>, EngineError> {
        Ok(Fits {
            position: self.fields.real(Buffer::Position(points))?,
            support: self.fields.real(Buffer::Support(points))?,
            lists: self.lists(points)?,
            factor: self.fields.real(Buffer::Factor(points))?,
            weight: self.scene.constants.weight,
            space,
        })
    }

    fn lists(&self, points: Points) -> Result<Lists<'_>, EngineError> {
        Ok(Lists {
            neighbours: self.fields.index(Buffer::Neighbours(points))?,
            count: self.fields.index(Buffer::NeighbourCount(points))?,
            capacity: self.scene.sizes.capacity,
        })
    }

    fn laplacian(&self) -> Result<Laplacian<'_, T>, EngineError> {
        Ok(Laplacian { lists: self.lists(Points::Standing)?, row: self.fields.real(Buffer::LaplacianRow)? })
    }

    fn gradient(&self) -> Result<Gradient<'_, T>, EngineError> {
        Ok(Gradient { lists: self.lists(Points::Standing)?, row: self.fields.real(Buffer::GradientRow)? })
    }

    fn means<S: Space<T>>(&self, space: S) -> Result<Means<'_, T, S>, EngineError> {
        let points = Points::Standing;
        Ok(Means {
            position: self.fields.real(Buffer::Position(points))?,
            support: self.fields.real(Buffer::Support(points))?,
            lists: self.lists(points)?,
            lattice: self.scene.constants.lattice,
            space,
        })
    }

    fn search<S: Space<T>>(&self, points: Points, space: S) -> Result<Search<'_, T, S>, EngineError> {
        Ok(Search {
            position: self.fields.real(Buffer::Position(points))?,
            points: self.scene.sizes.points,
            grid: &self.scene.constants.grid,
            start: self.fields.index(Buffer::CellStart(points))?,
            sorted: self.fields.index(Buffer::CellPoints(points))?,
            space,
        })
    }

    fn faces(&self) -> Result<Faces<'_, T>, EngineError> {
        Ok(Faces {
            neighbours: self.fields.index(Buffer::FaceNeighbours)?,
            weight: self.fields.real(Buffer::FaceWeight)?,
            count: self.fields.index(Buffer::FaceCount)?,
            capacity: self.scene.sizes.face_capacity,
        })
    }

    fn fluxes(&self) -> Result<Fluxes<'_, T>, EngineError> {
        Ok(Fluxes {
            points: self.fields.index(Buffer::FluxPoints)?,
            count: self.fields.index(Buffer::FluxCount)?,
            row: self.fields.real(Buffer::FluxRow)?,
            capacity: self.scene.sizes.flux_capacity,
        })
    }

    /// The points that a force acts on: all where the wall rows of the pressure need it, else those inside.
    fn forced(&self) -> usize {
        let sizes = &self.scene.sizes;
        if self.scene.plan.forces_reach_walls() { sizes.points } else { sizes.interior }
    }

    fn standing(&self, buffer: fn(Points) -> Buffer) -> Result<&[T], EngineError> {
        self.fields.real(buffer(Points::Standing))
    }

    fn geometry(&mut self, operation: Operation) -> Result<(), EngineError> {
        let scene = Arc::clone(&self.scene);
        let (sizes, constants) = (&scene.sizes, &scene.constants);
        match operation {
            Operation::BuildCells(points) => {
                let mut start = self.fields.take_index(Buffer::CellStart(points))?;
                let mut sorted = self.fields.take_index(Buffer::CellPoints(points))?;
                let position = self.fields.real(Buffer::Position(points))?;
                neighbours::build_cells(position, sizes.points, &constants.grid, &mut start, &mut sorted);
                self.fields.put_index(Buffer::CellStart(points), start);
                self.fields.put_index(Buffer::CellPoints(points), sorted);
            }
            Operation::FindNeighbours(points) => {
                let mut found = self.fields.take_index(Buffer::Neighbours(points))?;
                let mut count = self.fields.take_index(Buffer::NeighbourCount(points))?;
                let most = with_space!(self.domain, space => neighbours::find_neighbours(
                    self.search(points, space)?,
                    T::from_f64(constants.radius),
                    sizes.capacity,
                    &mut found,
                    &mut count,
                ));
                self.fields.put_index(Buffer::Neighbours(points), found);
                self.fields.put_index(Buffer::NeighbourCount(points), count);
                if most > sizes.capacity {
                    return Err(EngineError::NeighbourOverflow { found: most as u32, capacity: sizes.capacity });
                }
                // The ladder of an earlier search may have widened some.
                with_taken!(self.fields, [support = Buffer::Support(points)], {
                    support.fill(T::from_f64(constants.radius));
                });
            }
            Operation::Factorise(points) => {
                let mut factor = self.fields.take(Buffer::Factor(points))?;
                let mut rung = self.fields.take_index(Buffer::Rung(points))?;
                with_space!(self.domain, space => with_order!(constants.order, [N, F, M] => fit::factorise::<T, _, N, F, M>(
                    space,
                    self.fields.real(Buffer::Position(points))?,
                    self.fields.real(Buffer::Support(points))?,
                    self.lists(points)?,
                    constants.weight,
                    &mut factor,
                    &mut rung,
                )));
                self.fields.put(Buffer::Factor(points), factor);
                self.fields.put_index(Buffer::Rung(points), rung);
            }
            Operation::WidenSupport(points) => {
                let mut factor = self.fields.take(Buffer::Factor(points))?;
                let mut rung = self.fields.take_index(Buffer::Rung(points))?;
                let mut support = self.fields.take(Buffer::Support(points))?;
                let mut found = self.fields.take_index(Buffer::Neighbours(points))?;
                let mut count = self.fields.take_index(Buffer::NeighbourCount(points))?;
                with_space!(self.domain, space => with_order!(constants.order, [N, F, M] => fit::widen_support::<T, _, N, F, M>(
                    self.search(points, space)?,
                    sizes.capacity,
                    constants.weight,
                    &mut support,
                    &mut found,
                    &mut count,
                    &mut factor,
                    &mut rung,
                )));
                self.fields.put(Buffer::Factor(points), factor);
                self.fields.put_index(Buffer::Rung(points), rung);
                self.fields.put(Buffer::Support(points), support);
                self.fields.put_index(Buffer::Neighbours(points), found);
                self.fields.put_index(Buffer::NeighbourCount(points), count);
            }
            Operation::AssembleLaplacian => {
                with_taken!(self.fields, [row = Buffer::LaplacianRow], {
                    let standing = Points::Standing;
                    with_space!(self.domain, space => with_order!(constants.order, [N, F, M] =>
                        rows::assemble_laplacian(self.fits::<_, N, F>(standing, space)?, &mut row)));
                });
            }
            Operation::AssembleGradient => {
                with_taken!(self.fields, [row = Buffer::GradientRow], {
                    let standing = Points::Standing;
                    with_space!(self.domain, space => with_order!(constants.order, [N, F, M] =>
                        rows::assemble_gradient(self.fits::<_, N, F>(standing, space)?, &mut row)));
                });
            }
            Operation::AssembleIntegralLaplacian => {
                with_taken!(self.fields, [row = Buffer::LaplacianRow], {
                    with_space!(self.domain, space =>
                        integral::assemble_integral_laplacian(self.means(space)?, &mut row));
                });
            }
            Operation::AssembleIntegralGradient => {
                with_taken!(self.fields, [row = Buffer::GradientRow], {
                    with_space!(self.domain, space =>
                        integral::assemble_integral_gradient(self.means(space)?, &mut row));
                });
            }
            _ => {
                with_taken!(
                    self.fields,
                    [row = Buffer::MatrixRow, scale = Buffer::RowScale, diagonal = Buffer::Diagonal],
                    collocated::assemble(
                        self.fields.real(Buffer::LaplacianRow)?,
                        self.gradient()?,
                        self.fields.real(Buffer::Normal)?,
                        [sizes.interior, sizes.points],
                        &mut row,
                        &mut scale,
                        &mut diagonal,
                    )
                );
            }
        }
        Ok(())
    }

    /// What is done to a known field.
    fn field(&mut self, operation: Operation) -> Result<(), EngineError> {
        match operation {
            Operation::Average => {
                with_taken!(self.fields, [out = Buffer::FieldAverage], {
                    let field = self.fields.real(Buffer::Field)?;
                    with_space!(self.domain, space => integral::average(self.means(space)?, field, &mut out));
                });
            }
            Operation::Gradient => {
                with_taken!(self.fields, [out = Buffer::FieldGradient], {
                    derivative::gradient(self.gradient()?, self.fields.real(Buffer::Field)?, &mut out);
                });
            }
            _ => {
                with_taken!(self.fields, [out = Buffer::FieldLaplacian], {
                    derivative::laplacian(self.laplacian()?, self.fields.real(Buffer::Field)?, &mut out);
                });
            }
        }
        Ok(())
    }

    fn drift(&mut self, operation: Operation, clock: &Clock) -> Result<(), EngineError> {
        let scene = Arc::clone(&self.scene);
        let (sizes, constants) = (&scene.sizes, &scene.constants);
        let dt = T::from_f64(clock.dt);
        let moving = scene.plan.moving();
        match operation {
            Operation::FitVelocity(points) => {
                with_taken!(self.fields, [coefficients = Buffer::Coefficients], {
                    let values = self.fields.real(moving)?;
                    with_space!(self.domain, space => with_order!(constants.order, [N, F, M] =>
                        fits::fit_velocity(self.fits::<_, N, F>(points, space)?, values, &mut coefficients)));
                });
            }
            Operation::MovePoints => {
                let place = Buffer::Position(Points::Moved);
                with_taken!(self.fields, [moved = place], {
                    let (standing, velocity) = (self.standing(Buffer::Position)?, self.fields.real(moving)?);
                    with_space!(self.domain, space =>
                        remap::move_points(space, standing, velocity, dt, sizes.interior, &mut moved));
                });
            }
            Operation::RemapForward => {
                with_taken!(self.fields, [velocity = Buffer::Velocity], {
                    with_space!(self.domain, space => with_order!(constants.order, [N, F, M] => remap::remap_forward::<T, _, N>(
                        space,
                        self.standing(Buffer::Position)?,
                        self.fields.real(Buffer::Position(Points::Moved))?,
                        self.fields.real(Buffer::Support(Points::Moved))?,
                        self.fields.real(moving)?,
                        self.fields.real(Buffer::Coefficients)?,
                        sizes.interior,
                        &mut velocity,
                    )));
                });
            }
            Operation::KeepVelocity => {
                with_taken!(self.fields, [velocity = Buffer::Velocity], {
                    velocity.copy_from_slice(self.fields.real(moving)?);
                });
            }
            _ => {
                let [around, around_count] = scene.plan.around();
                with_taken!(self.fields, [velocity = Buffer::Velocity], {
                    with_space!(self.domain, space => with_order!(constants.order, [N, F, M] => remap::remap_departure::<T, _, N>(
                        space,
                        self.standing(Buffer::Position)?,
                        self.standing(Buffer::Support)?,
                        remap::Around {
                            neighbours: self.fields.index(around)?,
                            count: self.fields.index(around_count)?,
                            capacity: scene.plan.around_capacity(sizes),
                        },
                        self.fields.real(moving)?,
                        self.fields.real(Buffer::Coefficients)?,
                        dt,
                        sizes.interior,
                        &mut velocity,
                    )));
                });
            }
        }
        Ok(())
    }

    fn kick(&mut self, operation: Operation, clock: &Clock) -> Result<(), EngineError> {
        let scene = Arc::clone(&self.scene);
        let (sizes, constants) = (&scene.sizes, &scene.constants);
        let kick_per_density = T::from_f64(clock.kick / constants.density);
        match operation {
            Operation::ClearKick => {
                with_taken!(self.fields, [kick = Buffer::Kick], kick.fill(T::zero()));
            }
            Operation::EstimateMiddle => {
                with_taken!(self.fields, [middle = Buffer::Projected, kick = Buffer::Kick], {
                    let velocity = self.fields.real(Buffer::Velocity)?;
                    kick::estimate_middle(velocity, self.fields.real(Buffer::PressureKick)?, &mut middle, &mut kick);
                });
            }
            Operation::Viscosity(stage) => {
                let diffusion = T::from_f64(clock.kick * constants.viscosity);
                with_taken!(self.fields, [kick = Buffer::Kick], {
                    let field = self.fields.real(stage.velocity())?;
                    derivative::viscosity(self.laplacian()?, field, diffusion, self.forced(), &mut kick);
                });
            }
            Operation::Predict => {
                with_taken!(self.fields, [predicted = Buffer::Projected], {
                    let velocity = self.fields.real(Buffer::Velocity)?;
                    kick::predict(velocity, self.fields.real(Buffer::Kick)?, &mut predicted);
                });
            }
            Operation::CorrectByFit => {
                with_taken!(self.fields, [projected = Buffer::Projected], {
                    let pressure = self.fields.real(Buffer::Pressure)?;
                    let end = sizes.interior;
                    derivative::correct_by_fit(self.gradient()?, pressure, kick_per_density, end, &mut projected);
                });
            }
            Operation::CorrectByAdjoint => {
                with_taken!(self.fields, [projected = Buffer::Projected], {
                    with_space!(self.domain, space => conservative::correct_by_adjoint(
                        self.faces()?,
                        space,
                        self.standing(Buffer::Position)?,
                        self.fields.real(Buffer::Volume)?,
                        self.fields.real(Buffer::Pressure)?,
                        kick_per_density,
                        sizes.interior,
                        &mut projected,
                    ));
                });
            }
            Operation::HoldWalls => {
                with_taken!(self.fields, [projected = Buffer::Projected], {
                    let walls = 2 * sizes.interior..;
                    projected[walls.clone()].copy_from_slice(&self.fields.real(Buffer::Velocity)?[walls]);
                });
            }
            _ => {
                let second = T::from_f64(clock.second_kick);
                with_taken!(self.fields, [mean = Buffer::PressureKick, reflected = Buffer::Reflected], {
                    let velocity = self.fields.real(Buffer::Velocity)?;
                    let (middle, kick) = (self.fields.real(Buffer::Projected)?, self.fields.real(Buffer::Kick)?);
                    kick::reflect(velocity, middle, kick, second, sizes.interior, &mut mean, &mut reflected);
                });
            }
        }
        Ok(())
    }

    fn pressure(&mut self, operation: Operation, clock: &Clock) -> Result<(), EngineError> {
        let scene = Arc::clone(&self.scene);
        let (sizes, constants) = (&scene.sizes, &scene.constants);
        let density_per_kick = constants.density / clock.kick;
        match operation {
            Operation::Divergence => {
                with_taken!(self.fields, [source = Buffer::Source], {
                    let scale = T::from_f64(-density_per_kick);
                    let velocity = self.fields.real(Buffer::Projected)?;
                    let (faces, position) = (self.faces()?, self.standing(Buffer::Position)?);
                    with_space!(self.domain, space =>
                        conservative::divergence(faces, space, position, velocity, scale, &mut source));
                });
            }
            Operation::DivergenceByFit => {
                with_taken!(self.fields, [source = Buffer::Source], {
                    let scale = T::from_f64(-density_per_kick);
                    let velocity = self.fields.real(Buffer::Projected)?;
                    conservative::divergence_by_fit(self.fluxes()?, velocity, scale, &mut source);
                });
            }
            Operation::AddWallFlux => {
                with_taken!(self.fields, [source = Buffer::Source], {
                    let scale = T::from_f64(-density_per_kick);
                    conservative::add_wall_flux(self.fields.real(Buffer::WallFlux)?, scale, &mut source);
                });
            }
            Operation::CollocatedSource => {
                with_taken!(self.fields, [source = Buffer::Source], {
                    collocated::source(
                        self.gradient()?,
                        self.fields.real(Buffer::Normal)?,
                        self.fields.real(Buffer::RowScale)?,
                        self.fields.real(Buffer::Velocity)?,
                        self.fields.real(Buffer::Projected)?,
                        T::from_f64(density_per_kick),
                        [sizes.interior, sizes.points],
                        &mut source,
                    );
                });
            }
            Operation::DirectSolve => self.solve_directly()?,
            _ => {
                let stop = Stop {
                    residual: constants.tolerance * density_per_kick / clock.dt,
                    max_iterations: constants.max_iterations,
                    floor: constants.floor,
                };
                self.solve = match operation {
                    Operation::ConjugateGradient => self.conjugate_gradient(stop)?,
                    _ => self.bicgstab(stop)?,
                };
                if self.solve.outcome != Outcome::Converged {
                    self.solve_directly()?;
                    self.fallbacks += u32::from(self.solve.outcome == Outcome::Converged);
                }
            }
        }
        Ok(())
    }

    fn conservative(&self) -> Result<Conservative<'_, T>, EngineError> {
        Ok(Conservative { faces: self.faces()?, per_volume: &self.per_volume })
    }

    fn collocated(&self) -> Result<collocated::Collocated<'_, T>, EngineError> {
        Ok(collocated::Collocated { lists: self.lists(Points::Standing)?, row: self.fields.real(Buffer::MatrixRow)? })
    }

    fn conjugate_gradient(&mut self, stop: Stop) -> Result<SolveInfo, EngineError> {
        let points = self.scene.sizes.points;
        Ok(with_taken!(
            self.fields,
            [
                pressure = Buffer::Pressure,
                residual = Buffer::Residual,
                direction = Buffer::Direction,
                product = Buffer::Product
            ],
            {
                let (diagonal, source) = (self.fields.real(Buffer::Diagonal)?, self.fields.real(Buffer::Source)?);
                let (residual, direction, product) = (&mut residual[..], &mut direction[..], &mut product[..]);
                let work = conjugate_gradient::Work { residual, direction, product };
                conjugate_gradient::solve(&self.conservative()?, diagonal, points, source, stop, work, &mut pressure)
            }
        ))
    }

    fn bicgstab(&mut self, stop: Stop) -> Result<SolveInfo, EngineError> {
        let (points, shift) = (self.scene.sizes.points, self.scene.constants.shift);
        Ok(with_taken!(
            self.fields,
            [
                pressure = Buffer::Pressure,
                residual = Buffer::Residual,
                direction = Buffer::Direction,
                product = Buffer::Product,
                shadow = Buffer::Shadow,
                stabilised = Buffer::Stabilised,
                stabilised_product = Buffer::StabilisedProduct,
                preconditioned = Buffer::Preconditioned
            ],
            {
                let (diagonal, source) = (self.fields.real(Buffer::Diagonal)?, self.fields.real(Buffer::Source)?);
                let work = bicgstab::Work {
                    residual: &mut residual,
                    direction: &mut direction,
                    product: &mut product,
                    shadow: &mut shadow,
                    stabilised: &mut stabilised,
                    stabilised_product: &mut stabilised_product,
                    preconditioned: &mut preconditioned,
                };
                if self.scene.cells().is_some() {
                    let matrix = self.conservative()?;
                    bicgstab::solve(&matrix, diagonal, points, shift, source, stop, work, &mut pressure)
                } else {
                    let matrix = self.collocated()?;
                    bicgstab::solve(&matrix, diagonal, points, shift, source, stop, work, &mut pressure)
                }
            }
        ))
    }

    /// Leaves everything as it is where the source is not finite: the fields it came from are, and stop the run.
    fn solve_directly(&mut self) -> Result<(), EngineError> {
        if self.fields.real(Buffer::Source)?.iter().any(|value| !value.is_finite()) {
            self.solve.outcome = Outcome::BrokeDown;
            return Ok(());
        }
        if self.direct.is_none() {
            self.direct = Some(DirectSolver::new(&self.scene, &mut |buffer| self.fields.read(buffer))?);
        }
        let source = self.fields.read(Buffer::Source)?;
        if let (Some(direct), Data::Real(source)) = (&self.direct, source) {
            let pressure = direct.solve(&source)?;
            self.fields.write(Buffer::Pressure, &self.scene.scalars(&pressure, 0.0))?;
            let (points, source) = (self.scene.sizes.points, self.fields.real(Buffer::Source)?);
            let pressure = self.fields.real(Buffer::Pressure)?;
            self.solve.last_residual = match self.scene.cells() {
                Some(_) => pressure::residual(&self.conservative()?, points, source, pressure),
                None => pressure::residual(&self.collocated()?, points, source, pressure),
            };
            self.solve.outcome = Outcome::Converged;
        }
        Ok(())
    }

    /// The first entry that is not a number among the fields that carry the flow from step to step, and the source of the
    /// pressure: one that overflows leaves the pressure as it was.
    fn non_finite(&self) -> Result<Option<NonFinite>, EngineError> {
        let points = self.scene.sizes.points;
        for buffer in [Buffer::Projected, Buffer::Pressure, Buffer::Source] {
            let Ok(values) = self.fields.real(buffer) else { continue };
            let width = values.len() / self.scene.padded();
            if let Some(entry) = values[..points * width].iter().position(|value| !value.is_finite()) {
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

    fn apply(&mut self, operation: Operation, clock: &Clock) -> Result<(), EngineError> {
        let started = Instant::now();
        let done = match operation {
            Operation::BuildCells(_)
            | Operation::FindNeighbours(_)
            | Operation::Factorise(_)
            | Operation::WidenSupport(_)
            | Operation::AssembleLaplacian
            | Operation::AssembleGradient
            | Operation::AssembleIntegralLaplacian
            | Operation::AssembleIntegralGradient
            | Operation::AssembleCollocated => self.geometry(operation),
            Operation::FitVelocity(_)
            | Operation::RemapDeparture
            | Operation::MovePoints
            | Operation::RemapForward
            | Operation::KeepVelocity => self.drift(operation, clock),
            Operation::ClearKick
            | Operation::EstimateMiddle
            | Operation::Viscosity(_)
            | Operation::Predict
            | Operation::CorrectByFit
            | Operation::CorrectByAdjoint
            | Operation::HoldWalls
            | Operation::Reflect => self.kick(operation, clock),
            Operation::Average | Operation::Gradient | Operation::Laplacian => self.field(operation),
            Operation::Divergence
            | Operation::DivergenceByFit
            | Operation::AddWallFlux
            | Operation::CollocatedSource
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
