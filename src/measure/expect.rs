//! What a case expects, held against what was computed.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::history;
use super::line::TEMPERATURE;
use super::loss::{amounts, flows};
use super::slope::mean_slope;
use super::{FieldError, LineMeasure, MeasureError, Probe, Profile, Sampler};
use crate::case::{Case, Component, Expectation, Line, Measure};
use crate::exact::Exact;
use crate::known::Known;
use crate::motion;
use crate::snapshot::Snapshot;

/// One row of `[expect]` with its measured value. `None` stands where the run gave no finite number.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ExpectationResult {
    pub name: String,
    /// In words: `minimum of u along x = 0.5`.
    pub quantity: String,
    /// Coordinate of the computed extreme along the line, m; time of the largest difference of a front or an area, s; the
    /// others have none.
    pub position: Option<f64>,
    /// The computed extreme, force, difference or flux, or the rms difference from the profile or the exact field; m/s, Pa, N/m or
    /// m^2/s. Of points that move: the front, the area or the energy where it is farthest off, a sensor's mean or its rms about
    /// it, Pa.
    pub value: Option<f64>,
    /// The published extreme, the published profile's largest magnitude, or the rms of the exact field; m/s or Pa. Of
    /// points that move: the published front there, 1 of an area, the energy at the start, the published mean or the computed one of noise, Pa.
    pub reference: f64,
    /// `|value - reference| / |reference|`, or the rms difference over the reference.
    pub error: Option<f64>,
    pub tolerance: f64,
    pub pass: bool,
    pub source: String,
}

/// [`evaluate_run`] of points that stand.
///
/// # Errors
/// Those of [`evaluate_run`].
pub fn evaluate(
    case: &Case,
    snapshot: &Snapshot,
    profiles: &BTreeMap<String, Profile>,
) -> Result<Vec<ExpectationResult>, MeasureError> {
    evaluate_run(case, snapshot, &[], profiles)
}

/// Measures every expectation of a case, in the order of their names; `profiles` holds the published profiles by the
/// name of their expectation, and `rows` are the reports of points that move.
///
/// # Errors
/// A snapshot that can't be measured, an expectation without its value or profile, or a reference that is zero.
pub fn evaluate_run(
    case: &Case,
    snapshot: &Snapshot,
    rows: &[motion::Row],
    profiles: &BTreeMap<String, Profile>,
) -> Result<Vec<ExpectationResult>, MeasureError> {
    if case.expect.is_empty() {
        return Ok(Vec::new());
    }
    let sampler = Sampler::of(case, &snapshot.position)?;
    let exact = Exact::of(case);
    // A point that is not a number fails every row, however far from the row's line.
    let finite = snapshot.velocity.iter().all(|u| u.is_finite())
        && snapshot.pressure.iter().all(|p| p.is_finite())
        && snapshot.carried.iter().all(|(_, values)| values.iter().all(|value| value.is_finite()));
    case.expect
        .iter()
        .map(|(name, row)| {
            let fail = |what: &str| MeasureError::Expectation { name: name.clone(), what: what.to_owned() };
            let tracer = case.effects.tracers.iter().find(|tracer| Some(&tracer.name) == row.tracer.as_ref());
            let component = || row.component.ok_or_else(|| fail("`component` is missing"));
            let found = match row.measure {
                measure if measure.of_motion() => history::found(case, row, rows, profiles.get(name)).map_err(fail)?,
                Measure::Slope => {
                    let side = row.side.ok_or_else(|| fail("`side` is missing"))?;
                    let field = snapshot.carried(TEMPERATURE);
                    let value = mean_slope(case, side, field)?;
                    let reference = row.value.ok_or_else(|| fail("`value` is missing"))?;
                    Found { position: None, value, reference, difference: (value - reference).abs() }
                }
                Measure::Loss if row.component == Some(Component::Velocity) => {
                    let [reference, value] = flows(&sampler, case, &snapshot.velocity);
                    Found { position: None, value, reference, difference: (value - reference).abs() }
                }
                Measure::Loss => {
                    let tracer = tracer.ok_or_else(|| fail("`tracer` is missing"))?;
                    let [reference, value] = amounts(case, tracer, snapshot.carried(&tracer.name))?;
                    Found { position: None, value, reference, difference: (value - reference).abs() }
                }
                Measure::Error => {
                    let component = component()?;
                    let known = Known::of(case).map(|known| FieldError::of_known(snapshot, &known, component));
                    let flow = exact.as_ref().map(|exact| match tracer {
                        Some(tracer) => FieldError::of_tracer(snapshot, exact, tracer),
                        None => FieldError::new(snapshot, exact, component),
                    });
                    Found::of_field(known.or(flow).ok_or_else(|| fail("there is no exact solution"))?)
                }
                Measure::Force | Measure::Difference | Measure::Flux => {
                    let value = Probe::of_expectation(name, row, case, &sampler)?.value(snapshot);
                    let reference = row.value.ok_or_else(|| fail("`value` is missing"))?;
                    Found { position: None, value, reference, difference: (value - reference).abs() }
                }
                _ => {
                    let at = row.line.ok_or_else(|| fail("`line` is missing"))?;
                    let line = LineMeasure::new(&sampler, snapshot, &case.domain, component()?, at)?;
                    Found::along_line(row, &line, profiles.get(name), &fail)?
                }
            };
            let result = judged(name, row, found, &fail)?;
            let nothing =
                |result| ExpectationResult { position: None, value: None, error: None, pass: false, ..result };
            Ok(if finite { result } else { nothing(result) })
        })
        .collect()
}

/// What was measured of a row.
pub(super) struct Found {
    /// m, or s
    pub position: Option<f64>,
    pub value: f64,
    pub reference: f64,
    pub difference: f64,
}

impl Found {
    fn of_field(error: FieldError) -> Self {
        let FieldError { difference, exact } = error;
        Self { position: None, value: difference, reference: exact, difference }
    }

    fn along_line(
        row: &Expectation,
        line: &LineMeasure,
        profile: Option<&Profile>,
        fail: &dyn Fn(&str) -> MeasureError,
    ) -> Result<Self, MeasureError> {
        if let Some(extreme) = line.measured(row.measure) {
            let reference = row.value.ok_or_else(|| fail("`value` is missing"))?;
            let difference = (extreme.value - reference).abs();
            return Ok(Self { position: Some(extreme.position), value: extreme.value, reference, difference });
        }
        let profile = profile.ok_or_else(|| fail("`profile` was not read"))?;
        let rms = rms_difference(line, profile);
        let largest = profile.value.iter().fold(0.0, |largest: f64, v| largest.max(v.abs()));
        Ok(Self { position: None, value: rms, reference: largest, difference: rms })
    }
}

fn judged(
    name: &str,
    row: &Expectation,
    found: Found,
    fail: &dyn Fn(&str) -> MeasureError,
) -> Result<ExpectationResult, MeasureError> {
    let Found { position, value, reference, difference } = found;
    // An exact field that has died away and a pressure that is 0 leave no relative error, and the row fails.
    if reference == 0.0 && !matches!(row.measure, Measure::Error | Measure::Noise) {
        return Err(fail("the published value is zero, so a relative error has no meaning"));
    }
    let finite = |x: f64| x.is_finite().then_some(x);
    let error = finite(difference / reference.abs());
    Ok(ExpectationResult {
        name: name.to_owned(),
        quantity: quantity(row),
        position: position.and_then(finite),
        value: finite(value),
        reference,
        error,
        tolerance: row.tolerance,
        pass: error.is_some_and(|error| error <= row.tolerance),
        source: row.source.clone(),
    })
}

fn rms_difference(line: &LineMeasure, profile: &Profile) -> f64 {
    let squares = profile.coordinate.iter().zip(&profile.value).map(|(&s, &v)| (line.value(s) - v).powi(2));
    (squares.sum::<f64>() / profile.value.len() as f64).sqrt()
}

fn quantity(row: &Expectation) -> String {
    let measure = format!("{} of", row.measure.word());
    let component = match row.component {
        Some(Component::U) => "u",
        Some(Component::V) => "v",
        Some(Component::P) => "p",
        Some(Component::Velocity) => "the velocity",
        Some(Component::Temperature) => "the temperature",
        Some(Component::Tracer) => row.tracer.as_deref().unwrap_or("a tracer"),
        Some(Component::Gradient) => "the gradient",
        Some(Component::Laplacian) => "the Laplacian",
        Some(Component::X) => "along x",
        Some(Component::Y) => "along y",
        None => return history::quantity(row),
    };
    if let Some([from, to]) = row.between {
        return format!("{measure} {component} between {from:?} and {to:?}");
    }
    if let Some(on) = &row.on {
        return match row.measure {
            Measure::Force => format!("{measure} {component} on {on}"),
            _ => format!("{measure} {component} out through {on}"),
        };
    }
    match row.line {
        Some(Line::X(x)) => format!("{measure} {component} along x = {x}"),
        Some(Line::Y(y)) => format!("{measure} {component} along y = {y}"),
        None => match row.side {
            Some(side) => format!("{measure} {component} across the {}", side.word()),
            None => format!("{measure} {component} over all points"),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::sampler::tests::jittered_cloud;
    use glam::DVec2;

    fn expectation(measure: Measure, value: Option<f64>) -> Expectation {
        Expectation {
            component: Some(Component::U),
            line: Some(Line::X(0.5)),
            measure,
            value,
            profile: None,
            column: None,
            on: None,
            between: None,
            tracer: None,
            side: None,
            sensor: None,
            length: None,
            duration: None,
            delay: None,
            after: None,
            tolerance: 0.01,
            source: "a paper".into(),
        }
    }

    fn case(rows: &[(&str, Expectation)]) -> Case {
        let mut case: Case = toml::from_str(
            "title = 't'\n[domain]\nwidth = 1.0\nheight = 1.0\n[cloud]\narrangement = 'regular'\nspacing = 0.05\n\
             [fluid]\ndensity = 1.0\n[time]\nend = 1.0\n",
        )
        .unwrap();
        case.expect = rows.iter().map(|(name, row)| (name.to_string(), row.clone())).collect();
        case
    }

    fn flow() -> Snapshot {
        let position = jittered_cloud(20, 0.3, 2);
        let velocity = position.iter().map(|x| DVec2::new(4.0 * x.y * (1.0 - x.y), 0.0)).collect();
        Snapshot { time: 1.0, pressure: vec![0.0; position.len()], position, velocity, ..Snapshot::default() }
    }

    #[test]
    fn passes_within_the_tolerance_and_fails_beyond_it() {
        let close = expectation(Measure::Maximum, Some(1.005));
        let far = expectation(Measure::Maximum, Some(1.02));
        let rows = evaluate(&case(&[("close", close), ("far", far)]), &flow(), &BTreeMap::new()).unwrap();
        assert_eq!(rows.iter().map(|r| r.pass).collect::<Vec<_>>(), [true, false]);
        assert!((rows[0].value.unwrap() - 1.0).abs() < 1e-9 && (rows[0].position.unwrap() - 0.5).abs() < 1e-9);
        assert!((rows[1].error.unwrap() - 0.02 / 1.02).abs() < 1e-9);
        assert_eq!(rows[0].quantity, "maximum of u along x = 0.5");
    }

    #[test]
    fn a_profile_is_compared_by_its_rms() {
        let shifted = |by: f64| {
            let coordinate = vec![0.1, 0.5, 0.8];
            let value = coordinate.iter().map(|y| 4.0 * y * (1.0 - y) + by).collect();
            BTreeMap::from([("p".to_owned(), Profile { coordinate, value })])
        };
        let case = case(&[("p", expectation(Measure::Profile, None))]);
        let near = &evaluate(&case, &flow(), &shifted(0.005)).unwrap()[0];
        assert!(near.pass && (near.value.unwrap() - 0.005).abs() < 1e-9 && near.position.is_none());
        assert!((near.reference - 1.005).abs() < 1e-12);
        assert!(!evaluate(&case, &flow(), &shifted(0.02)).unwrap()[0].pass);
    }

    #[test]
    fn not_a_number_never_passes() {
        let mut snapshot = flow();
        snapshot.velocity[230].x = f64::NAN;
        let mut row = expectation(Measure::Maximum, Some(1.0));
        row.tolerance = f64::INFINITY;
        let result = &evaluate(&case(&[("u", row.clone())]), &snapshot, &BTreeMap::new()).unwrap()[0];
        assert_eq!((result.pass, result.value, result.error), (false, None, None));
        row.tolerance = f64::NAN;
        assert!(!evaluate(&case(&[("u", row)]), &flow(), &BTreeMap::new()).unwrap()[0].pass);
    }

    #[test]
    fn what_cannot_be_compared_is_an_error() {
        for (row, what) in [
            (expectation(Measure::Minimum, None), "`value`"),
            (expectation(Measure::Minimum, Some(0.0)), "zero"),
            (expectation(Measure::Profile, None), "`profile`"),
        ] {
            let error = evaluate(&case(&[("row", row)]), &flow(), &BTreeMap::new()).unwrap_err().to_string();
            assert!(error.contains("expect.row") && error.contains(what), "{error}");
        }
    }
}
