//! One component of a flow along a straight line through the domain.

use std::borrow::Cow;
use std::cell::OnceCell;

use glam::DVec2;

use super::{MeasureError, Sampler};
use crate::case::{Component, Domain, Line, Measure};
use crate::snapshot::Snapshot;

/// What the temperature is called in a snapshot.
pub const TEMPERATURE: &str = "temperature";
/// Samples a spacing when an extreme is sought.
const SAMPLES_PER_SPACING: f64 = 8.0;

/// An extreme value and where it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extreme {
    /// Coordinate along the line, m.
    pub position: f64,
    /// m/s or Pa
    pub value: f64,
}

/// Measures a component along a line; pressure is relative to its value at the line's middle.
#[derive(Debug)]
pub struct LineMeasure<'a> {
    sampler: &'a Sampler<'a>,
    field: Cow<'a, [f64]>,
    line: Line,
    length: f64,
    reference: f64,
    samples: OnceCell<(Vec<f64>, Vec<f64>)>,
}

impl<'a> LineMeasure<'a> {
    /// `sampler` must stand on the snapshot's points.
    ///
    /// # Errors
    /// A field with more or fewer values than there are points.
    pub fn new(
        sampler: &'a Sampler<'a>,
        snapshot: &'a Snapshot,
        domain: &Domain,
        component: Component,
        line: Line,
    ) -> Result<Self, MeasureError> {
        let field: Cow<[f64]> = match component {
            Component::U => snapshot.velocity.iter().map(|u| u.x).collect(),
            Component::V => snapshot.velocity.iter().map(|u| u.y).collect(),
            Component::P => Cow::Borrowed(&snapshot.pressure),
            Component::Temperature => Cow::Borrowed(snapshot.carried(TEMPERATURE)),
            // Both at once: how fast.
            Component::Velocity => snapshot.velocity.iter().map(|u| u.length()).collect(),
            // Nothing measures them along a line.
            Component::Tracer | Component::Gradient | Component::Laplacian | Component::X | Component::Y => {
                Cow::Borrowed(&[])
            }
        };
        if field.len() != sampler.points() {
            let name = match component {
                Component::P => "pressure",
                Component::Temperature => TEMPERATURE,
                _ => "velocity",
            };
            return Err(MeasureError::Length { field: name, found: field.len(), points: sampler.points() });
        }
        let length = match line {
            Line::X(_) => domain.height,
            Line::Y(_) => domain.width,
        };
        let mut measure = Self { sampler, field, line, length, reference: 0.0, samples: OnceCell::new() };
        if component == Component::P {
            measure.reference = measure.value(0.5 * length);
        }
        Ok(measure)
    }

    /// Length of the line, m; coordinates along it run from 0 to here.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// The component at a coordinate along the line, m.
    pub fn value(&self, coordinate: f64) -> f64 {
        let at = match self.line {
            Line::X(x) => DVec2::new(x, coordinate),
            Line::Y(y) => DVec2::new(coordinate, y),
        };
        self.sampler.value(at, &self.field) - self.reference
    }

    /// The whole line from 0 to its length, finely sampled: coordinates, m, and values.
    pub fn samples(&self) -> &(Vec<f64>, Vec<f64>) {
        self.samples.get_or_init(|| {
            let count = ((SAMPLES_PER_SPACING * self.length / self.sampler.spacing()).ceil() as usize).max(16);
            let coordinate: Vec<f64> = (0..=count).map(|k| self.length * (k as f64 / count as f64)).collect();
            let value = coordinate.iter().map(|&s| self.value(s)).collect();
            (coordinate, value)
        })
    }

    /// The least value along the line.
    pub fn minimum(&self) -> Extreme {
        self.extreme(1.0)
    }

    /// The largest value along the line.
    pub fn maximum(&self) -> Extreme {
        self.extreme(-1.0)
    }

    /// The extreme that an expectation asks for; `None` for a profile.
    pub fn measured(&self, measure: Measure) -> Option<Extreme> {
        match measure {
            Measure::Minimum => Some(self.minimum()),
            Measure::Maximum => Some(self.maximum()),
            _ => None,
        }
    }

    /// Least `sign * value` of the samples, then the vertex of the parabola through it and its two neighbours. A line
    /// with a value that is not a number has no extreme: NaN.
    fn extreme(&self, sign: f64) -> Extreme {
        let (coordinate, value) = self.samples();
        if value.iter().any(|v| v.is_nan()) {
            return Extreme { position: f64::NAN, value: f64::NAN };
        }
        let best = (0..value.len()).min_by(|&a, &b| (sign * value[a]).total_cmp(&(sign * value[b]))).unwrap_or(0);
        let found = Extreme { position: coordinate[best], value: value[best] };
        if best == 0 || best + 1 == value.len() {
            return found;
        }
        let (before, after) = (value[best - 1] - found.value, value[best + 1] - found.value);
        let curvature = before + after;
        if sign * curvature <= 0.0 {
            return found;
        }
        let shift = 0.5 * (before - after) / curvature;
        let step = coordinate[best + 1] - coordinate[best];
        let value = found.value - 0.125 * (before - after).powi(2) / curvature;
        Extreme { position: found.position + shift * step, value }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Axes;
    use crate::measure::sampler::tests::jittered_cloud;

    fn flow(n: usize) -> Snapshot {
        let position = jittered_cloud(n, 0.4, 11);
        let velocity = position.iter().map(|x| DVec2::new((4.0 * x.y).sin(), (x.x - 0.31) * (x.x - 0.31))).collect();
        let pressure = position.iter().map(|x| 7.0 + x.x - 2.0 * x.y).collect();
        Snapshot { time: 0.0, position, velocity, pressure, ..Snapshot::default() }
    }

    const DOMAIN: Domain = Domain { width: 1.0, height: 1.0, periodic: Axes::None };

    #[test]
    fn an_extreme_is_found_between_the_samples() {
        let snapshot = flow(32);
        let sampler = Sampler::new(&snapshot.position, 1.0 / 32.0).unwrap();
        let u = LineMeasure::new(&sampler, &snapshot, &DOMAIN, Component::U, Line::X(0.5)).unwrap();
        let top = u.maximum();
        assert!((top.position - std::f64::consts::FRAC_PI_8).abs() < 1e-4, "{top:?}");
        assert!((top.value - 1.0).abs() < 3e-5, "{top:?}");
        let low = u.minimum();
        assert!(low.position == 1.0 && (low.value - 4f64.sin()).abs() < 1e-5, "{low:?}");

        let v = LineMeasure::new(&sampler, &snapshot, &DOMAIN, Component::V, Line::Y(0.7)).unwrap();
        let low = v.minimum();
        assert!((low.position - 0.31).abs() < 1e-9 && low.value.abs() < 1e-12, "{low:?}");
    }

    #[test]
    fn pressure_is_relative_to_the_middle() {
        let snapshot = flow(16);
        let sampler = Sampler::new(&snapshot.position, 1.0 / 16.0).unwrap();
        let p = LineMeasure::new(&sampler, &snapshot, &DOMAIN, Component::P, Line::X(0.2)).unwrap();
        assert!(p.value(0.5).abs() < 1e-13);
        assert!((p.value(0.0) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_field_of_the_wrong_length_is_refused() {
        let mut snapshot = flow(8);
        snapshot.pressure.pop();
        let sampler = Sampler::new(&snapshot.position, 0.125).unwrap();
        let error = LineMeasure::new(&sampler, &snapshot, &DOMAIN, Component::P, Line::X(0.2)).unwrap_err();
        assert_eq!(error, MeasureError::Length { field: "pressure", found: 80, points: 81 });
    }
}
