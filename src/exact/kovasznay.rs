//! Kovasznay's flow: the steady wake behind a row of cylinders, one metre apart, in a stream of 1 m/s.
//!
//! `u = 1 - exp(lambda x) cos(2 pi y)`, `v = (lambda / 2 pi) exp(lambda x) sin(2 pi y)`, `p = -(rho/2) exp(2 lambda x)`,
//! `lambda = Re/2 - sqrt(Re^2/4 + 4 pi^2)`, `Re = 1 / nu`. The lower left corner of the domain stands at (-1/2, -1/2) m.
//! Source: L.I.G. Kovasznay, Proc. Camb. Phil. Soc. 44 (1948) 58-62.

use std::f64::consts::TAU;

use glam::DVec2;

/// Where the domain's corner stands in the solution's coordinates, m.
const CORNER: DVec2 = DVec2::splat(-0.5);

/// Kovasznay's flow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kovasznay {
    /// `lambda`, 1/m.
    growth: f64,
    /// kg/m^3
    density: f64,
}

impl Kovasznay {
    /// Kinematic viscosity, m^2/s; density, kg/m^3.
    pub fn new(viscosity: f64, density: f64) -> Self {
        let half = 0.5 / viscosity;
        // Re/2 - sqrt(Re^2/4 + 4 pi^2), without the difference of two like numbers.
        Self { growth: -TAU * TAU / (half + half.hypot(TAU)), density }
    }

    pub fn velocity(&self, place: DVec2) -> DVec2 {
        let [x, y] = (place + CORNER).to_array();
        let strength = (self.growth * x).exp();
        DVec2::new(1.0 - strength * (TAU * y).cos(), self.growth / TAU * strength * (TAU * y).sin())
    }

    pub fn pressure(&self, place: DVec2) -> f64 {
        -0.5 * self.density * (2.0 * self.growth * (place.x + CORNER.x)).exp()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lambda_is_what_the_formula_gives() {
        assert!((Kovasznay::new(1.0 / 40.0, 1.0).growth + 0.963740544195767).abs() < 1e-14);
        assert!((Kovasznay::new(1.0 / 20.0, 1.0).growth + 1.81009812001397).abs() < 1e-13);
    }
}
