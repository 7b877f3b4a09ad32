//! The pressure of MPS: the number density in place of the divergence, weighted means in place of fits.
//!
//! Continuous: `lap p = -(rho / dt^2) (n* - n0) / n0` (3.1), `p = 0` at the free surface. Discrete, multiplied by
//! `lambda n0 / 2 D`: `sum_j w_ij (p_i - p_j) = relaxation (rho / dt^2) (lambda n0 / 2 D) (n*_i - n0) / n0`, symmetric; points
//! behind the walls have no pressure and no part in it. The correction is that of `least.rs`.
//! Source: Koshizuka and Oka, Nucl. Sci. Eng. 123 (1996) 421-434; the relaxed source: Tanaka and Masunaga, J. Comput. Phys. 229
//! (2010) 4279-4290.

use super::mirror::{Around, Stencil};
use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::operations::integral::{DIMENSIONS, Lattice, weight};
use crate::cpu::operations::lists::{Lists, PACKS};
use crate::cpu::operations::pressure::Rows;
use crate::cpu::real::{Pack, Real};

/// The symmetric matrix: the factor of `p_i - p_j` for every neighbour slot, blocked.
#[derive(Clone, Copy)]
pub struct Symmetric<'a, T> {
    pub lists: Lists<'a>,
    pub row: &'a [T],
    /// Points that have a pressure: those behind them have no row.
    pub pressured: usize,
    /// What a source of this matrix is multiplied by to be one of the pressure's Laplacian, 1/m^2.
    pub per_area: T,
}

impl<T: Real> Rows<T> for Symmetric<'_, T> {
    #[inline(always)]
    fn products(&self, block: usize, p: &[T]) -> [T::Pack; PACKS] {
        let mut sums = self.lists.differences(block, self.row, p);
        for (sum, i) in sums.iter_mut().zip(blocks::packs::<T>(block, usize::MAX)) {
            *sum = if i < self.pressured { -*sum } else { T::Pack::zero() };
        }
        sums
    }

    #[inline(always)]
    fn measure(&self, _: usize, residual: T::Pack, size: T::Pack, sums: &mut [T::Pack]) {
        let scale = T::Pack::splat(self.per_area);
        let (residual, size) = (residual * scale, size * scale);
        sums[0] += residual * residual;
        sums[1] += size * size;
    }
}

/// `2 D / (lambda n0)`, 1/m^2.
pub fn per_area(lattice: Lattice) -> f64 {
    2.0 * DIMENSIONS / (lattice.spread * lattice.density)
}

/// Fills rows, diagonal and source; the pressure becomes 0 at the surface and behind the walls. `stiffness` is
/// `relaxation (rho / dt^2) (lambda n0 / 2 D)`, Pa.
pub fn assemble<T: Real>(
    around: Around<T>,
    stiffness: T,
    pressured: usize,
    crowding: &[T],
    surface: &[u32],
    row: &mut [T],
    [diagonal, source, pressure]: [&mut [T]; 3],
) {
    let slots = around.lists.capacity;
    let one = T::from_f64(1.0);
    let held = |i: usize| if i >= pressured || surface[i] != 0 { T::zero() } else { one };
    let has = |i: usize| if i >= pressured { T::zero() } else { one };
    let scalars = [(diagonal, 1), (source, 1), (pressure, 1)];
    blocks::for_each_4((row, slots), scalars, &|block, row, diagonal, source, pressure| {
        for first in (0..BLOCK).step_by(T::Pack::LANES) {
            let i = block * BLOCK + first;
            let inside = T::Pack::from_lanes(|lane| held(i + lane));
            let mut sum = T::Pack::zero();
            Stencil::new(around, i).for_each(|near| {
                let other = T::Pack::from_lanes(|lane| has(near.index[lane] as usize));
                let entry = inside * other * weight::<T>(near.square);
                entry.store(&mut row[near.slot * BLOCK + first..]);
                sum += entry;
            });
            for lane in 0..T::Pack::LANES {
                let (at, free) = (first + lane, inside.lane(lane) == T::zero());
                diagonal[at] = if free || sum.lane(lane) == T::zero() { one } else { sum.lane(lane) };
                source[at] = stiffness * (crowding[i + lane] - one);
                if free {
                    (source[at], pressure[at]) = (T::zero(), T::zero());
                }
            }
        }
    });
}

/// Divergence of a velocity by the weighted mean (2.3), 1/s, at the points below `end` that are not the surface; `scale` is `D / n0`.
pub fn divergence<T: Real>(
    around: Around<T>,
    scale: T,
    velocity: &[T],
    surface: &[u32],
    end: usize,
    divergence: &mut [T],
) {
    blocks::for_each(divergence, 1, &|block, out| {
        for i in blocks::packs::<T>(block, end) {
            let own = T::Pack::load_vectors(&velocity[2 * i..]);
            let zero = T::Pack::zero();
            let (mut sum, stencil) = (zero, Stencil::new(around, i));
            stencil.for_each(|near| {
                // SAFETY: every stored neighbour is below the number of points.
                let [u, v] = unsafe { T::Pack::gather_vectors(velocity, near.index) };
                let per_square = near.square.select_above(zero, weight::<T>(near.square) / near.square, zero);
                sum += per_square * ((u - own[0]) * near.offset[0] + (v - own[1]) * near.offset[1]);
            });
            let value = sum * stencil.per_radius * T::Pack::splat(scale);
            for lane in 0..T::Pack::LANES.min(end - i) {
                let free = surface[i + lane] != 0;
                out[i - block * BLOCK + lane] = if free { T::zero() } else { value.lane(lane) };
            }
        }
    });
}
