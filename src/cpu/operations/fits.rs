//! The fits themselves: the coefficients of (2.5) for a velocity, which the remap evaluates.

use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::operations::fit::Stencil;
use crate::cpu::operations::moments::{self, COEFFICIENTS, FACTOR, WeightFunction};
use crate::cpu::operations::space::Space;
use crate::cpu::real::{Pack, Real};

/// The points, their neighbours and their factorised normal matrices: all that a fit needs but the field.
#[derive(Clone, Copy)]
pub struct Fits<'a, T, W, S> {
    pub position: &'a [T],
    pub support: &'a [T],
    pub neighbours: &'a [u32],
    pub count: &'a [u32],
    pub capacity: usize,
    pub factor: &'a [T],
    pub weight: W,
    pub space: S,
}

impl<T: Real, W: WeightFunction, S: Space<T>> Fits<'_, T, W, S> {
    #[inline(always)]
    pub fn stencil(&self, i: usize) -> Stencil<'_, T, S> {
        Stencil::new(self.space, self.position, self.support, self.neighbours, self.count, self.capacity, i)
    }

    #[inline(always)]
    pub fn factor(&self, i: usize) -> [T::Pack; FACTOR] {
        let first = blocks::at(i, 0, FACTOR);
        let values = &self.factor[first..first + (FACTOR - 1) * BLOCK + T::Pack::LANES];
        let mut factor = [T::Pack::zero(); FACTOR];
        for k in 0..FACTOR {
            factor[k] = T::Pack::load(&values[k * BLOCK..]);
        }
        factor
    }

    /// Scaled coefficients `a1 .. a5` of both components of a velocity at the points `i..i + LANES`.
    #[inline(always)]
    fn vector(&self, i: usize, field: &[T]) -> ([[T::Pack; COEFFICIENTS]; 2], T::Pack) {
        let own = T::Pack::load_vectors(&field[2 * i..]);
        let mut right = [[T::Pack::zero(); COEFFICIENTS]; 2];
        let stencil = self.stencil(i);
        stencil.for_each(|index, [x, y], square| {
            // SAFETY: as in `Stencil::for_each`.
            let [u, v] = unsafe { T::Pack::gather_vectors(field, index) };
            let weight = self.weight.weight(square);
            let (u, v) = (weight * (u - own[0]), weight * (v - own[1]));
            let basis = moments::basis(x, y);
            for k in 0..COEFFICIENTS {
                right[0][k] = u.mul_add(basis[k], right[0][k]);
                right[1][k] = v.mul_add(basis[k], right[1][k]);
            }
        });
        let factor = self.factor(i);
        ([moments::solve(&factor, right[0]), moments::solve(&factor, right[1])], stencil.per_support)
    }
}

/// The five coefficients of the fits of u and of v at every point, scaled by its support radius.
pub fn fit_velocity<T: Real, W: WeightFunction, S: Space<T>>(
    fits: Fits<T, W, S>,
    velocity: &[T],
    coefficients: &mut [T],
) {
    blocks::for_each(coefficients, 2 * COEFFICIENTS, &|block, out| {
        for first in (0..BLOCK).step_by(T::Pack::LANES) {
            let (fitted, _) = fits.vector(block * BLOCK + first, velocity);
            for k in 0..COEFFICIENTS {
                fitted[0][k].store(&mut out[k * BLOCK + first..]);
                fitted[1][k].store(&mut out[(COEFFICIENTS + k) * BLOCK + first..]);
            }
        }
    });
}

/// Divergence of the fitted velocity, 1/s: `du/dx + dv/dy`, at the points below `end`; (2.6).
pub fn fitted_divergence<T: Real, W: WeightFunction, S: Space<T>>(
    fits: Fits<T, W, S>,
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
