//! What depends on the places of the points alone: neighbours, fits, rows.

use std::sync::Arc;

use super::{CpuEngine, with_taken};
use crate::cpu::operations::{collocated, fit, integral, neighbours, rows};
use crate::cpu::real::Real;
use crate::engine::EngineError;
use crate::step::{Buffer, Operation, Points};
use crate::{with_order, with_space};

impl<T: Real> CpuEngine<T> {
    pub(super) fn geometry(&mut self, operation: Operation) -> Result<(), EngineError> {
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
            Operation::FindLocalNeighbours => {
                let points = Points::Standing;
                let mut found = self.fields.take_index(Buffer::Neighbours(points))?;
                let mut count = self.fields.take_index(Buffer::NeighbourCount(points))?;
                let most = with_space!(self.domain, space => neighbours::find_local_neighbours(
                    self.search(points, space)?,
                    self.standing(Buffer::Support)?,
                    sizes.capacity,
                    &mut found,
                    &mut count,
                ));
                self.fields.put_index(Buffer::Neighbours(points), found);
                self.fields.put_index(Buffer::NeighbourCount(points), count);
                if most > sizes.capacity {
                    return Err(EngineError::NeighbourOverflow { found: most as u32, capacity: sizes.capacity });
                }
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
            Operation::HoldOutlets => {
                with_taken!(
                    self.fields,
                    [row = Buffer::MatrixRow, scale = Buffer::RowScale, diagonal = Buffer::Diagonal],
                    collocated::hold_outlets(
                        self.fields.index(Buffer::Outlet)?,
                        [sizes.interior, sizes.points],
                        sizes.capacity,
                        &mut row,
                        &mut scale,
                        &mut diagonal,
                    )
                );
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
}
