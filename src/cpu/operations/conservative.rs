//! The conservative form of the pressure equation: fluxes through the faces of Voronoi cells.
//!
//! Continuous: `div((dt / rho) grad p) = div u*`.
//! Discrete:   `sum_j w_ij (p_i - p_j) = -(rho / dt) (sum_j w_ij d_ij . (u*_i + u*_j) / 2 + A_i n_i . u_wall)`, the last term 0 at
//! walls that let nothing through.
//! The matrix is symmetric, its off-diagonal entries are not positive, and its null space is exactly the constants.

use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::operations::lists::{Lists, PACKS, own};
use crate::cpu::operations::pressure::Rows;
use crate::cpu::operations::space::Space;
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
    fn products(&self, block: usize, p: &[T]) -> [T::Pack; PACKS] {
        let Faces { neighbours, weight, count, capacity } = self.faces;
        let own = own(p, block);
        Lists { neighbours, count, capacity }.fold(block, weight, T::Pack::zero(), |sum, pack, index, [weight]| {
            // SAFETY: every stored face neighbour is below the number of points.
            sum + weight * (own[pack] - unsafe { T::Pack::gather(p, index) })
        })
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
pub fn divergence<T: Real, S: Space<T>>(
    faces: Faces<T>,
    space: S,
    position: &[T],
    velocity: &[T],
    scale: T,
    out: &mut [T],
) {
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
                let [x, y] = space.shortest([x - own[0], y - own[1]]);
                sum += weight * (x * (u + own_velocity[0]) + y * (v + own_velocity[1]));
            });
            (half * sum).store(&mut out[first..]);
        }
    });
}

/// The flux of a velocity out of every cell as a sum over points: `capacity` slots a point, blocked, `row` twice as many.
#[derive(Clone, Copy)]
pub struct Fluxes<'a, T> {
    pub points: &'a [u32],
    pub count: &'a [u32],
    /// m; of u, then of v.
    pub row: &'a [T],
    pub capacity: usize,
}

/// `scale sum_k r_ik . u_k`: the volume flux out of every cell, m^2/s, times `scale`, the velocity fitted on its faces.
pub fn divergence_by_fit<T: Real>(fluxes: Fluxes<T>, velocity: &[T], scale: T, out: &mut [T]) {
    let Fluxes { points: neighbours, count, row, capacity } = fluxes;
    let lists = Lists { neighbours, count, capacity };
    let scale = T::Pack::splat(scale);
    blocks::for_each(out, 1, &|block, out| {
        let sums = lists.fold(block, row, T::Pack::zero(), |sum, _, index, [x, y]| {
            // SAFETY: every stored point is below the number of points.
            let [u, v] = unsafe { T::Pack::gather_vectors(velocity, index) };
            y.mul_add(v, x.mul_add(u, sum))
        });
        for (k, sum) in (0..BLOCK).step_by(T::Pack::LANES).zip(sums) {
            (scale * sum).store(&mut out[k..]);
        }
    });
}

/// Adds `scale` times the volume flux that the walls let through, outward, m^2/s: of every cell the part of
/// [`divergence`] that is data.
pub fn add_wall_flux<T: Real>(wall_flux: &[T], scale: T, out: &mut [T]) {
    blocks::for_each(out, 1, &|block, out| {
        let flux = &wall_flux[block * BLOCK..];
        out.iter_mut().zip(flux).for_each(|(out, &flux)| *out += scale * flux);
    });
}

/// Correction by minus the adjoint of the divergence: `u' = u* - (dt / rho) (1 / 2 V_i) sum_j w_ij d_ij (p_j - p_i)` at the
/// points below `end`. Never adds kinetic energy, on any arrangement of points, at any dt.
pub fn correct_by_adjoint<T: Real, S: Space<T>>(
    faces: Faces<T>,
    space: S,
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
                let [x, y] = space.shortest([x - own[0], y - own[1]]);
                sum[0] += difference * x;
                sum[1] += difference * y;
            });
            let scale = factor / T::Pack::load(&volume[i..]);
            blocks::add_vectors::<T>(out, block * BLOCK, i, end, sum.map(|sum| scale * sum));
        }
    });
}
