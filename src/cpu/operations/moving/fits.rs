//! Least-squares fits of points that move, walls as mirrors.
//!
//! Continuous: Taylor's polynomial. Discrete: (2.5) of the paper over the neighbours and their images, derivatives by (2.6).
//! A point whose normal matrix is too weak keeps the linear fit, or none: at a free surface there is nothing to widen to.
//! Shapes and units as those of the fits that stand.

use super::mirror::{Around, Stencil};
use super::{F, M, N};
use crate::case::Weight;
use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::operations::moments::{self, Moments};
use crate::cpu::real::{Pack, Real};
use crate::step::Rung;

/// Least pivot of a full fit of points that move, relative to the diagonal entry it came from: they come into arrangements, at the
/// tips of jets, that no cloud is laid out in.
pub const PIVOT: f64 = 1e-3;

/// Least spread of a point's neighbours across a line over that along it, for a linear fit: weighted sums of squared distances. Two
/// points one below the other under a ceiling have images in the same line: a slope across it would be what the pressure is
/// off along it over next to no distance, the same for both, and drive the pair along the ceiling ever faster, whatever the step.
pub const SPREAD: f64 = 0.01;

/// Forms and factorises the normal matrices; `rung` says how far each was lowered. Points of the surface, whose
/// neighbours are all on one side, have a linear fit; those whose neighbours stand in a line have none.
pub fn factorise<T: Real>(around: Around<T>, weight: Weight, surface: &[u32], factor: &mut [T], rung: &mut [u32]) {
    let one = T::from_f64(1.0);
    blocks::for_each_2((factor, F), (rung, 1), &|block, factor, rung| {
        for first in (0..BLOCK).step_by(T::Pack::LANES) {
            let mut sums = Moments::<T::Pack, M>::zero();
            Stencil::new(around, block * BLOCK + first).for_each(|near| {
                let [x, y] = near.offset;
                sums.add(x, y, near.counts * moments::weight(weight, near.square));
            });
            let matrix = sums.matrix::<F>();
            let (entries, pivots): (_, [T::Pack; N]) = moments::factorise(matrix);
            let [full, linear] = [moments::least(&pivots), moments::least(&pivots[..moments::coefficients(1)])];
            let inside =
                T::Pack::from_lanes(|lane| if surface[block * BLOCK + first + lane] == 0 { one } else { T::zero() });
            let (along_x, along_y) = (matrix[0], matrix[2]);
            let spread = linear * along_x.min(along_y);
            let least = T::Pack::splat(T::from_f64(SPREAD)) * along_x.max(along_y);
            let (yes, no) = (T::Pack::splat(one), T::Pack::zero());
            let is_full = (inside * full).select_above(T::Pack::splat(T::from_f64(PIVOT)), yes, no);
            let is_linear = is_full.max(spread.select_above(least, yes, no));
            for (k, entry) in entries.into_iter().enumerate() {
                let kept = if k < moments::entries(moments::coefficients(1)) { is_linear } else { is_full };
                kept.select_above(no, entry, no).store(&mut factor[k * BLOCK + first..]);
            }
            let (is_full, is_linear) = (is_full.above(no), is_linear.above(no));
            for lane in 0..T::Pack::LANES {
                rung[first + lane] = match (is_full >> lane & 1, is_linear >> lane & 1) {
                    (1, _) => 0,
                    (_, 1) => Rung::LINEAR,
                    _ => Rung::NEAREST,
                };
            }
        }
    });
}

/// The factors of the pack that begins at point `i`.
#[inline(always)]
pub fn factor_of<T: Real>(factor: &[T], i: usize) -> [T::Pack; F] {
    let first = blocks::at(i, 0, F);
    let mut values = [T::Pack::zero(); F];
    for k in 0..F {
        values[k] = T::Pack::load(&factor[first + k * BLOCK..]);
    }
    values
}

/// The coefficients of the fits of u and of v, scaled by the radius. `falling` is the part of the velocity that gravity gave
/// in this step, m/s: the pressure of an image answers it, and so it is no part of what mirrors turn round.
pub fn fit_velocity<T: Real>(
    around: Around<T>,
    weight: Weight,
    factor: &[T],
    velocity: &[T],
    falling: [T; 2],
    coefficients: &mut [T],
) {
    let twice = falling.map(|u| T::Pack::splat(u + u));
    blocks::for_each(coefficients, 2 * N, &|block, out| {
        for first in (0..BLOCK).step_by(T::Pack::LANES) {
            let i = block * BLOCK + first;
            let own = T::Pack::load_vectors(&velocity[2 * i..]);
            let mut right = [[T::Pack::zero(); N]; 2];
            Stencil::new(around, i).for_each(|near| {
                // SAFETY: every stored neighbour is below the number of points.
                let mut there = near.mirrored(unsafe { T::Pack::gather_vectors(velocity, near.index) });
                for axis in 0..2 {
                    if near.flipped[axis] {
                        there[axis] += twice[axis];
                    }
                }
                let weight = near.counts * moments::weight(weight, near.square);
                let (u, v) = (weight * (there[0] - own[0]), weight * (there[1] - own[1]));
                let basis: [T::Pack; N] = moments::basis(near.offset[0], near.offset[1]);
                for k in 0..N {
                    right[0][k] = u.mul_add(basis[k], right[0][k]);
                    right[1][k] = v.mul_add(basis[k], right[1][k]);
                }
            });
            let factor = factor_of(factor, i);
            for (axis, right) in right.into_iter().enumerate() {
                for (k, value) in moments::solve(&factor, right).into_iter().enumerate() {
                    value.store(&mut out[(axis * N + k) * BLOCK + first..]);
                }
            }
        }
    });
}

/// Divergence of the fitted velocity, 1/s, at the points below `end` that are not the surface.
pub fn divergence<T: Real>(
    around: Around<T>,
    weight: Weight,
    factor: &[T],
    velocity: &[T],
    surface: &[u32],
    end: usize,
    divergence: &mut [T],
) {
    let mut coefficients = vec![T::zero(); 2 * N * divergence.len()];
    fit_velocity(around, weight, factor, velocity, [T::zero(); 2], &mut coefficients);
    let per_radius = T::Pack::splat(T::from_f64(1.0) / around.mirrors.radius);
    blocks::for_each(divergence, 1, &|block, out| {
        for i in blocks::packs::<T>(block, end) {
            let value = per_radius * (coefficient(&coefficients, i, 0, 0) + coefficient(&coefficients, i, 1, 1));
            for lane in 0..T::Pack::LANES.min(end - i) {
                let free = surface[i + lane] != 0;
                out[i - block * BLOCK + lane] = if free { T::zero() } else { value.lane(lane) };
            }
        }
    });
}

/// Coefficient `k` of component `axis` at the points `i..i + LANES`.
#[inline(always)]
pub fn coefficient<T: Real>(coefficients: &[T], i: usize, axis: usize, k: usize) -> T::Pack {
    T::Pack::load(&coefficients[blocks::at(i, axis * N + k, 2 * N)..])
}

/// `kick += dt nu lap u` at the points below `interior`, `lap u = 2 (a3 + a5) / r_e^2`; `diffusion` is `dt nu`, m^2.
pub fn viscosity<T: Real>(coefficients: &[T], diffusion: T, radius: T, interior: usize, kick: &mut [T]) {
    let factor = T::Pack::splat(T::from_f64(2.0) * diffusion / (radius * radius));
    blocks::for_each(kick, 2, &|block, out| {
        for i in blocks::packs::<T>(block, interior) {
            let push = [0, 1]
                .map(|axis| factor * (coefficient(coefficients, i, axis, 2) + coefficient(coefficients, i, axis, 4)));
            blocks::add_vectors::<T>(out, block * BLOCK, i, interior, push);
        }
    });
}
