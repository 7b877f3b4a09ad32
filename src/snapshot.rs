//! The fields at one instant, as the host sees them: what is printed, drawn, stored and measured.

use glam::DVec2;

/// All points at one time, in the order of the cloud.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Snapshot {
    /// s
    pub time: f64,
    /// m
    pub position: Vec<DVec2>,
    /// m/s
    pub velocity: Vec<DVec2>,
    /// Pa
    pub pressure: Vec<f64>,
}
