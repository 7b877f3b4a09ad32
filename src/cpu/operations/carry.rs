//! Fields that the flow carries: where the fluid at every point came from, and what it brought along.
//!
//! Continuous: `D phi / Dt = 0` along the path of a fluid point. Discrete: `phi(r0) = phi~(r_d)`, `r_d = r0 - dt u(r0 - dt u)`, with
//! `phi~` the fit (2.5) of the point nearest to `r_d`: the departure of [`super::remap`], found once for all fields.
//! On walls too: fluid that slides along one carries what it has, and fluid that comes in through one brings what stands there. Where a value is held (`D / V_i` is zero there) it stays.
//! Units: those of the field; a fit has its value and `N` scaled coefficients a point, blocked.

use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::operations::fits::Fits;
use crate::cpu::operations::moments;
use crate::cpu::operations::remap::{Around, Moving, offset};
use crate::cpu::operations::space::Space;
use crate::cpu::real::{One, Pack, Real};

/// Where the fluid came from, and the point nearest to there.
pub fn find_departures<T: Real, S: Space<T>, const N: usize>(
    moving: Moving<T, S>,
    around: Around,
    normal: &[T],
    dt: T,
    end: usize,
    departure: &mut [T],
    nearest: &mut [u32],
) {
    blocks::for_each_2((departure, 2), (nearest, 1), &|block, places, points| {
        for (lane, i) in (block * BLOCK..((block + 1) * BLOCK).min(end)).enumerate() {
            let inward =
                normal[2 * i] * moving.values[2 * i] + normal[2 * i + 1] * moving.values[2 * i + 1] < T::zero();
            let from = if inward { moving.place(i) } else { moving.departure::<N>(i, dt) };
            places[2 * lane..2 * lane + 2].copy_from_slice(&from);
            points[lane] = moving.nearest(around, from, i) as u32;
        }
    });
}

/// The velocity found there, at the points below `end`.
pub fn carry_velocity<T: Real, S: Space<T>, const N: usize>(
    moving: Moving<T, S>,
    departure: &[T],
    nearest: &[u32],
    end: usize,
    velocity: &mut [T],
) {
    blocks::for_each(velocity, 2, &|block, out| {
        for (lane, i) in (block * BLOCK..((block + 1) * BLOCK).min(end)).enumerate() {
            let from = [departure[2 * i], departure[2 * i + 1]];
            out[2 * lane..2 * lane + 2].copy_from_slice(&moving.evaluate::<N>(nearest[i] as usize, from));
        }
    });
}

/// The value and the scaled coefficients of the fit of a field at every point.
pub fn fit_scalar<T: Real, S: Space<T>, const N: usize, const F: usize>(
    fits: Fits<T, S, N, F>,
    field: &[T],
    fitted: &mut [T],
) {
    blocks::for_each(fitted, N + 1, &|block, out| {
        for first in (0..BLOCK).step_by(T::Pack::LANES) {
            let i = block * BLOCK + first;
            T::Pack::load(&field[i..]).store(&mut out[first..]);
            for (k, coefficient) in fits.scalar(i, field).into_iter().enumerate() {
                coefficient.store(&mut out[(k + 1) * BLOCK + first..]);
            }
        }
    });
}

/// The field found where the fluid came from, at the points below `end` whose value is not held.
pub fn carry_scalar<T: Real, S: Space<T>, const N: usize>(
    space: S,
    position: &[T],
    support: &[T],
    (departure, nearest): (&[T], &[u32]),
    fitted: &[T],
    reach: Option<&[T]>,
    end: usize,
    field: &mut [T],
) {
    blocks::for_each(field, 1, &|block, out| {
        for (lane, i) in (block * BLOCK..((block + 1) * BLOCK).min(end)).enumerate() {
            if reach.is_some_and(|reach| reach[i] == T::zero()) {
                continue;
            }
            let j = nearest[i] as usize;
            let per = T::from_f64(1.0) / support[j];
            let [x, y] = offset(space, position, j, [departure[2 * i], departure[2 * i + 1]]);
            let basis: [One<T>; N] = moments::basis(One(x * per), One(y * per));
            let first = blocks::at(j, 0, N + 1);
            let mut value = fitted[first];
            for (k, term) in basis.into_iter().enumerate() {
                value += fitted[first + (k + 1) * BLOCK] * term.0;
            }
            out[lane] = value;
        }
    });
}
