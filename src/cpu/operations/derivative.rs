//! Derivatives of fields by the rows at hand: viscosity, the pressure gradient, and those of a known field. What the rows are is in [`super::rows`].

use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::operations::lists::{Lists, PACKS, own, own_vectors};
use crate::cpu::real::{Pack, Real};

/// Rows of the Laplacian over the neighbours of every point.
#[derive(Clone, Copy)]
pub struct Laplacian<'a, T> {
    pub lists: Lists<'a>,
    /// 1/m^2
    pub row: &'a [T],
}

impl<T: Real> Laplacian<'_, T> {
    /// Of a scalar field at the points of a block.
    #[inline(always)]
    fn of_scalar(&self, block: usize, field: &[T]) -> [T::Pack; PACKS] {
        let own = own(field, block);
        self.lists.fold(block, self.row, T::Pack::zero(), |sum, pack, index, [factor]| {
            // SAFETY: every stored neighbour is below the number of points.
            let other = unsafe { T::Pack::gather(field, index) };
            factor.mul_add(other - own[pack], sum)
        })
    }

    /// Of both components of a velocity at the points of a block.
    #[inline(always)]
    fn of_vector(&self, block: usize, field: &[T]) -> [[T::Pack; 2]; PACKS] {
        let own = own_vectors(field, block);
        self.lists.fold(block, self.row, [T::Pack::zero(); 2], |sum, pack, index, [factor]| {
            // SAFETY: every stored neighbour is below the number of points.
            let [u, v] = unsafe { T::Pack::gather_vectors(field, index) };
            [factor.mul_add(u - own[pack][0], sum[0]), factor.mul_add(v - own[pack][1], sum[1])]
        })
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
        let load = |slot| T::Pack::load(&self.row[blocks::at(i, slot, 2 * capacity)..]);
        [load(slot), load(capacity + slot)]
    }

    /// Of a scalar field at the points of a block.
    #[inline(always)]
    fn of_scalar(&self, block: usize, field: &[T]) -> [[T::Pack; 2]; PACKS] {
        let own = own(field, block);
        self.lists.fold(block, self.row, [T::Pack::zero(); 2], |sum, pack, index, [x, y]| {
            // SAFETY: every stored neighbour is below the number of points.
            let difference = unsafe { T::Pack::gather(field, index) } - own[pack];
            [x.mul_add(difference, sum[0]), y.mul_add(difference, sum[1])]
        })
    }

    /// Divergence of a velocity at the points of a block: `du/dx + dv/dy`.
    #[inline(always)]
    pub fn divergence(&self, block: usize, field: &[T]) -> [T::Pack; PACKS] {
        let own = own_vectors(field, block);
        self.lists.fold(block, self.row, T::Pack::zero(), |sum, pack, index, [x, y]| {
            // SAFETY: every stored neighbour is below the number of points.
            let [u, v] = unsafe { T::Pack::gather_vectors(field, index) };
            y.mul_add(v - own[pack][1], x.mul_add(u - own[pack][0], sum))
        })
    }
}

/// Viscosity: `kick += dt nu lap u` at the points below `end`.
pub fn viscosity<T: Real>(laplacian: Laplacian<T>, velocity: &[T], diffusion: T, end: usize, kick: &mut [T]) {
    let scale = T::Pack::splat(diffusion);
    blocks::for_each(kick, 2, &|block, out| {
        if block * BLOCK < end {
            for (i, [u, v]) in blocks::packs::<T>(block, end).zip(laplacian.of_vector(block, velocity)) {
                blocks::add_vectors::<T>(out, block * BLOCK, i, end, [scale * u, scale * v]);
            }
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
        if block * BLOCK < end {
            for (i, [x, y]) in blocks::packs::<T>(block, end).zip(gradient.of_scalar(block, pressure)) {
                blocks::add_vectors::<T>(out, block * BLOCK, i, end, [scale * x, scale * y]);
            }
        }
    });
}

/// The gradient of a known field at every point, 1/m.
pub fn gradient<T: Real>(gradient: Gradient<T>, field: &[T], out: &mut [T]) {
    blocks::for_each(out, 2, &|block, out| {
        for (k, sum) in (0..BLOCK).step_by(T::Pack::LANES).zip(gradient.of_scalar(block, field)) {
            T::Pack::store_vectors(sum, &mut out[2 * k..]);
        }
    });
}

/// The Laplacian of a known field at every point, 1/m^2.
pub fn laplacian<T: Real>(laplacian: Laplacian<T>, field: &[T], out: &mut [T]) {
    blocks::for_each(out, 1, &|block, out| {
        for (k, sum) in (0..BLOCK).step_by(T::Pack::LANES).zip(laplacian.of_scalar(block, field)) {
            sum.store(&mut out[k..]);
        }
    });
}
