//! What diffuses between two plates from a first moment on: velocity by viscosity, heat by conduction.
//!
//! `d phi/dt = D d2 phi/ds2 + G` on `0 < s < L`, `phi = phi_0` at `s = 0`, `phi_1` at `s = L`, `phi = phi_i` at `t = 0`:
//!
//! ```text
//! phi = phi_0 + (phi_1 - phi_0) s / L + (G / 2 D) s (L - s) + sum_n (b_n - c_n) sin(n pi s / L) exp(-n^2 pi^2 D t / L^2)
//! b_n = (2 / n pi) ((phi_i - phi_0) - (phi_i - phi_1) (-1)^n),    c_n = 4 G L^2 / (n^3 pi^3 D), n odd
//! ```
//!
//! Couette's flow has `phi_i = phi_0 = 0`, Poiseuille's `G` alone.
//! Source: Fourier's series; Batchelor, An Introduction to Fluid Dynamics (1967), section 4.3.

use std::f64::consts::PI;

use glam::DVec2;

/// The plates, the fluid between them, and what drives it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slab {
    /// m
    pub length: f64,
    /// True where `s` is `y`; else it is `x`.
    pub upright: bool,
    /// m^2/s
    pub diffusivity: f64,
    /// At the first plate and at the second, in the unit of the field.
    pub plates: [f64; 2],
    pub initial: f64,
    /// A second.
    pub source: f64,
}

/// Exponents below which a term of the series counts for nothing.
const LEAST_EXPONENT: f64 = -40.0;
/// Most terms: the first moments are not resolved, and no step of a run ends in them.
const MOST_TERMS: u32 = 20_000;

impl Slab {
    /// The field at a place, m, and a time, s.
    pub fn value(&self, place: DVec2, time: f64) -> f64 {
        let Self { length, upright, diffusivity, plates: [first, last], initial, source } = *self;
        let s = if upright { place.y } else { place.x };
        if s <= 0.0 || s >= length {
            return if s <= 0.0 { first } else { last };
        }
        if time <= 0.0 {
            return initial;
        }
        let steady = first + (last - first) * s / length + 0.5 * source / diffusivity * s * (length - s);
        let decay = (PI / length).powi(2) * diffusivity * time;
        let mut sum = 0.0;
        for n in 1..=MOST_TERMS {
            let number = f64::from(n);
            let exponent = -number * number * decay;
            if exponent < LEAST_EXPONENT {
                break;
            }
            let sign = if n % 2 == 0 { 1.0 } else { -1.0 };
            let ends = 2.0 / (number * PI) * ((initial - first) - (initial - last) * sign);
            let driven = 2.0 * (1.0 - sign) * source * length * length / ((number * PI).powi(3) * diffusivity);
            sum += (ends - driven) * (number * PI * s / length).sin() * exponent.exp();
        }
        steady + sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SLAB: Slab =
        Slab { length: 2.0, upright: true, diffusivity: 0.3, plates: [0.0, 0.0], initial: 0.0, source: 0.0 };

    fn at(slab: Slab, s: f64, time: f64) -> f64 {
        slab.value(DVec2::splat(s), time)
    }

    /// Ratios to the steady value in the middle, at `D t / h^2`, `h` half the length, summed independently to six digits.
    #[test]
    fn a_flow_that_a_force_drives_begins_as_poiseuilles_does() {
        let slab = Slab { source: 0.7, ..SLAB };
        for (scaled, ratio) in [(0.05, 0.099956), (0.1, 0.197746), (0.2, 0.370386), (0.5, 0.699455), (1.0, 0.912477)] {
            let found = at(slab, 1.0, scaled / 0.3) / (0.5 * 0.7 / 0.3);
            assert!((found - ratio).abs() < 1e-6, "{scaled}: {found}");
        }
    }

    #[test]
    fn a_plate_that_begins_to_move_drags_couettes_flow_along() {
        let slab = Slab { plates: [0.0, 5.0], ..SLAB };
        let found = at(slab, 0.6, 0.05 * 4.0 / 0.3) / 5.0;
        assert!((found - 0.026817).abs() < 1e-6, "{found}");
        assert_eq!((at(slab, 0.6, 0.0), at(slab, 2.0, 0.0), at(slab, 0.0, 1.0)), (0.0, 5.0, 0.0));
    }

    #[test]
    fn the_series_solves_the_equation_and_begins_from_the_initial_value() {
        let slab = Slab { plates: [1.0, -0.5], initial: 0.2, source: 0.4, ..SLAB };
        let (h, time) = (1e-3, 0.4);
        for k in 1..20 {
            let s = 0.1 * f64::from(k);
            let curvature = (at(slab, s + h, time) + at(slab, s - h, time) - 2.0 * at(slab, s, time)) / (h * h);
            let change = (at(slab, s, time + h) - at(slab, s, time - h)) / (2.0 * h);
            assert!((change - 0.3 * curvature - 0.4).abs() < 1e-4, "{s}");
        }
        assert!((at(slab, 1.0, 1e-4) - 0.2).abs() < 1e-3);
    }
}
