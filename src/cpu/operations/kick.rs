//! The kick, point by point: estimate, prediction, reflection.
//!
//! Continuous: `u` under forces for `dt/2`, then the projection, then the same forces for another `dt/2`.
//! Discrete:   `u* = u + k`, `u_m = u* - g`, `u' = u_m + s (k - g)`, with `k` the kick of the effects, `g` that of the
//! pressure, `s` the second half over the first. Steady where `u_m` is, whatever dt (to second order), since `u_m` is the
//! middle of a symmetric step. Source: Zehnder, Narain and Thomaszewski, ACM Trans. Graph. 37(4), 2018.
//! In the second half `g` is a relaxed mean of the last ones: an error mode that the approximate projection takes off
//! `1 + e` times would grow when reflected; relaxed by 1/2 it decays for `e < 1/2`. A steady `g` is its own mean.

use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::real::Real;
use crate::step::PRESSURE_RELAXATION;

/// `u_m ~ u + kick` of the last step, in the middle of this one; the kick is then zero.
pub fn estimate_middle<T: Real>(velocity: &[T], middle: &mut [T], kick: &mut [T]) {
    blocks::for_each_2((middle, 2), (kick, 2), |block, middle, kick| {
        let first = 2 * block * BLOCK;
        for (k, (middle, kick)) in middle.iter_mut().zip(kick).enumerate() {
            *middle = velocity[first + k] + *kick;
            *kick = T::zero();
        }
    });
}

/// `u* = u + kick`.
pub fn predict<T: Real>(velocity: &[T], kick: &[T], predicted: &mut [T]) {
    blocks::for_each(predicted, 2, |block, out| {
        let first = 2 * block * BLOCK;
        for (k, out) in out.iter_mut().enumerate() {
            *out = velocity[first + k] + kick[first + k];
        }
    });
}

/// `u' = u_m + second (kick - g)`; `pressure_kick` moves towards `g`; `kick` becomes the whole change of the half step,
/// `u_m - u`, which the next step's estimate begins from.
pub fn reflect<T: Real>(
    velocity: &[T],
    middle: &[T],
    second: T,
    kick: &mut [T],
    pressure_kick: &mut [T],
    reflected: &mut [T],
) {
    let share = T::from_f64(PRESSURE_RELAXATION);
    blocks::for_each_3((kick, 2), (pressure_kick, 2), (reflected, 2), |block, kick, pressure_kick, reflected| {
        let first = 2 * block * BLOCK;
        for (k, ((kick, mean), out)) in kick.iter_mut().zip(pressure_kick).zip(reflected).enumerate() {
            let (u, u_m) = (velocity[first + k], middle[first + k]);
            let g = u + *kick - u_m;
            *mean += share * (g - *mean);
            *out = u_m + second * (*kick - *mean);
            *kick = u_m - u;
        }
    });
}
