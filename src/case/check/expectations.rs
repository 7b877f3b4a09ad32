//! Checks of the published values that a run is held to.

use super::super::fault::{self, Fault};
use super::super::{Case, Component, Expectation, Line, Measure, Problem, Profile};
use super::is_line;

pub(super) fn check(case: &Case) -> Result<(), Fault> {
    case.expect.iter().try_for_each(|(name, expectation)| {
        let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
        if name.is_empty() || !name.chars().all(plain) {
            return Err(Fault { path: vec!["expect".to_owned(), name.clone()], problem: fault::Problem::Range });
        }
        check_one(case, expectation, &|key| format!("expect.{name}.{key}"))
    })
}

fn check_one(case: &Case, expectation: &Expectation, key: &dyn Fn(&str) -> String) -> Result<(), Fault> {
    check_motion(case, expectation, key)?;
    if expectation.measure.of_motion() {
        return check_words(expectation, key);
    }
    check_line(case, expectation, key)?;
    if expectation.component == Some(Component::P) && case.effects.pressure.is_none() {
        return Err(Fault::reason(&key("component"), "there is no pressure: the table effects.pressure is absent"));
    }
    check_measure(expectation, key)?;
    check_words(expectation, key)
}

fn check_words(expectation: &Expectation, key: &dyn Fn(&str) -> String) -> Result<(), Fault> {
    if expectation.tolerance <= 0.0 {
        return Err(Fault::range(&key("tolerance")));
    }
    if !is_line(&expectation.source) {
        return Err(Fault::range(&key("source")));
    }
    Ok(())
}

/// An error is taken over all points and against an exact solution, everything else along a line.
fn check_line(case: &Case, expectation: &Expectation, key: &dyn Fn(&str) -> String) -> Result<(), Fault> {
    let Expectation { line, measure, .. } = expectation;
    let component = &expectation.component.ok_or_else(|| Fault::missing(&key("component")))?;
    let problem = case.problem();
    if *measure == Measure::Error {
        if case.exact.is_none() && problem == Problem::Flow {
            return Err(Fault::reason(&key("measure"), "there is no exact solution: the table exact is absent"));
        }
        let known: &[Component] = match problem {
            Problem::Flow => &[Component::U, Component::V, Component::P, Component::Velocity],
            Problem::Poisson(_) => &[Component::P],
            Problem::Derivatives(_) => &[Component::Gradient, Component::Laplacian],
        };
        if !known.contains(component) {
            return Err(Fault::reason(&key("component"), "is nothing that this problem computes"));
        }
        return match line {
            Some(_) => Err(Fault::reason(&key("line"), "belongs to the other measures: an error is over all points")),
            None => Ok(()),
        };
    }
    if matches!(problem, Problem::Poisson(_)) && *component != Component::P {
        return Err(Fault::reason(&key("component"), "must be \"p\" with [poisson]"));
    }
    if matches!(problem, Problem::Derivatives(_)) {
        return Err(Fault::reason(&key("measure"), "must be \"error\" with [derivatives]"));
    }
    if matches!(component, Component::Velocity | Component::Gradient | Component::Laplacian) {
        return Err(Fault::reason(&key("component"), "belongs to the measure error; along a line it is u, v or p"));
    }
    let (at, length) = match line {
        None => return Err(Fault::missing(&key("line"))),
        Some(Line::X(x)) => (*x, case.domain.width),
        Some(Line::Y(y)) => (*y, case.domain.height),
    };
    if (0.0..=length).contains(&at) { Ok(()) } else { Err(Fault::range(&key("line"))) }
}

/// What is measured of points that move over a whole run takes keys of its own, and only those.
fn check_motion(case: &Case, row: &Expectation, key: &dyn Fn(&str) -> String) -> Result<(), Fault> {
    use Measure::{Area, Energy, Front, Noise, Period, Sensor};
    let stray: [(&str, bool, &[Measure]); 5] = [
        ("sensor", row.sensor.is_some(), &[Sensor, Noise]),
        ("length", row.length.is_some(), &[Front]),
        ("duration", row.duration.is_some(), &[Front]),
        ("delay", row.delay.is_some(), &[Front]),
        ("after", row.after.is_some(), &[Sensor, Noise, Area, Energy, Period]),
    ];
    let flow: [(&str, bool, &[Measure]); 5] = [
        ("component", row.component.is_some(), &[]),
        ("line", row.line.is_some(), &[]),
        ("column", row.column.is_some(), &[Front]),
        ("profile", row.profile.is_some(), &[Front]),
        ("value", row.value.is_some(), &[Sensor, Period]),
    ];
    let measured = row.measure.of_motion();
    let mut given = stray.iter().chain(flow.iter().filter(|_| measured));
    if let Some((name, _, measures)) = given.find(|(_, given, of)| *given && !of.contains(&row.measure)) {
        let words: Vec<&str> = measures.iter().map(|measure| measure.word()).collect();
        let to = if words.is_empty() { "other measures".to_owned() } else { format!("measures {}", words.join(", ")) };
        let reason = format!("belongs to the {to}, and measure is {:?}", row.measure.word());
        return Err(Fault::reason(&key(name), reason));
    }
    if !measured {
        return Ok(());
    }
    if !case.moves() {
        let reason = "is that of points that move, and effects.advection.motion is \"fixed\"";
        return Err(Fault::reason(&key("measure"), reason));
    }
    let needed = |given: bool, name: &str| if given { Ok(()) } else { Err(Fault::missing(&key(name))) };
    let positive = |value: Option<f64>, name: &str| {
        if value.is_none_or(|value| value > 0.0) { Ok(()) } else { Err(Fault::range(&key(name))) }
    };
    match row.measure {
        Front => {
            needed(row.profile.is_some(), "profile")?;
            needed(row.length.is_some(), "length")?;
            needed(row.duration.is_some(), "duration")?;
            positive(row.length, "length")?;
            positive(row.duration, "duration")
        }
        Sensor | Noise => {
            needed(row.sensor.is_some(), "sensor")?;
            if row.sensor.as_ref().is_some_and(|sensor| !case.output.sensors.contains_key(sensor)) {
                return Err(Fault::range(&key("sensor")));
            }
            needed(row.value.is_some() || row.measure == Noise, "value")?;
            if row.value == Some(0.0) {
                return Err(Fault::range(&key("value")));
            }
            check_after(case, row, key)
        }
        Period => {
            needed(row.value.is_some(), "value")?;
            positive(row.value, "value")?;
            check_after(case, row, key)
        }
        _ => check_after(case, row, key),
    }
}

/// Something comes after it.
fn check_after(case: &Case, row: &Expectation, key: &dyn Fn(&str) -> String) -> Result<(), Fault> {
    let within = row.after.is_none_or(|after| (0.0..case.time.end).contains(&after));
    if within { Ok(()) } else { Err(Fault::range(&key("after"))) }
}

/// An extreme has a value and no profile, a profile the reverse, an error neither.
fn check_measure(expectation: &Expectation, key: &dyn Fn(&str) -> String) -> Result<(), Fault> {
    let Expectation { measure, value, profile, column, .. } = expectation;
    let stray = |name: &str, reason: &str| Err(Fault::reason(&key(name), reason));
    if *measure != Measure::Profile {
        let reason = match measure {
            Measure::Error => "belongs to the measure profile, and measure is \"error\"",
            _ => "belongs to the measure profile, and measure is \"minimum\" or \"maximum\"",
        };
        if profile.is_some() || column.is_some() {
            return stray(if profile.is_some() { "profile" } else { "column" }, reason);
        }
    }
    match (measure, value, profile) {
        (Measure::Error | Measure::Profile, Some(_), _) => {
            let word = if *measure == Measure::Error { "error" } else { "profile" };
            stray("value", &format!("belongs to the measures minimum and maximum, and measure is {word:?}"))
        }
        (Measure::Profile, None, None) => Err(Fault::missing(&key("profile"))),
        (Measure::Minimum | Measure::Maximum, None, _) => Err(Fault::missing(&key("value"))),
        (Measure::Minimum | Measure::Maximum, Some(0.0), _) => Err(Fault::range(&key("value"))),
        _ => Ok(()),
    }
}

/// Reads every profile once, so that a run does not end at a missing file.
pub(in crate::case) fn check_profiles(case: &Case) -> Result<(), Fault> {
    case.expect.iter().try_for_each(|(name, expectation)| {
        let Some(path) = &expectation.profile else { return Ok(()) };
        let key = format!("expect.{name}.profile");
        let profile = Profile::read(path, expectation.column.as_deref());
        let profile = profile.map_err(|error| Fault::reason(&key, error.to_string()))?;
        if expectation.measure == Measure::Front {
            return match profile.value.contains(&0.0) {
                true => Err(Fault::reason(&key, "has a front at 0, and its error is relative")),
                false => Ok(()),
            };
        }
        let length = match expectation.line {
            Some(Line::Y(_)) => case.domain.width,
            _ => case.domain.height,
        };
        match profile.coordinate.iter().find(|at| !(0.0..=length).contains(*at)) {
            Some(at) => {
                Err(Fault::reason(&key, format!("has a row at {at} m, off the line, which is {length} m long")))
            }
            None => Ok(()),
        }
    })
}
