//! A whole field against the exact one.

use glam::DVec2;

use super::line::TEMPERATURE;
use crate::case::{Component, Tracer};
use crate::exact::Exact;
use crate::known::Known;
use crate::snapshot::{Derivatives, Snapshot};

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
                relative_to_means(pressure, &right)
            }
            Component::Temperature => {
                scalars(position, snapshot.carried(TEMPERATURE), &|place| exact.temperature(place, *time))
            }
            _ => {
                let right = position.iter().map(|&place| pick(exact.velocity(place, *time)));
                velocity.iter().map(|&u| pick(u)).zip(right).collect()
            }
        };
        Self::of_pairs(&pairs)
    }

    /// The same of a tracer.
    pub fn of_tracer(snapshot: &Snapshot, exact: &Exact, tracer: &Tracer) -> Self {
        let Snapshot { time, position, .. } = snapshot;
        let right = |place| exact.tracer(tracer, place, *time);
        Self::of_pairs(&scalars(position, snapshot.carried(&tracer.name), &right))
    }

    /// The same of what a problem without time gives, against the known field.
    pub fn of_known(snapshot: &Snapshot, known: &Known, component: Component) -> Self {
        let Snapshot { position, pressure, derivatives, .. } = snapshot;
        let empty = Derivatives::default();
        let derivatives = derivatives.as_ref().unwrap_or(&empty);
        let scalar = |value: f64| DVec2::new(value, 0.0);
        let places = position.iter();
        // What the operators do not have is no number.
        let gradient = |k: usize| derivatives.gradient.get(k).copied().unwrap_or(DVec2::NAN);
        let laplacian = |k: usize| scalar(derivatives.laplacian.get(k).copied().unwrap_or(f64::NAN));
        let pairs: Vec<(DVec2, DVec2)> = match component {
            Component::Gradient => places.enumerate().map(|(k, &place)| (gradient(k), known.gradient(place))).collect(),
            Component::Laplacian => {
                places.enumerate().map(|(k, &place)| (laplacian(k), scalar(known.laplacian(place)))).collect()
            }
            _ => {
                let right: Vec<f64> = places.map(|&place| known.value(place)).collect();
                relative_to_means(pressure, &right)
            }
        };
        Self::of_pairs(&pairs)
    }

    fn of_pairs(pairs: &[(DVec2, DVec2)]) -> Self {
        let rms = |of: &dyn Fn(&(DVec2, DVec2)) -> DVec2| {
            (pairs.iter().map(|pair| of(pair).length_squared()).sum::<f64>() / pairs.len() as f64).sqrt()
        };
        Self { difference: rms(&|(found, right)| *found - *right), exact: rms(&|(_, right)| *right) }
    }
}

/// A carried field beside the exact one; what is not known is no number.
fn scalars(position: &[DVec2], found: &[f64], right: &dyn Fn(DVec2) -> Option<f64>) -> Vec<(DVec2, DVec2)> {
    let scalar = |value: f64| DVec2::new(value, 0.0);
    let pair = |(&place, &value): (&DVec2, &f64)| (scalar(value), scalar(right(place).unwrap_or(f64::NAN)));
    position.iter().zip(found).map(pair).collect()
}

/// Two scalar fields, each less its mean over the points.
fn relative_to_means(found: &[f64], right: &[f64]) -> Vec<(DVec2, DVec2)> {
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let (zero, right_zero) = (mean(found), mean(right));
    let relative = |(p, q): (&f64, &f64)| (DVec2::new(p - zero, 0.0), DVec2::new(q - right_zero, 0.0));
    found.iter().zip(right).map(relative).collect()
}
