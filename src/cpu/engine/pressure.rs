//! The pressure: its source, its solvers, and the direct one where they stall.

use std::sync::Arc;

use super::{CpuEngine, with_taken};
use crate::cpu::operations::conservative::{self, Conservative};
use crate::cpu::operations::pressure::{self, Stop};
use crate::cpu::operations::{bicgstab, collocated, conjugate_gradient};
use crate::cpu::real::Real;
use crate::direct::DirectSolver;
use crate::engine::{Clock, Data, EngineError, Outcome, SolveInfo};
use crate::step::{Buffer, Operation, Points};
use crate::with_space;

impl<T: Real> CpuEngine<T> {
    pub(super) fn pressure(&mut self, operation: Operation, clock: &Clock) -> Result<(), EngineError> {
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
                    singular: constants.singular,
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

    pub(super) fn conservative(&self) -> Result<Conservative<'_, T>, EngineError> {
        Ok(Conservative { faces: self.faces()?, per_volume: &self.per_volume })
    }

    pub(super) fn collocated(&self) -> Result<collocated::Collocated<'_, T>, EngineError> {
        Ok(collocated::Collocated { lists: self.lists(Points::Standing)?, row: self.fields.real(Buffer::MatrixRow)? })
    }

    pub(super) fn conjugate_gradient(&mut self, stop: Stop) -> Result<SolveInfo, EngineError> {
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

    pub(super) fn bicgstab(&mut self, stop: Stop) -> Result<SolveInfo, EngineError> {
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
    pub(super) fn solve_directly(&mut self) -> Result<(), EngineError> {
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
            let singular = self.scene.constants.singular;
            self.solve.last_residual = match self.scene.cells() {
                Some(_) => pressure::residual(&self.conservative()?, points, singular, source, pressure),
                None => pressure::residual(&self.collocated()?, points, singular, source, pressure),
            };
            self.solve.outcome = Outcome::Converged;
        }
        Ok(())
    }
}
