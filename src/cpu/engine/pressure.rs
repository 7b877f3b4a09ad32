//! The pressure: its source, its solvers, and the direct one where they stall.

use std::sync::Arc;

use super::{CpuEngine, with_taken};
use crate::case::PressureForm;
use crate::cpu::operations::aggregates::Aggregated;
use crate::cpu::operations::coarse::{self, Coarse, Gridded, Grids, Nothing};
use crate::cpu::operations::conservative::{self, Conservative};
use crate::cpu::operations::moving::density::{self, Symmetric};
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
            Operation::Coarsen => self.coarsen()?,
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
        let (lists, row) = (self.lists(Points::Standing)?, self.fields.real(Buffer::MatrixRow)?);
        Ok(collocated::Collocated { lists, row })
    }

    pub(super) fn symmetric(&self) -> Result<Symmetric<'_, T>, EngineError> {
        let (lists, row) = (self.lists(Points::Standing)?, self.fields.real(Buffer::MatrixRow)?);
        let per_area = T::from_f64(density::per_area(self.scene.constants.lattice));
        Ok(Symmetric { lists, row, pressured: self.scene.sizes.pressured, per_area })
    }

    fn grids(&self) -> Result<Grids<'_>, EngineError> {
        Ok(Grids {
            levels: &self.levels,
            start: self.fields.index(Buffer::CellStart(Points::Standing))?,
            sorted: self.fields.index(Buffer::CellPoints(Points::Standing))?,
        })
    }

    fn coarsen(&mut self) -> Result<(), EngineError> {
        let sign = if self.scene.plan.form == Some(PressureForm::Integral) { 1.0 } else { -1.0 };
        let mut cell = self.fields.take_index(Buffer::CoarseCell)?;
        with_taken!(self.fields, [matrix = Buffer::CoarseMatrix], {
            let (lists, row) = (self.lists(Points::Standing)?, self.fields.real(Buffer::MatrixRow)?);
            let (grids, surface) = (self.grids()?, self.fields.index(Buffer::Surface)?);
            coarse::place(grids, surface, self.scene.sizes.pressured, &mut cell);
            coarse::assemble(grids, lists, row, T::from_f64(sign), &cell, &mut matrix);
        });
        self.fields.put_index(Buffer::CoarseCell, cell);
        Ok(())
    }

    pub(super) fn conjugate_gradient(&mut self, stop: Stop) -> Result<SolveInfo, EngineError> {
        let points = self.scene.sizes.points;
        let mut vectors = std::mem::take(&mut self.coarse);
        let info = with_taken!(
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
                let (integral, coarsens) =
                    (self.scene.plan.form == Some(PressureForm::Integral), self.scene.plan.coarsens());
                macro_rules! solve {
                    ($matrix:expr, $coarse:expr) => {
                        conjugate_gradient::solve($matrix, $coarse, diagonal, points, source, stop, work, &mut pressure)
                    };
                }
                match (integral, coarsens) {
                    (true, true) => solve!(&self.symmetric()?, &mut self.coarse(&mut vectors)?),
                    (true, false) => solve!(&self.symmetric()?, &mut Nothing),
                    (false, true) => solve!(&self.conservative()?, &mut self.aggregated(&mut vectors)?),
                    (false, false) => solve!(&self.conservative()?, &mut Nothing),
                }
            }
        );
        self.coarse = vectors;
        Ok(info)
    }

    fn coarse<'a>(&'a self, vectors: &'a mut coarse::Vectors<T>) -> Result<Coarse<'a, T, Gridded<'a, T>>, EngineError> {
        let (cell, matrix) = (self.fields.index(Buffer::CoarseCell)?, self.fields.real(Buffer::CoarseMatrix)?);
        vectors.clear();
        Ok(Coarse { hierarchy: Gridded::new(self.grids()?, matrix), cell, vectors })
    }

    fn aggregated<'a>(
        &'a self,
        vectors: &'a mut coarse::Vectors<T>,
    ) -> Result<Coarse<'a, T, Aggregated<'a, T>>, EngineError> {
        let aggregates = self.scene.aggregates().ok_or(EngineError::Absent(Buffer::AggregateMatrix))?;
        let hierarchy = Aggregated {
            levels: &aggregates.levels,
            start: self.fields.index(Buffer::AggregateStart)?,
            parts: self.fields.index(Buffer::AggregateParts)?,
            parent: self.fields.index(Buffer::AggregateParent)?,
            neighbours: self.fields.index(Buffer::AggregateNeighbours)?,
            matrix: self.fields.real(Buffer::AggregateMatrix)?,
        };
        Ok(Coarse { hierarchy, cell: self.fields.index(Buffer::CoarseCell)?, vectors })
    }

    pub(super) fn bicgstab(&mut self, stop: Stop) -> Result<SolveInfo, EngineError> {
        let (points, shift) = (self.scene.sizes.points, self.scene.constants.shift);
        let mut vectors = std::mem::take(&mut self.coarse);
        let info = with_taken!(
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
                    let (matrix, coarse) = (self.conservative()?, &mut Nothing);
                    bicgstab::solve(&matrix, coarse, diagonal, points, shift, source, stop, work, &mut pressure)
                } else if self.scene.plan.coarsens() {
                    let (matrix, mut coarse) = (self.collocated()?, self.coarse(&mut vectors)?);
                    bicgstab::solve(&matrix, &mut coarse, diagonal, points, shift, source, stop, work, &mut pressure)
                } else {
                    let (matrix, coarse) = (self.collocated()?, &mut Nothing);
                    bicgstab::solve(&matrix, coarse, diagonal, points, shift, source, stop, work, &mut pressure)
                }
            }
        );
        self.coarse = vectors;
        Ok(info)
    }

    /// Leaves everything as it is where the source is not finite: the fields it came from are, and stop the run.
    pub(super) fn solve_directly(&mut self) -> Result<(), EngineError> {
        if self.fields.real(Buffer::Source)?.iter().any(|value| !value.is_finite()) {
            self.solve.outcome = Outcome::BrokeDown;
            return Ok(());
        }
        // The matrix of points that move is another one in every step.
        if self.direct.is_none() || self.scene.plan.moves() {
            self.direct = Some(DirectSolver::new(&self.scene, &mut |buffer| self.fields.read(buffer))?);
        }
        let source = self.fields.read(Buffer::Source)?;
        if let (Some(direct), Data::Real(source)) = (&self.direct, source) {
            let pressure = direct.solve(&source)?;
            self.fields.write(Buffer::Pressure, &self.scene.scalars(&pressure, 0.0))?;
            let (points, source) = (self.scene.sizes.points, self.fields.real(Buffer::Source)?);
            let pressure = self.fields.real(Buffer::Pressure)?;
            let shifted = self.scene.constants.shift.rows;
            self.solve.last_residual = match self.scene.cells() {
                None if self.scene.plan.form == Some(PressureForm::Integral) => {
                    pressure::residual(&self.symmetric()?, points, shifted, source, pressure)
                }
                Some(_) => pressure::residual(&self.conservative()?, points, shifted, source, pressure),
                None => pressure::residual(&self.collocated()?, points, shifted, source, pressure),
            };
            self.solve.outcome = Outcome::Converged;
        }
        Ok(())
    }
}
