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

/// `u_m ~ u + kick - g`, in the middle of the kick, with the pressure's kick `g` of the last steps; the kick is then zero.
pub fn estimate_middle<T: Real>(velocity: &[T], pressure_kick: &[T], middle: &mut [T], kick: &mut [T]) {
    blocks::for_each_2((middle, 2), (kick, 2), &|block, middle, kick| {
        let first = 2 * block * BLOCK;
        for (k, (middle, kick)) in middle.iter_mut().zip(kick).enumerate() {
            *middle = velocity[first + k] + *kick - pressure_kick[first + k];
            *kick = T::zero();
        }
    });
}

/// `u* = u + kick`.
pub fn predict<T: Real>(velocity: &[T], kick: &[T], predicted: &mut [T]) {
    blocks::for_each(predicted, 2, &|block, out| {
        let first = 2 * block * BLOCK;
        for (k, out) in out.iter_mut().enumerate() {
            *out = velocity[first + k] + kick[first + k];
        }
    });
}

/// `u' = u_m + second (kick - g)` inside, after `g` has moved towards `u + kick - u_m`, the pressure's kick of this step;
/// walls keep `u_m`.
pub fn reflect<T: Real>(
    velocity: &[T],
    middle: &[T],
    kick: &[T],
    second: T,
    interior: usize,
    pressure_kick: &mut [T],
    reflected: &mut [T],
) {
    let share = T::from_f64(PRESSURE_RELAXATION);
    blocks::for_each_2((pressure_kick, 2), (reflected, 2), &|block, pressure_kick, reflected| {
        let first = 2 * block * BLOCK;
        for (k, (mean, out)) in pressure_kick.iter_mut().zip(reflected).enumerate() {
            let u_m = middle[first + k];
            *out = u_m;
            if first + k < 2 * interior {
                let kick = kick[first + k];
                let g = velocity[first + k] + kick - u_m;
                *mean += share * (g - *mean);
                *out += second * (kick - *mean);
            }
        }
    });
}
