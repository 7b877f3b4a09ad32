//! The collocated form of the pressure equation: the paper's (3.2), one row a point.
//!
//! Continuous: `lap p = (rho / dt) div u*` inside, `n . grad p = rho n . (u*_b - u_wall) / dt` on walls.
//! Discrete:   `sum_j m_ij (p_j - p_i) = b_i`, `m` from the least-squares fit: its Laplacian inside (2.6), its normal
//! derivative at walls, multiplied so that the row is as large as the Laplacian's row there.
//! The paper prints `-(rho / dt^2) grad u*` as the source: its units do not fit; the power of dt and the sign are
//! misprints. `u*_b` is the predicted velocity at the wall point, not overwritten by the wall's.
//! The matrix is not symmetric, and its left null vector is not the constant.

use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::operations::derivative::{Fits, packs};
use crate::cpu::operations::moments::{self, COEFFICIENTS, WeightFunction};
use crate::cpu::operations::pressure::Rows;
use crate::cpu::real::{Pack, Real};

/// The rows: the factor of `p_j - p_i` for every neighbour slot, blocked.
#[derive(Clone, Copy)]
pub struct Collocated<'a, T> {
    pub neighbours: &'a [u32],
    pub count: &'a [u32],
    pub capacity: usize,
    pub row: &'a [T],
}

impl<T: Real> Rows<T> for Collocated<'_, T> {
    #[inline(always)]
    fn product(&self, i: usize, p: &[T]) -> T::Pack {
        let rows = self.count[i..i + T::Pack::LANES].iter().copied().max().unwrap_or(0) as usize;
        let first = blocks::at(i, 0, self.capacity);
        let own = T::Pack::load(&p[i..]);
        let mut sum = T::Pack::zero();
        for slot in 0..rows.min(self.capacity) {
            let start = first + slot * BLOCK;
            // SAFETY: every stored neighbour is below the number of points.
            let other = unsafe { T::Pack::gather(p, &self.neighbours[start..start + T::Pack::LANES]) };
            sum += T::Pack::load(&self.row[start..]) * (other - own);
        }
        sum
    }

    #[inline(always)]
    fn measure(&self, _: usize, residual: T::Pack, size: T::Pack, sums: &mut [T::Pack]) {
        sums[0] += residual * residual;
        sums[1] += size * size;
    }
}

/// Fills the rows, the diagonal `-sum_j m_ij`, and what the rows of walls were multiplied by.
pub fn assemble<T: Real, W: WeightFunction>(
    fits: Fits<T, W>,
    normal: &[T],
    points: usize,
    interior: usize,
    row: &mut [T],
    scale: &mut [T],
    diagonal: &mut [T],
) {
    let slots = fits.capacity;
    let two = T::Pack::splat(T::from_f64(2.0));
    let zero = T::Pack::zero();
    blocks::for_each_3((row, slots), (scale, 1), (diagonal, 1), &|block, row, scale, diagonal| {
        for first in (0..BLOCK).step_by(T::Pack::LANES) {
            let i = block * BLOCK + first;
            let factor = fits.factor(i);
            let stencil = fits.stencil(i);
            let per = stencil.per_support;
            let [nx, ny] = T::Pack::load_vectors(&normal[2 * i..]);
            let laplacian = moments::solve(&factor, [zero, zero, two * per * per, zero, two * per * per]);
            let outward = moments::solve(&factor, [nx * per, ny * per, zero, zero, zero]);
            let dot = |c: &[T::Pack; COEFFICIENTS], b: [T::Pack; COEFFICIENTS]| {
                (0..COEFFICIENTS).fold(zero, |sum, k| sum + c[k] * b[k])
            };
            let mut sums = [zero; 2];
            stencil.for_each(|_, [x, y], square| {
                let (weight, basis) = (fits.weight.weight(square), moments::basis(x, y));
                sums[0] += weight * dot(&laplacian, basis);
                sums[1] += weight * dot(&outward, basis);
            });
            // A wall's row: the normal derivative, with the sign and the size of the Laplacian's diagonal.
            let wall = sums[0] / sums[1];
            let one = T::from_f64(1.0);
            let at_wall = |i: usize| i >= interior && i < points;
            let factor = T::Pack::from_lanes(|lane| if at_wall(i + lane) { wall.lane(lane) } else { one });
            let inside = T::Pack::from_lanes(|lane| if at_wall(i + lane) { T::zero() } else { one });
            let mut sum = zero;
            let mut slot = 0;
            stencil.for_each(|_, [x, y], square| {
                let (weight, basis) = (fits.weight.weight(square), moments::basis(x, y));
                let from_laplacian = dot(&laplacian, basis);
                let from_normal = factor * dot(&outward, basis);
                let entry = weight * (from_normal + inside * (from_laplacian - from_normal));
                entry.store(&mut row[slot * BLOCK + first..]);
                sum += entry;
                slot += 1;
            });
            for lane in 0..T::Pack::LANES {
                scale[first + lane] = factor.lane(lane);
                diagonal[first + lane] = if i + lane < points { -sum.lane(lane) } else { one };
            }
        }
    });
}

/// The right side: `(rho / dt) div u*` inside, the scaled normal derivative at walls.
pub fn source<T: Real, W: WeightFunction>(
    fits: Fits<T, W>,
    normal: &[T],
    scale: &[T],
    velocity: &[T],
    predicted: &[T],
    density_per_dt: T,
    [interior, points]: [usize; 2],
    source: &mut [T],
) {
    blocks::for_each(source, 1, &|block, out| {
        for i in packs::<T>(block, interior) {
            let ([u, v], per) = fits.vector(i, predicted);
            let value = T::Pack::splat(density_per_dt) * per * (u[0] + v[1]);
            for lane in 0..T::Pack::LANES.min(interior - i) {
                out[i - block * BLOCK + lane] = value.lane(lane);
            }
        }
        for i in (block * BLOCK).max(interior)..((block + 1) * BLOCK).min(points) {
            let stopped = |c: usize| normal[2 * i + c] * (predicted[2 * i + c] - velocity[2 * i + c]);
            out[i - block * BLOCK] = scale[i] * density_per_dt * (stopped(0) + stopped(1));
        }
    });
}
