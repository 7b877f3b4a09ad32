//! One run: steps until the end, a steady state, a request to stop, or trouble.

use serde::{Deserialize, Serialize};

/// One row of `diagnostics.csv`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Diagnostics {
    pub step: u64,
    /// s
    pub time: f64,
    /// s
    pub dt: f64,
    /// Integral of `|u|^2 / 2` over the domain, m^4/s^2.
    pub kinetic_energy: f64,
    /// m/s
    pub max_speed: f64,
    /// Root mean square of `div u` over the points, 1/s.
    pub divergence: f64,
    /// Iterations of the pressure solve of this step.
    pub pressure_iterations: u32,
    /// Recomputed residual of the pressure solve of this step, as the volume change it leaves, `|div u| dt` (rms).
    pub residual: f64,
    /// Largest rate of change of a velocity since the last row, m/s^2.
    pub change: f64,
}

/// Told of a run as it goes: draws the bar, writes the rows, asks it to stop.
pub trait Observer {
    /// A row of diagnostics is ready.
    fn report(&mut self, row: &Diagnostics);
    /// True once the run is to stop after the step it is in.
    fn stop_requested(&self) -> bool;
}
