//! A whole field against the exact one.

use glam::DVec2;

use crate::case::Component;
use crate::exact::Exact;
use crate::snapshot::Snapshot;

/// How far a computed field is from the exact one: root mean squares over the points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FieldError {
    /// Of the difference, m/s or Pa.
    pub difference: f64,
    /// Of the exact field, m/s or Pa.
    pub exact: f64,
}

impl FieldError {
    /// Compares at the time of the snapshot; pressures are relative to their means over the points.
    pub fn new(snapshot: &Snapshot, exact: &Exact, component: Component) -> Self {
        let Snapshot { time, position, velocity, pressure, .. } = snapshot;
        let pick = |u: DVec2| match component {
            Component::U => DVec2::new(u.x, 0.0),
            Component::V => DVec2::new(u.y, 0.0),
            _ => u,
        };
        let pairs: Vec<(DVec2, DVec2)> = match component {
            Component::P => {
                let right: Vec<f64> = position.iter().map(|&place| exact.pressure(place, *time)).collect();
                let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
                let (zero, right_zero) = (mean(pressure), mean(&right));
                let relative = |(p, q): (&f64, &f64)| (DVec2::new(p - zero, 0.0), DVec2::new(q - right_zero, 0.0));
                pressure.iter().zip(&right).map(relative).collect()
            }
            _ => {
                let right = position.iter().map(|&place| pick(exact.velocity(place, *time)));
                velocity.iter().map(|&u| pick(u)).zip(right).collect()
            }
        };
        let rms = |of: &dyn Fn(&(DVec2, DVec2)) -> DVec2| {
            (pairs.iter().map(|pair| of(pair).length_squared()).sum::<f64>() / pairs.len() as f64).sqrt()
        };
        Self { difference: rms(&|(found, right)| *found - *right), exact: rms(&|(_, right)| *right) }
    }
}
