//! The collocated form of the pressure equation: the paper's (3.2), one row a point.
//!
//! Continuous: `lap p = (rho / dt) div u*` inside, `n . grad p = rho n . (u*_b - u_wall) / dt` on walls, slip sides and inlets,
//! `p = 0` at outlets.
//! Discrete:   `sum_j m_ij (p_j - p_i) = b_i`, `m` the row of the Laplacian inside (2.6), that of the normal derivative at
//! walls, multiplied so that it is as large as the Laplacian's row there.
//! The paper prints `-(rho / dt^2) grad u*` as the source: its units do not fit; the power of dt and the sign are
//! misprints. `u*_b` is the predicted velocity at the wall point, not overwritten by the wall's.
//! The matrix is not symmetric, and its left null vector is not the constant.

use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::operations::derivative::Gradient;
use crate::cpu::operations::lists::{Lists, PACKS};
use crate::cpu::operations::pressure::Rows;
use crate::cpu::real::{Pack, Real};

/// The rows: the factor of `p_j - p_i` for every neighbour slot, blocked.
#[derive(Clone, Copy)]
pub struct Collocated<'a, T> {
    pub lists: Lists<'a>,
    pub row: &'a [T],
}

impl<T: Real> Rows<T> for Collocated<'_, T> {
    #[inline(always)]
    fn products(&self, block: usize, p: &[T]) -> [T::Pack; PACKS] {
        self.lists.differences(block, self.row, p)
    }

    #[inline(always)]
    fn measure(&self, _: usize, residual: T::Pack, size: T::Pack, sums: &mut [T::Pack]) {
        sums[0] += residual * residual;
        sums[1] += size * size;
    }
}

/// Fills the rows, the diagonal `-sum_j m_ij`, and what the rows of walls were multiplied by.
pub fn assemble<T: Real>(
    laplacian: &[T],
    gradient: Gradient<T>,
    normal: &[T],
    [interior, points]: [usize; 2],
    row: &mut [T],
    scale: &mut [T],
    diagonal: &mut [T],
) {
    let slots = gradient.lists.capacity;
    let one = T::from_f64(1.0);
    blocks::for_each_3((row, slots), (scale, 1), (diagonal, 1), &|block, row, scale, diagonal| {
        for first in (0..BLOCK).step_by(T::Pack::LANES) {
            let i = block * BLOCK + first;
            let [nx, ny] = T::Pack::load_vectors(&normal[2 * i..]);
            let of_laplacian = |slot: usize| T::Pack::load(&laplacian[blocks::at(i, slot, slots)..]);
            let outward = |slot: usize| {
                let [x, y] = gradient.factors(i, slot);
                nx * x + ny * y
            };
            let mut sums = [T::Pack::zero(); 2];
            gradient.lists.for_each::<T>(i, |slot, _| {
                sums[0] += of_laplacian(slot);
                sums[1] += outward(slot);
            });
            // A wall's row: the normal derivative, with the sign and the size of the Laplacian's diagonal.
            let wall = sums[0] / sums[1];
            let at_wall = |i: usize| i >= interior && i < points;
            let factor = T::Pack::from_lanes(|lane| if at_wall(i + lane) { wall.lane(lane) } else { one });
            let inside = T::Pack::from_lanes(|lane| if at_wall(i + lane) { T::zero() } else { one });
            let mut sum = T::Pack::zero();
            gradient.lists.for_each::<T>(i, |slot, _| {
                let from_normal = factor * outward(slot);
                let entry = from_normal + inside * (of_laplacian(slot) - from_normal);
                entry.store(&mut row[slot * BLOCK + first..]);
                sum += entry;
            });
            for lane in 0..T::Pack::LANES {
                scale[first + lane] = factor.lane(lane);
                diagonal[first + lane] = if i + lane < points { -sum.lane(lane) } else { one };
            }
        }
    });
}

/// Empties the rows of outlets: `p = 0` there, whatever their source, which is scaled by 0.
pub fn hold_outlets<T: Real>(
    outlet: &[u32],
    [interior, points]: [usize; 2],
    slots: usize,
    row: &mut [T],
    scale: &mut [T],
    diagonal: &mut [T],
) {
    for i in (interior..points).filter(|&i| outlet[i] != 0) {
        (0..slots).for_each(|slot| row[blocks::at(i, slot, slots)] = T::zero());
        (scale[i], diagonal[i]) = (T::zero(), T::from_f64(1.0));
    }
}

/// The right side: `(rho / dt) div u*` inside, the scaled normal derivative at walls.
pub fn source<T: Real>(
    gradient: Gradient<T>,
    normal: &[T],
    scale: &[T],
    velocity: &[T],
    predicted: &[T],
    density_per_dt: T,
    [interior, points]: [usize; 2],
    source: &mut [T],
) {
    blocks::for_each(source, 1, &|block, out| {
        if block * BLOCK < interior {
            for (i, divergence) in blocks::packs::<T>(block, interior).zip(gradient.divergence(block, predicted)) {
                let value = T::Pack::splat(density_per_dt) * divergence;
                for lane in 0..T::Pack::LANES.min(interior - i) {
                    out[i - block * BLOCK + lane] = value.lane(lane);
                }
            }
        }
        for i in (block * BLOCK).max(interior)..((block + 1) * BLOCK).min(points) {
            let stopped = |c: usize| normal[2 * i + c] * (predicted[2 * i + c] - velocity[2 * i + c]);
            out[i - block * BLOCK] = scale[i] * density_per_dt * (stopped(0) + stopped(1));
        }
    });
}
