//! The conservative form of the pressure equation: fluxes through the faces of Voronoi cells.
//!
//! Continuous: `div((dt / rho) grad p) = div u*`.
//! Discrete:   `sum_j w_ij (p_i - p_j) = -(rho / dt) sum_j w_ij d_ij . (u*_i + u*_j) / 2`, walls letting nothing through.
//! The matrix is symmetric, its off-diagonal entries are not positive, and its null space is exactly the constants.

use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::operations::pressure::Rows;
use crate::cpu::real::{Pack, Real};

/// Faces of the Voronoi cells: neighbour across and weight `w_ij`, `capacity` slots a point, blocked.
#[derive(Clone, Copy)]
pub struct Faces<'a, T> {
    pub neighbours: &'a [u32],
    pub weight: &'a [T],
    pub count: &'a [u32],
    pub capacity: usize,
}

impl<T: Real> Faces<'_, T> {
    /// Calls `body(indexes, weights)` for every slot of the points `i..i + LANES`; unused slots weigh nothing.
    #[inline(always)]
    pub fn for_each(&self, i: usize, mut body: impl FnMut(&[u32], T::Pack)) {
        let rows = self.count[i..i + T::Pack::LANES].iter().copied().max().unwrap_or(0) as usize;
        let first = blocks::at(i, 0, self.capacity);
        for slot in 0..rows.min(self.capacity) {
            let start = first + slot * BLOCK;
            body(&self.neighbours[start..start + T::Pack::LANES], T::Pack::load(&self.weight[start..]));
        }
    }
}

/// The symmetric matrix `K` over the cells' volumes.
#[derive(Clone, Copy)]
pub struct Conservative<'a, T> {
    pub faces: Faces<'a, T>,
    /// `1 / V_i`, 1/m^2.
    pub per_volume: &'a [T],
}

impl<T: Real> Rows<T> for Conservative<'_, T> {
    /// `(K p)_i = sum_j w_ij (p_i - p_j)`.
    #[inline(always)]
    fn product(&self, i: usize, p: &[T]) -> T::Pack {
        let own = T::Pack::load(&p[i..]);
        let mut sum = T::Pack::zero();
        self.faces.for_each(i, |index, weight| {
            // SAFETY: every stored face neighbour is below the number of points.
            sum += weight * (own - unsafe { T::Pack::gather(p, index) });
        });
        sum
    }

    #[inline(always)]
    fn measure(&self, i: usize, residual: T::Pack, size: T::Pack, sums: &mut [T::Pack]) {
        let per_volume = T::Pack::load(&self.per_volume[i..]);
        let (residual, size) = (residual * per_volume, size * per_volume);
        sums[0] += residual * residual;
        sums[1] += size * size;
    }
}

/// `scale sum_j w_ij d_ij . (u_i + u_j) / 2`: the volume flux out of every cell, m^2/s, times `scale`.
pub fn divergence<T: Real>(faces: Faces<T>, position: &[T], velocity: &[T], scale: T, out: &mut [T]) {
    let half = T::Pack::splat(T::from_f64(0.5) * scale);
    blocks::for_each(out, 1, &|block, out| {
        for first in (0..BLOCK).step_by(T::Pack::LANES) {
            let i = block * BLOCK + first;
            let own = T::Pack::load_vectors(&position[2 * i..]);
            let own_velocity = T::Pack::load_vectors(&velocity[2 * i..]);
            let mut sum = T::Pack::zero();
            faces.for_each(i, |index, weight| {
                // SAFETY: every stored face neighbour is below the number of points.
                let ([x, y], [u, v]) =
                    unsafe { (T::Pack::gather_vectors(position, index), T::Pack::gather_vectors(velocity, index)) };
                sum += weight * ((x - own[0]) * (u + own_velocity[0]) + (y - own[1]) * (v + own_velocity[1]));
            });
            (half * sum).store(&mut out[first..]);
        }
    });
}

/// Correction by minus the adjoint of the divergence: `u' = u* - (dt / rho) (1 / 2 V_i) sum_j w_ij d_ij (p_j - p_i)` at the
/// points below `end`. Never adds kinetic energy, on any arrangement of points, at any dt.
pub fn correct_by_adjoint<T: Real>(
    faces: Faces<T>,
    position: &[T],
    volume: &[T],
    pressure: &[T],
    dt_per_density: T,
    end: usize,
    intermediate: &mut [T],
) {
    let factor = T::Pack::splat(T::from_f64(-0.5) * dt_per_density);
    blocks::for_each(intermediate, 2, &|block, out| {
        for i in blocks::packs::<T>(block, end) {
            let own = T::Pack::load_vectors(&position[2 * i..]);
            let own_pressure = T::Pack::load(&pressure[i..]);
            let mut sum = [T::Pack::zero(); 2];
            faces.for_each(i, |index, weight| {
                // SAFETY: every stored face neighbour is below the number of points.
                let ([x, y], p) =
                    unsafe { (T::Pack::gather_vectors(position, index), T::Pack::gather(pressure, index)) };
                let difference = weight * (p - own_pressure);
                sum[0] += difference * (x - own[0]);
                sum[1] += difference * (y - own[1]);
            });
            let scale = factor / T::Pack::load(&volume[i..]);
            let [x, y] = sum.map(|sum| scale * sum);
            for lane in 0..T::Pack::LANES.min(end - i) {
                out[2 * (i - block * BLOCK + lane)] += x.lane(lane);
                out[2 * (i - block * BLOCK + lane) + 1] += y.lane(lane);
            }
        }
    });
}
