//! Derivatives of fields by the rows at hand: viscosity, the pressure gradient, and those of a known field. What the rows are is in [`super::rows`].

use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::operations::lists::Lists;
use crate::cpu::real::{Pack, Real};

/// Rows of the Laplacian over the neighbours of every point.
#[derive(Clone, Copy)]
pub struct Laplacian<'a, T> {
    pub lists: Lists<'a>,
    /// 1/m^2
    pub row: &'a [T],
}

impl<T: Real> Laplacian<'_, T> {
    /// Of a scalar field at the points `i..i + LANES`.
    #[inline(always)]
    fn of_scalar(&self, i: usize, field: &[T]) -> T::Pack {
        let own = T::Pack::load(&field[i..]);
        let first = blocks::at(i, 0, self.lists.capacity);
        let mut sum = T::Pack::zero();
        self.lists.for_each::<T>(i, |slot, index| {
            // SAFETY: every stored neighbour is below the number of points.
            let difference = unsafe { T::Pack::gather(field, index) } - own;
            sum = T::Pack::load(&self.row[first + slot * BLOCK..]).mul_add(difference, sum);
        });
        sum
    }

    /// Of both components of a velocity at the points `i..i + LANES`.
    #[inline(always)]
    fn of_vector(&self, i: usize, field: &[T]) -> [T::Pack; 2] {
        let own = T::Pack::load_vectors(&field[2 * i..]);
        let first = blocks::at(i, 0, self.lists.capacity);
        let mut sum = [T::Pack::zero(); 2];
        self.lists.for_each::<T>(i, |slot, index| {
            // SAFETY: every stored neighbour is below the number of points.
            let [u, v] = unsafe { T::Pack::gather_vectors(field, index) };
            let factor = T::Pack::load(&self.row[first + slot * BLOCK..]);
            sum[0] = factor.mul_add(u - own[0], sum[0]);
            sum[1] = factor.mul_add(v - own[1], sum[1]);
        });
        sum
    }
}

/// Rows of the gradient over the neighbours of every point.
#[derive(Clone, Copy)]
pub struct Gradient<'a, T> {
    pub lists: Lists<'a>,
    /// 1/m; along x, then along y.
    pub row: &'a [T],
}

impl<T: Real> Gradient<'_, T> {
    /// The factors along x and along y of one slot of the points `i..i + LANES`.
    #[inline(always)]
    pub fn factors(&self, i: usize, slot: usize) -> [T::Pack; 2] {
        let capacity = self.lists.capacity;
        [slot, capacity + slot].map(|slot| T::Pack::load(&self.row[blocks::at(i, slot, 2 * capacity)..]))
    }

    /// Of a scalar field at the points `i..i + LANES`.
    #[inline(always)]
    fn of_scalar(&self, i: usize, field: &[T]) -> [T::Pack; 2] {
        let own = T::Pack::load(&field[i..]);
        let mut sum = [T::Pack::zero(); 2];
        self.lists.for_each::<T>(i, |slot, index| {
            // SAFETY: every stored neighbour is below the number of points.
            let difference = unsafe { T::Pack::gather(field, index) } - own;
            let [x, y] = self.factors(i, slot);
            sum = [x.mul_add(difference, sum[0]), y.mul_add(difference, sum[1])];
        });
        sum
    }

    /// Divergence of a velocity at the points `i..i + LANES`: `du/dx + dv/dy`.
    #[inline(always)]
    pub fn divergence(&self, i: usize, field: &[T]) -> T::Pack {
        let own = T::Pack::load_vectors(&field[2 * i..]);
        let mut sum = T::Pack::zero();
        self.lists.for_each::<T>(i, |slot, index| {
            // SAFETY: every stored neighbour is below the number of points.
            let [u, v] = unsafe { T::Pack::gather_vectors(field, index) };
            let [x, y] = self.factors(i, slot);
            sum = y.mul_add(v - own[1], x.mul_add(u - own[0], sum));
        });
        sum
    }
}

/// Viscosity: `kick += dt nu lap u` at the points below `end`.
pub fn viscosity<T: Real>(laplacian: Laplacian<T>, velocity: &[T], diffusion: T, end: usize, kick: &mut [T]) {
    let scale = T::Pack::splat(diffusion);
    blocks::for_each(kick, 2, &|block, out| {
        for i in blocks::packs::<T>(block, end) {
            let sum = laplacian.of_vector(i, velocity);
            blocks::add_vectors::<T>(out, block * BLOCK, i, end, sum.map(|sum| scale * sum));
        }
    });
}

/// Correction by the gradient: `u' = u* - (dt / rho) grad p` at the points below `end`.
pub fn correct_by_fit<T: Real>(
    gradient: Gradient<T>,
    pressure: &[T],
    dt_per_density: T,
    end: usize,
    intermediate: &mut [T],
) {
    let scale = T::Pack::splat(-dt_per_density);
    blocks::for_each(intermediate, 2, &|block, out| {
        for i in blocks::packs::<T>(block, end) {
            let sum = gradient.of_scalar(i, pressure);
            blocks::add_vectors::<T>(out, block * BLOCK, i, end, sum.map(|sum| scale * sum));
        }
    });
}

/// The gradient of a known field at every point, 1/m.
pub fn gradient<T: Real>(gradient: Gradient<T>, field: &[T], out: &mut [T]) {
    blocks::for_each(out, 2, &|block, out| {
        for first in (0..BLOCK).step_by(T::Pack::LANES) {
            T::Pack::store_vectors(gradient.of_scalar(block * BLOCK + first, field), &mut out[2 * first..]);
        }
    });
}

/// The Laplacian of a known field at every point, 1/m^2.
pub fn laplacian<T: Real>(laplacian: Laplacian<T>, field: &[T], out: &mut [T]) {
    blocks::for_each(out, 1, &|block, out| {
        for first in (0..BLOCK).step_by(T::Pack::LANES) {
            laplacian.of_scalar(block * BLOCK + first, field).store(&mut out[first..]);
        }
    });
}
