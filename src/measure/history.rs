//! What a case expects of points that move, held against the reports of a whole run.

use super::Profile;
use super::expect::Found;
use crate::case::{Case, Expectation, Measure};
use crate::motion::Row;

/// Measures a row over `rows`, which ascend in time. Where they say nothing the value is no number.
///
/// # Errors
/// A key that the measure needs and the row lacks.
pub(super) fn found(
    case: &Case,
    row: &Expectation,
    rows: &[Row],
    profile: Option<&Profile>,
) -> Result<Found, &'static str> {
    let after = row.after.unwrap_or(0.0);
    let late = || rows.iter().filter(move |row| row.time >= after);
    match row.measure {
        Measure::Front => Ok(front(row, rows, profile.ok_or("`profile` was not read")?)),
        Measure::Area => Ok(farthest(late(), 1.0, |row| row.area)),
        Measure::Energy => {
            let energy = |row: &Row| row.kinetic_energy + row.potential_energy;
            Ok(farthest(late(), rows.first().map_or(1.0, energy), energy))
        }
        Measure::Period => {
            let reference = row.value.ok_or("`value` is missing")?;
            let value = period(&late().map(|row| (row.time, row.column)).collect::<Vec<_>>());
            Ok(Found { position: None, value, reference, difference: (value - reference).abs() })
        }
        _ => {
            let name = row.sensor.as_ref().ok_or("`sensor` is missing")?;
            let sensor = case.output.sensors.keys().position(|key| key == name).ok_or("there is no such sensor")?;
            let pressure: Vec<f64> = late().filter_map(|row| row.sensors.get(sensor).copied()).collect();
            let mean = mean(pressure.iter().copied());
            if row.measure == Measure::Noise {
                return Ok(noise(&pressure, mean));
            }
            let reference = row.value.ok_or("`value` is missing")?;
            Ok(Found { position: None, value: mean, reference, difference: (mean - reference).abs() })
        }
    }
}

/// The place of a published course where the run is farthest from it, relative to what was published.
fn front(row: &Expectation, rows: &[Row], profile: &Profile) -> Found {
    let (length, duration) = (row.length.unwrap_or(1.0), row.duration.unwrap_or(1.0));
    let nothing = Found { position: None, value: f64::NAN, reference: 1.0, difference: f64::NAN };
    let published = profile.coordinate.iter().zip(&profile.value);
    let timed = published.map(|(&at, &reference)| ((at - row.delay.unwrap_or(0.0)) * duration, reference));
    let each = timed.filter(|(time, _)| row.after.is_none_or(|after| *time >= after)).map(|(time, reference)| {
        let value = front_at(rows, time) / length;
        Found { position: Some(time), value, reference, difference: (value - reference).abs() }
    });
    let off = |found: &Found| found.difference / found.reference.abs();
    // A time that the run did not reach is no number, and stays.
    each.reduce(|worst, next| if off(&worst).is_nan() || off(&next) <= off(&worst) { worst } else { next })
        .unwrap_or(nothing)
}

/// How far the fluid reaches at a time, between two reports on the straight line; before the first as at the first, no number
/// behind the last.
fn front_at(rows: &[Row], time: f64) -> f64 {
    let next = rows.partition_point(|row| row.time < time);
    match (next.checked_sub(1).map(|last| &rows[last]), rows.get(next)) {
        (Some(a), Some(b)) => a.front + (b.front - a.front) * (time - a.time) / (b.time - a.time),
        (None, Some(first)) => first.front,
        (_, None) => f64::NAN,
    }
}

/// Where a quantity is farthest from `reference`.
fn farthest<'a>(rows: impl Iterator<Item = &'a Row>, reference: f64, of: impl Fn(&Row) -> f64) -> Found {
    let off = |row: &&Row| (of(row) - reference).abs();
    let farthest = rows.max_by(|a, b| off(a).total_cmp(&off(b)));
    let value = farthest.map_or(f64::NAN, of);
    Found { position: farthest.map(|row| row.time), value, reference, difference: (value - reference).abs() }
}

/// Mean time between two rises through the mean, each counted once the values have been well below it; no number with fewer
/// than two rises.
fn period(course: &[(f64, f64)]) -> f64 {
    let middle = mean(course.iter().map(|(_, value)| *value));
    let below = middle - 0.5 * mean(course.iter().map(|(_, value)| (value - middle).powi(2))).sqrt();
    let (mut armed, mut rises) = (false, Vec::new());
    for pair in course.windows(2) {
        let ((before, low), (after, high)) = (pair[0], pair[1]);
        armed |= low < below;
        if armed && low < middle && high >= middle {
            rises.push(before + (after - before) * (middle - low) / (high - low));
            armed = false;
        }
    }
    match rises[..] {
        [first, .., last] => (last - first) / (rises.len() - 1) as f64,
        _ => f64::NAN,
    }
}

fn noise(pressure: &[f64], mean_pressure: f64) -> Found {
    let rms = mean(pressure.iter().map(|p| (p - mean_pressure).powi(2))).sqrt();
    let reference = if mean_pressure.is_finite() { mean_pressure } else { 0.0 };
    Found { position: None, value: rms, reference, difference: rms }
}

fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len() as f64;
    values.sum::<f64>() / count
}

/// In words.
pub(super) fn quantity(row: &Expectation) -> String {
    let after = row.after.map_or(String::new(), |after| format!(" after {after} s"));
    let sensor = row.sensor.as_deref().unwrap_or_default();
    match row.measure {
        Measure::Sensor => format!("mean pressure at {sensor}{after}"),
        Measure::Noise => format!("noise of the pressure at {sensor}{after}"),
        Measure::Area => format!("area of the fluid{after}"),
        Measure::Energy => format!("energy of the fluid{after}"),
        Measure::Period => format!("period of the height at the left wall{after}"),
        _ => format!("front of the fluid{after}"),
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::super::{ExpectationResult, evaluate_run};
    use super::*;
    use crate::snapshot::Snapshot;
    use glam::DVec2;

    /// A front that runs at 2 m/s from x = 1 m, a pressure of 100 Pa with ripples of 1 Pa, an area that shrinks by a tenth.
    fn rows() -> Vec<Row> {
        let at = |step: u64| {
            let time = 0.1 * step as f64;
            let ripple = if step.is_multiple_of(2) { 1.0 } else { -1.0 };
            let sensors = vec![if time < 0.45 { 1e6 } else { 100.0 + ripple }];
            Row { step, time, front: 1.0 + 2.0 * time, area: 1.0 - 0.1 * time, sensors, ..Row::default() }
        };
        (0..=10).map(at).collect()
    }

    fn result(expect: &str, rows: &[Row]) -> Result<ExpectationResult, String> {
        let text = format!(
            "title = 't'\ndomain = {{ width = 1.0, height = 1.0 }}\ncloud = {{ arrangement = 'regular', spacing = 0.1 }}\n\
             fluid.density = 1.0\noutput.sensors.wall = {{ at = [0.0, 0.0] }}\n[expect.a]\n{expect}\ntolerance = 0.02\n\
             source = 'a paper'\n"
        );
        let case: Case = toml::from_str(&text).unwrap();
        // In half metres and fifths of a second, 0.2 of those late.
        let profile = Profile { coordinate: vec![0.7, 1.2, 2.7], value: vec![2.4, 2.8, 4.0] };
        let profiles = BTreeMap::from([("a".to_owned(), profile)]);
        let one = vec![DVec2::splat(0.5)];
        let snapshot = Snapshot { velocity: one.clone(), position: one, pressure: vec![0.0], ..Snapshot::default() };
        let results = evaluate_run(&case, &snapshot, rows, &profiles).map_err(|error| error.to_string())?;
        Ok(results.into_iter().next().unwrap())
    }

    #[test]
    fn a_front_is_held_to_a_course_in_its_own_units_and_with_its_delay() {
        let front = |delay: &str| format!("measure = 'front'\nlength = 0.5\nduration = 0.2\ndelay = {delay}");
        let right = result(&front("0.2"), &rows()).unwrap();
        assert!(right.pass && right.error.unwrap() < 1e-12, "{right:?}");
        // Half a unit of time is 0.1 s, and so 0.4 half metres: most of the first value.
        let late = result(&front("-0.3"), &rows()).unwrap();
        assert!(!late.pass && (late.error.unwrap() - 0.4 / 2.4).abs() < 1e-12, "{late:?}");
        assert!((late.position.unwrap() - 0.2).abs() < 1e-12 && (late.value.unwrap() - 2.8).abs() < 1e-12);
        assert_eq!(late.quantity, "front of the fluid");
        // From a time on: without the first published value, which is the farthest off.
        let rest = result(&(front("-0.3") + "\nafter = 0.25"), &rows()).unwrap();
        assert!(!rest.pass && (rest.error.unwrap() - 0.4 / 2.8).abs() < 1e-12, "{rest:?}");
        assert_eq!(rest.quantity, "front of the fluid after 0.25 s");
        assert_eq!(result(&(front("0.2") + "\nafter = 0.9"), &rows()).unwrap().value, None);
        let short = result(&front("0.2"), &rows()[..4]).unwrap();
        assert_eq!((short.pass, short.value, short.error), (false, None, None));
        assert!(!result(&front("0.2"), &[]).unwrap().pass);
    }

    #[test]
    fn a_sensor_is_held_to_its_mean_and_its_noise_once_it_has_settled() {
        let sensor = |after: &str| format!("measure = 'sensor'\nsensor = 'wall'\nvalue = 101.0{after}");
        let mean = result(&sensor("\nafter = 0.55"), &rows()).unwrap();
        assert!(mean.pass && (mean.value.unwrap() - 100.2).abs() < 1e-9, "{mean:?}");
        assert!(!result(&sensor(""), &rows()).unwrap().pass);
        let noise = result("measure = 'noise'\nsensor = 'wall'\nafter = 0.65", &rows()).unwrap();
        assert!(noise.pass && (noise.error.unwrap() - 0.01).abs() < 1e-9, "{noise:?}");
        assert!(!result("measure = 'noise'\nsensor = 'wall'", &rows()).unwrap().pass);
        let never = result("measure = 'noise'\nsensor = 'wall'\nafter = 2.0", &rows()).unwrap();
        assert_eq!((never.pass, never.value), (false, None));
    }

    #[test]
    fn an_area_is_held_to_that_at_the_start() {
        let area = result("measure = 'area'", &rows()).unwrap();
        assert!(!area.pass && (area.error.unwrap() - 0.1).abs() < 1e-12 && area.position == Some(1.0), "{area:?}");
        assert!(result("measure = 'area'", &rows()[..2]).unwrap().pass);
    }

    #[test]
    fn an_energy_is_held_to_that_at_the_start() {
        let mut rows = rows();
        rows.iter_mut().for_each(|row| (row.kinetic_energy, row.potential_energy) = (3.0, 1.0));
        rows[7].kinetic_energy = 2.96;
        let kept = result("measure = 'energy'", &rows).unwrap();
        assert!(kept.pass && (kept.error.unwrap() - 0.01).abs() < 1e-12 && kept.value == Some(3.96), "{kept:?}");
        rows[7].kinetic_energy = 2.5;
        assert!(!result("measure = 'energy'", &rows).unwrap().pass);
        assert!(result("measure = 'energy'\nafter = 0.75", &rows).unwrap().pass);
    }

    #[test]
    fn a_period_is_that_of_the_height_and_small_ripples_do_not_count() {
        let at = |step: u64| {
            let time = 0.01 * step as f64;
            let column = 1.0 + 0.1 * (std::f64::consts::TAU * time / 0.7).cos() + 0.01 * (90.0 * time).sin();
            Row { step, time, column, ..Row::default() }
        };
        let rows: Vec<Row> = (0..300).map(at).collect();
        let period = |value: f64| result(&format!("measure = 'period'\nvalue = {value:?}"), &rows).unwrap();
        assert!(period(0.7).pass && !period(0.75).pass, "{:?}", period(0.7));
        assert_eq!(result("measure = 'period'\nvalue = 0.7", &rows[..80]).unwrap().value, None);
    }

    #[test]
    fn what_is_missing_is_named() {
        let lacking = |expect: &str| result(expect, &rows()).unwrap_err();
        assert!(lacking("measure = 'sensor'\nvalue = 1.0").ends_with("`sensor` is missing"));
        assert!(lacking("measure = 'sensor'\nsensor = 'wall'").ends_with("`value` is missing"));
        assert!(lacking("measure = 'noise'\nsensor = 'floor'").ends_with("there is no such sensor"));
    }
}
