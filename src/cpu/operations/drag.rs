//! Drag of a porous body that the fluid passes through.
//!
//! Continuous: `du/dt = -(nu / k) u - F |u| u`, Darcy's law and Forchheimer's term, `k` the permeability.
//! Discrete:   `w = m - h (nu / k + F |w|) w`, `m = u + kick - G` the velocity under every other force of the kick, `h` its length, `G`
//! the relaxed mean of the pressure's kicks, where there is one; then `kick += w - m`. Point by point the equation has the solution
//! `w = 2 m / (1 + a + sqrt((1 + a)^2 + 4 h F |m|))`, `a = h nu / k`: never longer than `m`, whatever the step.
//! Source: Nield and Bejan, Convection in Porous Media (2017), section 1.5.
//! Units: `nu / k` 1/s, 0 where there is no body; `F` 1/m.

use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::real::Real;

/// What a body does to the fluid in it.
#[derive(Clone, Copy)]
pub struct Body<'a, T> {
    /// `nu / k` at every point, 1/s.
    pub resistance: &'a [T],
    /// `F k / nu`, s/m.
    pub inertia: T,
    /// `h`, s.
    pub time: T,
    /// Points that the drag reaches: the first ones.
    pub interior: usize,
}

/// Adds the drag to the kick; `mean` is `G`.
pub fn drag<T: Real>(body: Body<T>, velocity: &[T], mean: Option<&[T]>, kick: &mut [T]) {
    let (one, two, four) = (T::from_f64(1.0), T::from_f64(2.0), T::from_f64(4.0));
    blocks::for_each(kick, 2, &|block, out| {
        let first = block * BLOCK;
        for (point, out) in (first..body.interior).zip(out.chunks_exact_mut(2)) {
            let slowing = body.time * body.resistance[point];
            if slowing == T::zero() {
                continue;
            }
            let moving = [0, 1].map(|k| {
                let taken = mean.map_or(T::zero(), |mean| mean[2 * point + k]);
                velocity[2 * point + k] + out[k] - taken
            });
            let speed = (moving[0] * moving[0] + moving[1] * moving[1]).sqrt();
            let linear = one + slowing;
            let root = (linear * linear + four * slowing * body.inertia * speed).sqrt();
            let kept = two / (linear + root);
            (0..2).for_each(|k| out[k] += (kept - one) * moving[k]);
        }
    });
}
