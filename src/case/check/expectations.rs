//! Checks of the published values that a run is held to.

use super::super::fault::{Fault, Problem};
use super::super::{Case, Component, Expectation, Line, Measure, Profile};
use super::is_line;

pub(super) fn check(case: &Case) -> Result<(), Fault> {
    case.expect.iter().try_for_each(|(name, expectation)| {
        let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
        if name.is_empty() || !name.chars().all(plain) {
            return Err(Fault { path: vec!["expect".to_owned(), name.clone()], problem: Problem::Range });
        }
        check_one(case, expectation, &|key| format!("expect.{name}.{key}"))
    })
}

fn check_one(case: &Case, expectation: &Expectation, key: &dyn Fn(&str) -> String) -> Result<(), Fault> {
    let (at, length) = match expectation.line {
        Line::X(x) => (x, case.domain.width),
        Line::Y(y) => (y, case.domain.height),
    };
    if !(0.0..=length).contains(&at) {
        return Err(Fault::range(&key("line")));
    }
    if expectation.component == Component::P && case.effects.pressure.is_none() {
        return Err(Fault::reason(&key("component"), "there is no pressure: the table effects.pressure is absent"));
    }
    check_measure(expectation, key)?;
    if expectation.tolerance <= 0.0 {
        return Err(Fault::range(&key("tolerance")));
    }
    if !is_line(&expectation.source) {
        return Err(Fault::range(&key("source")));
    }
    Ok(())
}

/// An extreme has a value and no profile, a profile the reverse.
fn check_measure(expectation: &Expectation, key: &dyn Fn(&str) -> String) -> Result<(), Fault> {
    let Expectation { value, profile, column, .. } = expectation;
    let stray = |name: &str, reason: &str| Err(Fault::reason(&key(name), reason));
    if expectation.measure == Measure::Profile {
        return match (value, profile) {
            (Some(_), _) => stray("value", "belongs to the measures minimum and maximum, and measure is \"profile\""),
            (None, None) => Err(Fault::missing(&key("profile"))),
            (None, Some(_)) => Ok(()),
        };
    }
    let reason = "belongs to the measure profile, and measure is \"minimum\" or \"maximum\"";
    match (profile, column, value) {
        (Some(_), ..) => stray("profile", reason),
        (None, Some(_), _) => stray("column", reason),
        (None, None, None) => Err(Fault::missing(&key("value"))),
        (None, None, Some(0.0)) => Err(Fault::range(&key("value"))),
        (None, None, Some(_)) => Ok(()),
    }
}

/// Reads every profile once, so that a run does not end at a missing file.
pub(in crate::case) fn check_profiles(case: &Case) -> Result<(), Fault> {
    case.expect.iter().try_for_each(|(name, expectation)| {
        let Some(path) = &expectation.profile else { return Ok(()) };
        let key = format!("expect.{name}.profile");
        let profile = Profile::read(path, expectation.column.as_deref());
        let profile = profile.map_err(|error| Fault::reason(&key, error.to_string()))?;
        let length = match expectation.line {
            Line::X(_) => case.domain.height,
            Line::Y(_) => case.domain.width,
        };
        match profile.coordinate.iter().find(|at| !(0.0..=length).contains(*at)) {
            Some(at) => {
                Err(Fault::reason(&key, format!("has a row at {at} m, off the line, which is {length} m long")))
            }
            None => Ok(()),
        }
    })
}
