//! Gravity: a force that is the same everywhere.
//!
//! Continuous: `du/dt = g`. Discrete: `kick += t g`, `t` the length of the kick, s. Units: m/s; two numbers a point.
//! It reaches the walls too, whose velocity is put back after the projection: `u*` is then uniform, a pressure linear in
//! place balances it in either form, and the fitted gradient takes off what was added. Fluid at rest stays at rest to rounding.

use crate::cpu::blocks;
use crate::cpu::real::Real;

/// `kick += change` at every point, `change = t g`.
pub fn gravity<T: Real>(change: [T; 2], kick: &mut [T]) {
    blocks::for_each(kick, 2, &|_, out| {
        for vector in out.chunks_exact_mut(2) {
            vector[0] += change[0];
            vector[1] += change[1];
        }
    });
}
