//! The pressure of points that move, by fits: the paper's interpolation form with a free surface.
//!
//! Continuous: `lap p = (rho / dt) div u*` (3.2), `p = 0` at the free surface, `u' = u* - (dt / rho) grad p`; the places follow,
//! `r' = r* + dt (u' - u*)`. With a relaxed density term the source is `(rho / dt) div u* - relaxation (rho / dt^2) (c - 1)`, `c`
//! the number density over that of a lattice: points that have come too close part again.
//! Discrete: rows of the fitted Laplacian over neighbours and images, (2.6). The pressure of an image is that of its point
//! and `rho g . way` more, so that a fluid at rest has no gradient across a wall but gravity's.
//! Units: rows 1/m^2, source Pa/m^2.

use super::N;
use super::fits::{coefficient, factor_of};
use super::mirror::{Around, OWN, Shore, Stencil};
use crate::case::Weight;
use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::operations::integral;
use crate::cpu::operations::lists::Lists;
use crate::cpu::operations::moments;
use crate::cpu::real::{Pack, Real};

/// Entries of the wrong sign in a row of the fitted Laplacian, over those of the right one, above which the row is that of the
/// weighted mean instead, (2.4): with many the matrix is no longer one of a diffusion.
pub const WRONG_SIGN: f64 = 0.2;

/// Share of a point's neighbours on the surface above which the fluid there is a sheet of four rows or less, or spray. Beside a flat
/// surface it is 0.23, in a right corner 0.41.
pub const SHEET: f64 = 0.5;

/// Longest way that the pressure moves a point in a step, in spacings; shifted points alone. By its own limits a step is so short that
/// gravity moves a point by 0.04 spacings (`time.courant` squared), and the pressure at the foot of a column that is let go
/// by 0.11: what goes farther is shot out by a fit through a few points, and takes more energy with it than there was.
pub const LONGEST_PUSH: f64 = 0.3;

/// Numbers of the pressure equation.
#[derive(Debug, Clone, Copy)]
pub struct Equation<T> {
    pub weight: Weight,
    /// `rho g`, Pa/m.
    pub weight_density: [T; 2],
    /// `rho / dt`, kg/(m^3 s).
    pub density_per_dt: T,
    /// `relaxation rho / dt^2`, Pa/m^2.
    pub stiffness: T,
    /// `2 D / (lambda n0)`, 1/m^2.
    pub per_area: T,
}

/// Fills rows, diagonal and source; the pressure becomes 0 at the surface.
pub fn assemble<T: Real>(
    around: Around<T>,
    equation: Equation<T>,
    factor: &[T],
    crowding: &[T],
    surface: &[u32],
    coefficients: &[T],
    row: &mut [T],
    [diagonal, source, pressure]: [&mut [T]; 3],
) {
    let slots = around.lists.capacity;
    let one = T::from_f64(1.0);
    let [gx, gy] = equation.weight_density.map(T::Pack::splat);
    let scalars = [(diagonal, 1), (source, 1), (pressure, 1)];
    blocks::for_each_4((row, slots), scalars, &|block, row, diagonal, source, pressure| {
        for first in (0..BLOCK).step_by(T::Pack::LANES) {
            let i = block * BLOCK + first;
            let inside = T::Pack::from_lanes(|lane| if surface[i + lane] == 0 { one } else { T::zero() });
            let stencil = Stencil::new(around, i);
            let mut of = [T::Pack::zero(); N];
            of[2] = T::Pack::splat(T::from_f64(2.0)) * stencil.per_radius * stencil.per_radius;
            of[4] = of[2];
            let c = moments::solve(&factor_of(factor, i), of);
            let mut signs = [T::Pack::zero(); 2];
            stencil.for_each(|near| {
                let basis: [T::Pack; N] = moments::basis(near.offset[0], near.offset[1]);
                let entry = near.counts * moments::weight(equation.weight, near.square) * dot(&c, basis);
                signs[0] += (-entry).max(T::Pack::zero());
                signs[1] += entry.max(T::Pack::zero());
                if near.is_point() {
                    entry.store(&mut row[near.slot * BLOCK + first..]);
                }
            });
            let limit = T::Pack::splat(T::from_f64(WRONG_SIGN));
            let right_sign = limit * signs[1] - signs[0];
            let fits = right_sign.select_above(T::Pack::zero(), T::Pack::splat(one), T::Pack::zero());
            let mean = (T::Pack::splat(one) - fits) * T::Pack::splat(equation.per_area);
            let (mut sum, mut offset) = (T::Pack::zero(), T::Pack::zero());
            let mut shore = Shore::default();
            if !stencil.sees_walls() && right_sign.above(T::Pack::zero()).count_ones() as usize == T::Pack::LANES {
                // What stands there already, but for points of the surface.
                around.lists.for_each::<T>(i, |slot, index| {
                    let place = slot * BLOCK + first;
                    let entry = inside * T::Pack::load(&row[place..]);
                    entry.store(&mut row[place..]);
                    sum += entry;
                    shore.meet(surface, index);
                });
            } else {
                stencil.for_each(|near| {
                    let basis: [T::Pack; N] = moments::basis(near.offset[0], near.offset[1]);
                    let weight = near.counts * moments::weight(equation.weight, near.square);
                    let plain = integral::weight::<T>(near.square);
                    let entry = inside * (fits * weight * dot(&c, basis) + near.counts * mean * plain);
                    if near.is_point() {
                        entry.store(&mut row[near.slot * BLOCK + first..]);
                        shore.meet(surface, near.index);
                    } else {
                        offset += entry * (gx * near.way[0] + gy * near.way[1]);
                        if near.slot != OWN {
                            let place = near.slot * BLOCK + first;
                            (T::Pack::load(&row[place..]) + entry).store(&mut row[place..]);
                        }
                    }
                    if near.slot != OWN {
                        sum += entry;
                    }
                });
            }
            let per_radius = stencil.per_radius;
            let divergence = per_radius * (coefficient(coefficients, i, 0, 0) + coefficient(coefficients, i, 1, 1));
            // Beside the surface a density below the lattice's is no error.
            let excess = T::Pack::load(&crowding[i..]) - T::Pack::splat(one);
            let excess = shore.beside::<T>().select_above(T::Pack::zero(), excess.max(T::Pack::zero()), excess);
            let flow =
                T::Pack::splat(equation.density_per_dt) * divergence - T::Pack::splat(equation.stiffness) * excess;
            let right = inside * (flow - offset);
            for lane in 0..T::Pack::LANES {
                let (at, own) = (first + lane, -sum.lane(lane));
                // No Laplacian that a pressure could answer to: as free as the surface.
                let free = own >= T::zero();
                diagonal[at] = if free { one } else { own };
                source[at] = if free { T::zero() } else { right.lane(lane) };
                if free {
                    pressure[at] = T::zero();
                    (0..slots).for_each(|slot| row[slot * BLOCK + at] = T::zero());
                }
            }
        }
    });
}

/// Thin fluid does not pull: pressures below 0 become 0 in sheets and in spray. Elsewhere they stay: they hold a patch together that
/// rotates.
pub fn clamp<T: Real>(lists: Lists, surface: &[u32], pressure: &mut [T]) {
    blocks::for_each(pressure, 1, &|block, out| {
        for (lane, p) in out.iter_mut().enumerate().filter(|(_, p)| **p < T::zero()) {
            let i = block * BLOCK + lane;
            let first = blocks::at(i, 0, lists.capacity);
            let count = (lists.count[i] as usize).min(lists.capacity);
            let free: u32 = (0..count).map(|slot| surface[lists.neighbours[first + slot * BLOCK] as usize]).sum();
            if f64::from(free) > SHEET * count as f64 {
                *p = T::zero();
            }
        }
    });
}

/// `u' = u* - (dt / rho) grad p` and the way `dt (u' - u*)` at the points below `interior`.
pub fn correct<T: Real>(
    around: Around<T>,
    equation: Equation<T>,
    factor: &[T],
    pressure: &[T],
    [dt, dt_per_density]: [T; 2],
    interior: usize,
    projected: &mut [T],
    displacement: &mut [T],
) {
    let [gx, gy] = equation.weight_density.map(T::Pack::splat);
    blocks::for_each_2((projected, 2), (displacement, 2), &|block, projected, displacement| {
        for i in blocks::packs::<T>(block, interior) {
            let own = T::Pack::load(&pressure[i..]);
            let stencil = Stencil::new(around, i);
            let mut right = [T::Pack::zero(); N];
            stencil.for_each(|near| {
                // SAFETY: every stored neighbour is below the number of points.
                let there = unsafe { T::Pack::gather(pressure, near.index) };
                let there = there + gx * near.way[0] + gy * near.way[1];
                let value = near.counts * moments::weight(equation.weight, near.square) * (there - own);
                let basis: [T::Pack; N] = moments::basis(near.offset[0], near.offset[1]);
                for k in 0..N {
                    right[k] = value.mul_add(basis[k], right[k]);
                }
            });
            let fitted = moments::solve(&factor_of(factor, i), right);
            let scale = T::Pack::splat(-dt_per_density) * stencil.per_radius;
            let change = [scale * fitted[0], scale * fitted[1]];
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

/// Shortens the way `dt (u' - u*)` to at most `longest`, m, and the change of velocity with it, at the points below `interior`; `bounded`
/// counts the steps in which it did. `dt` in s.
pub fn bound_push<T: Real>(
    longest: T,
    dt: T,
    interior: usize,
    projected: &mut [T],
    displacement: &mut [T],
    bounded: &mut [u32],
) {
    blocks::for_each_3((projected, 2), (displacement, 2), (bounded, 1), &|block, projected, displacement, bounded| {
        for k in 0..BLOCK.min(interior.saturating_sub(block * BLOCK)) {
            let [x, y] = [displacement[2 * k], displacement[2 * k + 1]];
            let length = (x * x + y * y).sqrt();
            if length > longest {
                let rest = longest / length - T::from_f64(1.0);
                for entry in 2 * k..2 * k + 2 {
                    let less = rest * displacement[entry];
                    displacement[entry] += less;
                    projected[entry] += less / dt;
                }
                bounded[k] += 1;
            }
        }
    });
}

#[inline(always)]
fn dot<T: Real, P: Pack<T>>(c: &[P; N], b: [P; N]) -> P {
    (1..N).fold(c[0] * b[0], |sum, k| c[k].mul_add(b[k], sum))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_push_is_bounded_along_its_way_counted_and_else_left_alone() {
        let (spacing, dt) = (0.5, 0.1);
        // 0.2 spacings, and five times the bound, of points inside; the same of a point beyond `interior`.
        let far = [5.0 * 0.6 * LONGEST_PUSH * spacing, -5.0 * 0.8 * LONGEST_PUSH * spacing];
        let mut displacement = vec![0.0; 2 * BLOCK];
        displacement[..6].copy_from_slice(&[0.0, 0.1, far[0], far[1], far[0], far[1]]);
        let mut projected = vec![7.0; 2 * BLOCK];
        let mut bounded = vec![3; BLOCK];
        bound_push::<f64>(LONGEST_PUSH * spacing, dt, 2, &mut projected, &mut displacement, &mut bounded);
        let expected = [0.0, 0.1, far[0] / 5.0, far[1] / 5.0, far[0], far[1]];
        assert!(displacement.iter().zip(expected).all(|(found, right)| (found - right).abs() < 1e-15));
        let expected = [7.0, 7.0, 7.0 - 0.8 * far[0] / dt, 7.0 - 0.8 * far[1] / dt, 7.0, 7.0];
        assert!(projected.iter().zip(expected).all(|(found, right)| (found - right).abs() < 1e-12));
        assert_eq!(bounded[..4], [3, 4, 3, 3]);
    }
}
