//! Buoyancy: the weight of fluid that is warmer or colder than the reference.
//!
//! Continuous: `du/dt = -beta (T - T_0) g`, the approximation of Boussinesq. Discrete: `kick += t (T_i - T_0) l`, `l = -beta g`, `t` the
//! length of the kick, s, on walls too, as gravity does. Source: Boussinesq, Theorie analytique de la chaleur II (1903).
//! Units: `l` m/(s^2 K), the kick m/s.

use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::real::Real;

/// `kick += (T - reference) change` at every point, `change = t l`.
pub fn buoyancy<T: Real>(temperature: &[T], reference: T, change: [T; 2], kick: &mut [T]) {
    blocks::for_each(kick, 2, &|block, out| {
        for (vector, &temperature) in out.chunks_exact_mut(2).zip(&temperature[block * BLOCK..]) {
            let excess = temperature - reference;
            vector[0] += excess * change[0];
            vector[1] += excess * change[1];
        }
    });
}
