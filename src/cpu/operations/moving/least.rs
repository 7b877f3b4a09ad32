//! The correction of MPS: weighted means of the pressure above the least one around each point.
//!
//! Continuous: `u' = u* - (dt / rho) grad p`. Discrete, plain: `grad p = (D / n0) sum_j (p_j - p_min) d / |d|^2 w`; the least
//! pressure around the point in place of its own keeps points from clumping. Points behind walls have no pressure and no part in it.
//! The plain mean divides by the neighbours of a full lattice, whatever a point has: beside the surface and beside walls, where
//! half of them lack, it is half of the gradient, and the pressure below has to be higher by that. Corrected: `grad p = C^-1` of it,
//! `C = (D / n0) sum_j d d^T / |d|^2 w`, the identity on a full lattice; a pressure that is linear in place then has its gradient,
//! but for `p_i - p_min`. Where the determinant of `C` is below [`DETERMINANT`] the plain one stays.
//! Source: Koshizuka and Oka, Nucl. Sci. Eng. 123 (1996) 421-434 (plain); Khayyer and Gotoh, J. Comput. Phys. 230 (2011)
//! 3093-3118 (corrected). Units: m/s, m; `C` has none.

use super::mirror::{Around, Stencil};
use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::operations::integral::{DIMENSIONS, weight};
use crate::cpu::real::{Pack, Real};

/// Determinant of the matrix below which a gradient is not corrected: of a lattice it is 1, of points in a row 0.
pub const DETERMINANT: f64 = 0.1;

/// The numbers of the correction.
#[derive(Debug, Clone, Copy)]
pub struct Correction<T> {
    /// s
    pub dt: T,
    /// `dt / rho`, m^3 s/kg.
    pub per_density: T,
    /// `n0`
    pub lattice: T,
    /// Points of the fluid, and these with the walls' that have a pressure.
    pub interior: usize,
    pub pressured: usize,
}

/// Fluid does not pull: pressures below 0 become 0.
pub fn clamp<T: Real>(pressure: &mut [T]) {
    blocks::for_each(pressure, 1, &|_, out| out.iter_mut().for_each(|p| *p = p.max(T::zero())));
}

/// The correction by the plain mean, and the way `dt (u' - u*)`.
pub fn correct_by_least<T: Real>(
    around: Around<T>,
    pressure: &[T],
    correction: Correction<T>,
    projected: &mut [T],
    displacement: &mut [T],
) {
    correct::<T, false>(around, pressure, correction, projected, displacement);
}

/// The same by the corrected mean.
pub fn correct_by_moments<T: Real>(
    around: Around<T>,
    pressure: &[T],
    correction: Correction<T>,
    projected: &mut [T],
    displacement: &mut [T],
) {
    correct::<T, true>(around, pressure, correction, projected, displacement);
}

#[inline(always)]
fn correct<T: Real, const MOMENTS: bool>(
    around: Around<T>,
    pressure: &[T],
    correction: Correction<T>,
    projected: &mut [T],
    displacement: &mut [T],
) {
    let Correction { dt, per_density, lattice, interior, pressured } = correction;
    let scale = T::Pack::splat(T::from_f64(DIMENSIONS) / lattice);
    blocks::for_each_2((projected, 2), (displacement, 2), &|block, projected, displacement| {
        for i in blocks::packs::<T>(block, interior) {
            let stencil = Stencil::new(around, i);
            let zero = T::Pack::zero();
            let own = T::Pack::load(&pressure[i..]);
            // Points behind walls have no pressure to compare.
            let there = |index: &[u32], instead: T::Pack| {
                // SAFETY: every stored neighbour is below the number of points.
                let there = unsafe { T::Pack::gather(pressure, index) };
                T::Pack::from_lanes(|lane| match (index[lane] as usize) < pressured {
                    true => there.lane(lane),
                    false => instead.lane(lane),
                })
            };
            let mut least = own;
            stencil.for_each(|near| least = least - (least - there(near.index, least)).max(zero));
            let (mut sum, mut moments) = ([zero; 2], [zero; 3]);
            stencil.for_each(|near| {
                let per_square = near.square.select_above(zero, weight::<T>(near.square) / near.square, zero);
                let factor = (there(near.index, least) - least) * per_square;
                let [x, y] = near.offset;
                sum = [sum[0] + factor * x, sum[1] + factor * y];
                if MOMENTS {
                    let has = |lane: usize| (near.index[lane] as usize) < pressured;
                    let counts = T::Pack::from_lanes(|lane| if has(lane) { per_square.lane(lane) } else { T::zero() });
                    moments = [moments[0] + counts * x * x, moments[1] + counts * x * y, moments[2] + counts * y * y];
                }
            });
            let mut gradient = sum.map(|sum| scale * sum);
            if MOMENTS {
                gradient = solved::<T>(moments.map(|moment| scale * moment), gradient);
            }
            let factor = T::Pack::splat(-per_density) * stencil.per_radius;
            let change = gradient.map(|gradient| factor * gradient);
            let start = block * BLOCK;
            blocks::add_vectors::<T>(projected, start, i, interior, change);
            blocks::set_vectors::<T>(
                displacement,
                start,
                i,
                interior,
                change.map(|change| T::Pack::splat(dt) * change),
            );
        }
    });
}

/// `C^-1 g`, or `g` where `C` says too little.
#[inline(always)]
fn solved<T: Real>([xx, xy, yy]: [T::Pack; 3], [x, y]: [T::Pack; 2]) -> [T::Pack; 2] {
    let determinant = xx * yy - xy * xy;
    let bound = T::Pack::splat(T::from_f64(DETERMINANT));
    let divisor = determinant.select_above(bound, determinant, T::Pack::splat(T::from_f64(1.0)));
    [
        determinant.select_above(bound, (yy * x - xy * y) / divisor, x),
        determinant.select_above(bound, (xx * y - xy * x) / divisor, y),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cpu::operations::integral::Lattice;
    use crate::cpu::operations::lists::Lists;
    use crate::cpu::operations::moving::mirror::Mirrors;

    /// Points of a lattice around the origin, 1 m apart, of which `keep` holds, the origin first; `p = 3 x - 2 y` above the least.
    fn gradient(keep: fn(f64, f64) -> bool, corrected: bool) -> [f64; 2] {
        let mut places = vec![[0.0, 0.0]];
        for (i, j) in (-2..=2).flat_map(|j| (-2..=2).map(move |i| (f64::from(i), f64::from(j)))) {
            if (i, j) != (0.0, 0.0) && i.hypot(j) < 2.1 && keep(i, j) {
                places.push([i, j]);
            }
        }
        let slots = places.len() - 1;
        let mut position = vec![0.0; 2 * BLOCK];
        let (mut pressure, mut neighbours) = (vec![0.0; BLOCK], vec![0_u32; slots * BLOCK]);
        for (k, [x, y]) in places.iter().enumerate() {
            position[2 * k..2 * k + 2].copy_from_slice(&[*x, *y]);
            // The origin has the least, as points of the surface have.
            pressure[k] = if k == 0 { 0.0 } else { (3.0 * x - 2.0 * y).abs() };
        }
        for slot in 0..slots {
            neighbours[blocks::at(0, slot, slots)] = slot as u32 + 1;
        }
        let mut count = vec![0; BLOCK];
        count[0] = slots as u32;
        let around = Around {
            position: &position,
            lists: Lists { neighbours: &neighbours, count: &count, capacity: slots },
            mirrors: Mirrors { size: [100.0; 2], radius: 2.1, present: false },
        };
        let (mut projected, mut displacement) = (vec![0.0; 2 * BLOCK], vec![0.0; 2 * BLOCK]);
        let lattice = Lattice::new(2.1, 1.0).density;
        let correction = Correction { dt: 1.0, per_density: 1.0, lattice, interior: 1, pressured: BLOCK };
        let apply = if corrected { correct_by_moments } else { correct_by_least };
        apply(around, &pressure, correction, &mut projected, &mut displacement);
        assert_eq!(projected[..2], displacement[..2]);
        [-projected[0], -projected[1]]
    }

    fn close(a: [f64; 2], b: [f64; 2]) -> bool {
        (0..2).all(|axis| (a[axis] - b[axis]).abs() < 1e-12)
    }

    #[test]
    fn a_corrected_gradient_is_right_for_linear_pressures_on_half_a_neighbourhood_and_a_plain_one_is_half() {
        // All with a pressure of 3 x - 2 y above that of the origin.
        let half = |x: f64, y: f64| 3.0 * x - 2.0 * y > 0.0;
        assert!(close(gradient(half, true), [3.0, -2.0]), "{:?}", gradient(half, true));
        assert!(close(gradient(half, false), [1.5, -1.0]), "{:?}", gradient(half, false));
        // Three in a corner are enough, and so is a lopsided handful.
        let corner = |x: f64, y: f64| x >= 0.0 && y <= 0.0;
        assert!(close(gradient(corner, true), [3.0, -2.0]), "{:?}", gradient(corner, true));
    }

    #[test]
    fn points_in_a_row_keep_the_plain_gradient() {
        let row = |x: f64, y: f64| y == 0.0 && x > 0.0;
        assert!(close(gradient(row, true), gradient(row, false)));
        assert!(gradient(row, true)[0] > 0.1);
    }
}
