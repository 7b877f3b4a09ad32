//! Taylor-Green vortices: rows of vortices that turn against each other and decay.
//!
//! `u = cos(kx) sin(ky) F`, `v = -sin(kx) cos(ky) F`, `p = -(rho/4) (cos 2kx + cos 2ky) F^2`, `F = exp(-2 nu k^2 t)`; repeats
//! after `2 pi / k` along x and y. The fastest fluid moves at 1 m/s at the beginning.
//! Source: G.I. Taylor, A.E. Green, Proc. R. Soc. Lond. A 158 (1937) 499-521; in two dimensions G.I. Taylor, Phil. Mag. 46
//! (1923) 671-674.

use std::f64::consts::TAU;

use glam::DVec2;

/// Taylor-Green vortices in a periodic box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TaylorGreen {
    /// `k`, 1/m.
    wave_number: f64,
    /// Kinematic viscosity, m^2/s.
    viscosity: f64,
    /// kg/m^3
    density: f64,
}

impl TaylorGreen {
    /// `length` of a pair of vortices, m; kinematic viscosity, m^2/s; density, kg/m^3.
    pub fn new(length: f64, viscosity: f64, density: f64) -> Self {
        Self { wave_number: TAU / length, viscosity, density }
    }

    pub fn velocity(&self, place: DVec2, time: f64) -> DVec2 {
        let [x, y] = (self.wave_number * place).to_array();
        self.decay(time) * DVec2::new(x.cos() * y.sin(), -x.sin() * y.cos())
    }

    pub fn pressure(&self, place: DVec2, time: f64) -> f64 {
        let [x, y] = (2.0 * self.wave_number * place).to_array();
        -0.25 * self.density * (x.cos() + y.cos()) * self.decay(time).powi(2)
    }

    /// `F`.
    fn decay(&self, time: f64) -> f64 {
        (-2.0 * self.viscosity * self.wave_number.powi(2) * time).exp()
    }
}
