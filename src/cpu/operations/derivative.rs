//! Derivatives by least squares: viscosity, the pressure gradient, and the fits that the remap evaluates.

use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::operations::fit::Stencil;
use crate::cpu::operations::moments::{self, COEFFICIENTS, FACTOR, WeightFunction};
use crate::cpu::real::{Pack, Real};

/// The points, their neighbours and their factorised normal matrices: all that a fit needs but the field.
#[derive(Clone, Copy)]
pub struct Fits<'a, T, W> {
    pub position: &'a [T],
    pub support: &'a [T],
    pub neighbours: &'a [u32],
    pub count: &'a [u32],
    pub capacity: usize,
    pub factor: &'a [T],
    pub weight: W,
}

impl<T: Real, W: WeightFunction> Fits<'_, T, W> {
    #[inline(always)]
    pub fn stencil(&self, i: usize) -> Stencil<'_, T> {
        Stencil::new(self.position, self.support, self.neighbours, self.count, self.capacity, i)
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

    /// Scaled coefficients `a1 .. a5` of a scalar field at the points `i..i + LANES`.
    #[inline(always)]
    fn scalar(&self, i: usize, field: &[T]) -> ([T::Pack; COEFFICIENTS], T::Pack) {
        let own = T::Pack::load(&field[i..]);
        let mut right = [T::Pack::zero(); COEFFICIENTS];
        let stencil = self.stencil(i);
        stencil.for_each(|index, [x, y], square| {
            // SAFETY: as in `Stencil::for_each`.
            let difference = unsafe { T::Pack::gather(field, index) } - own;
            let weighted = self.weight.weight(square) * difference;
            let basis = moments::basis(x, y);
            for k in 0..COEFFICIENTS {
                right[k] = weighted.mul_add(basis[k], right[k]);
            }
        });
        (moments::solve(&self.factor(i), right), stencil.per_support)
    }

    /// The same for both components of a velocity.
    #[inline(always)]
    pub fn vector(&self, i: usize, field: &[T]) -> ([[T::Pack; COEFFICIENTS]; 2], T::Pack) {
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

/// Adds to the interleaved vectors of points `i..` in `out`, whose first vector is that of point `start`, as far as `end`.
#[inline(always)]
fn add_vectors<T: Real>(out: &mut [T], start: usize, i: usize, end: usize, [x, y]: [T::Pack; 2]) {
    for lane in 0..T::Pack::LANES.min(end.saturating_sub(i)) {
        out[2 * (i - start + lane)] += x.lane(lane);
        out[2 * (i - start + lane) + 1] += y.lane(lane);
    }
}

/// Packs of a block that hold a point below `end`.
#[inline(always)]
pub fn packs<T: Real>(block: usize, end: usize) -> impl Iterator<Item = usize> {
    (block * BLOCK..((block + 1) * BLOCK).min(end)).step_by(T::Pack::LANES)
}

/// Viscosity: `u* += dt nu lap u` at the points below `end`; (2.6), `lap = 2 (a3 + a5) / r_e^2`.
pub fn viscosity<T: Real, W: WeightFunction>(
    fits: Fits<T, W>,
    velocity: &[T],
    diffusion: T,
    end: usize,
    intermediate: &mut [T],
) {
    let twice = T::Pack::splat(diffusion + diffusion);
    blocks::for_each(intermediate, 2, &|block, out| {
        for i in packs::<T>(block, end) {
            let ([u, v], per) = fits.vector(i, velocity);
            let scale = twice * per * per;
            add_vectors::<T>(out, block * BLOCK, i, end, [scale * (u[2] + u[4]), scale * (v[2] + v[4])]);
        }
    });
}

/// Correction by the fitted gradient: `u' = u* - (dt / rho) grad p` at the points below `end`; `grad = (a1, a2) / r_e`.
pub fn correct_by_fit<T: Real, W: WeightFunction>(
    fits: Fits<T, W>,
    pressure: &[T],
    dt_per_density: T,
    end: usize,
    intermediate: &mut [T],
) {
    let factor = T::Pack::splat(-dt_per_density);
    blocks::for_each(intermediate, 2, &|block, out| {
        for i in packs::<T>(block, end) {
            let (a, per) = fits.scalar(i, pressure);
            let scale = factor * per;
            add_vectors::<T>(out, block * BLOCK, i, end, [scale * a[0], scale * a[1]]);
        }
    });
}

/// The five coefficients of the fits of u and of v at every point, scaled by its support radius.
pub fn fit_velocity<T: Real, W: WeightFunction>(fits: Fits<T, W>, velocity: &[T], coefficients: &mut [T]) {
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
pub fn fitted_divergence<T: Real, W: WeightFunction>(
    fits: Fits<T, W>,
    velocity: &[T],
    end: usize,
    divergence: &mut [T],
) {
    blocks::for_each(divergence, 1, &|block, out| {
        for i in packs::<T>(block, end) {
            let ([u, v], per) = fits.vector(i, velocity);
            let value = per * (u[0] + v[1]);
            for lane in 0..T::Pack::LANES.min(end - i) {
                out[i - block * BLOCK + lane] = value.lane(lane);
            }
        }
    });
}
