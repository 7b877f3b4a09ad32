//! The fits themselves: the coefficients of (2.5) for a velocity, which the remap evaluates.

use crate::case::Weight;
use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::operations::fit::Stencil;
use crate::cpu::operations::lists::Lists;
use crate::cpu::operations::moments;
use crate::cpu::operations::space::Space;
use crate::cpu::real::{Pack, Real};

/// The points, their neighbours and their factorised normal matrices: all that a fit of `N` coefficients, whose factor has
/// `F` entries, needs but the field.
#[derive(Clone, Copy)]
pub struct Fits<'a, T, S, const N: usize, const F: usize> {
    pub position: &'a [T],
    pub support: &'a [T],
    pub lists: Lists<'a>,
    pub factor: &'a [T],
    pub weight: Weight,
    pub space: S,
}

impl<T: Real, S: Space<T>, const N: usize, const F: usize> Fits<'_, T, S, N, F> {
    #[inline(always)]
    pub fn stencil(&self, i: usize) -> Stencil<'_, T, S> {
        Stencil::new(self.space, self.position, self.support, self.lists, i)
    }

    #[inline(always)]
    pub fn factor(&self, i: usize) -> [T::Pack; F] {
        let first = blocks::at(i, 0, F);
        let values = &self.factor[first..first + (F - 1) * BLOCK + T::Pack::LANES];
        let mut factor = [T::Pack::zero(); F];
        for k in 0..F {
            factor[k] = T::Pack::load(&values[k * BLOCK..]);
        }
        factor
    }

    /// Scaled coefficients of a scalar field at the points `i..i + LANES`.
    #[inline(always)]
    pub fn scalar(&self, i: usize, field: &[T]) -> [T::Pack; N] {
        let own = T::Pack::load(&field[i..]);
        let mut right = [T::Pack::zero(); N];
        self.stencil(i).for_each(|_, index, [x, y], square| {
            // SAFETY: as in `Stencil::for_each`.
            let difference = unsafe { T::Pack::gather(field, index) } - own;
            let weighted = moments::weight(self.weight, square) * difference;
            let basis: [T::Pack; N] = moments::basis(x, y);
            for k in 0..N {
                right[k] = weighted.mul_add(basis[k], right[k]);
            }
        });
        moments::solve(&self.factor(i), right)
    }

    /// Scaled coefficients of both components of a velocity at the points `i..i + LANES`.
    #[inline(always)]
    fn vector(&self, i: usize, field: &[T]) -> ([[T::Pack; N]; 2], T::Pack) {
        let own = T::Pack::load_vectors(&field[2 * i..]);
        let mut right = [[T::Pack::zero(); N]; 2];
        let stencil = self.stencil(i);
        stencil.for_each(|_, index, [x, y], square| {
            // SAFETY: as in `Stencil::for_each`.
            let [u, v] = unsafe { T::Pack::gather_vectors(field, index) };
            let weight = moments::weight(self.weight, square);
            let (u, v) = (weight * (u - own[0]), weight * (v - own[1]));
            let basis: [T::Pack; N] = moments::basis(x, y);
            for k in 0..N {
                right[0][k] = u.mul_add(basis[k], right[0][k]);
                right[1][k] = v.mul_add(basis[k], right[1][k]);
            }
        });
        let factor = self.factor(i);
        ([moments::solve(&factor, right[0]), moments::solve(&factor, right[1])], stencil.per_support)
    }
}

/// The coefficients of the fits of u and of v at every point, scaled by its support radius.
pub fn fit_velocity<T: Real, S: Space<T>, const N: usize, const F: usize>(
    fits: Fits<T, S, N, F>,
    velocity: &[T],
    coefficients: &mut [T],
) {
    blocks::for_each(coefficients, 2 * N, &|block, out| {
        for first in (0..BLOCK).step_by(T::Pack::LANES) {
            let (fitted, _) = fits.vector(block * BLOCK + first, velocity);
            for k in 0..N {
                fitted[0][k].store(&mut out[k * BLOCK + first..]);
                fitted[1][k].store(&mut out[(N + k) * BLOCK + first..]);
            }
        }
    });
}

/// Divergence of the fitted velocity, 1/s: `du/dx + dv/dy`, at the points below `end`; (2.6).
pub fn fitted_divergence<T: Real, S: Space<T>, const N: usize, const F: usize>(
    fits: Fits<T, S, N, F>,
    velocity: &[T],
    end: usize,
    divergence: &mut [T],
) {
    blocks::for_each(divergence, 1, &|block, out| {
        for i in blocks::packs::<T>(block, end) {
            let ([u, v], per) = fits.vector(i, velocity);
            let value = per * (u[0] + v[1]);
            for lane in 0..T::Pack::LANES.min(end - i) {
                out[i - block * BLOCK + lane] = value.lane(lane);
            }
        }
    });
}
