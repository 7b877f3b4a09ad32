//! Checks of the published values that a run is held to.

use super::super::fault::{self, Fault};
use super::super::{Case, Component, Expectation, Line, Measure, Problem, Profile, SIDES, Shape, SideKind, Solution};
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
    check_field(case, expectation, key)?;
    match expectation.measure {
        Measure::Force | Measure::Difference | Measure::Flux => check_probe(case, expectation, key)?,
        _ => check_line(case, expectation, key)?,
    }
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

/// The fields that are carried are there, and a tracer is named.
fn check_field(case: &Case, expectation: &Expectation, key: &dyn Fn(&str) -> String) -> Result<(), Fault> {
    let Expectation { component, measure, tracer, side, .. } = expectation;
    if *component == Some(Component::Temperature) && case.effects.heat.is_none() {
        return Err(Fault::reason(&key("component"), "there is no temperature: the table effects.heat is absent"));
    }
    match (tracer, *component == Some(Component::Tracer)) {
        (None, true) => return Err(Fault::missing(&key("tracer"))),
        (Some(_), false) => return Err(Fault::reason(&key("tracer"), "belongs to the component tracer; leave it out")),
        (Some(name), true) if !case.effects.tracers.iter().any(|tracer| tracer.name == *name) => {
            return Err(Fault::range(&key("tracer")));
        }
        _ => {}
    }
    match (side, *measure == Measure::Slope) {
        (None, true) => Err(Fault::missing(&key("side"))),
        (Some(_), false) => Err(Fault::reason(&key("side"), "belongs to the measure slope; leave it out")),
        _ => Ok(()),
    }
}

/// What the exact solution of a flow says of.
fn known(case: &Case, expectation: &Expectation) -> &'static [Component] {
    const FLOW: &[Component] = &[Component::U, Component::V, Component::P, Component::Velocity];
    match case.exact.as_ref().map(|exact| exact.solution) {
        Some(Solution::Couette | Solution::Poiseuille) => &[Component::U, Component::Velocity],
        Some(Solution::Conduction) => &[Component::Temperature],
        Some(Solution::Rotation) => {
            let spreads = |name: &String| {
                let mut tracers = case.effects.tracers.iter();
                tracers.any(|own| own.name == *name && own.diffusivity > 0.0 && own.shape != Shape::Gaussian)
            };
            if expectation.tracer.as_ref().is_some_and(spreads) { &[] } else { &[Component::Tracer] }
        }
        _ => FLOW,
    }
}

/// An error is taken over all points and against an exact solution, everything else along a line.
fn check_line(case: &Case, expectation: &Expectation, key: &dyn Fn(&str) -> String) -> Result<(), Fault> {
    let Expectation { line, measure, on, between, .. } = expectation;
    let component = &expectation.component.ok_or_else(|| Fault::missing(&key("component")))?;
    for (name, given) in [("on", on.is_some()), ("between", between.is_some())] {
        if given {
            return Err(Fault::reason(&key(name), "belongs to the measures force, difference and flux; leave it out"));
        }
    }
    let problem = case.problem();
    if *measure == Measure::Error {
        if case.exact.is_none() && problem == Problem::Flow {
            return Err(Fault::reason(&key("measure"), "there is no exact solution: the table exact is absent"));
        }
        let known: &[Component] = match problem {
            Problem::Flow => known(case, expectation),
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
    let over_all: Option<(&[Component], &str)> = match measure {
        Measure::Slope => Some((&[Component::Temperature], "must be \"temperature\" with this measure")),
        Measure::Loss => {
            Some((&[Component::Tracer, Component::Velocity], "must be \"tracer\" or \"velocity\" with this measure"))
        }
        _ => None,
    };
    if let Some((own, reason)) = over_all {
        if !own.contains(component) {
            return Err(Fault::reason(&key("component"), reason));
        }
        if *component == Component::Velocity && !case.has_side(SideKind::Inlet) {
            let reason = "is what comes in and does not go out: no side has boundaries.*.kind = \"inlet\"";
            return Err(Fault::reason(&key("measure"), reason));
        }
        return match line {
            Some(_) => Err(Fault::reason(&key("line"), "belongs to the measures minimum, maximum and profile")),
            None => Ok(()),
        };
    }
    if matches!(problem, Problem::Poisson(_)) && *component != Component::P {
        return Err(Fault::reason(&key("component"), "must be \"p\" with [poisson]"));
    }
    if matches!(problem, Problem::Derivatives(_)) {
        return Err(Fault::reason(&key("measure"), "must be \"error\" with [derivatives]"));
    }
    if matches!(component, Component::Velocity | Component::Tracer | Component::Gradient | Component::Laplacian) {
        let reason = "belongs to other measures; along a line it is u, v, p or temperature";
        return Err(Fault::reason(&key("component"), reason));
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
        ("after", row.after.is_some(), &[Front, Sensor, Noise, Area, Energy, Period]),
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
            positive(row.duration, "duration")?;
            check_after(case, row, key)
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

/// Forces, differences and fluxes: where they are measured, and of what.
fn check_probe(case: &Case, expectation: &Expectation, key: &dyn Fn(&str) -> String) -> Result<(), Fault> {
    let Expectation { measure, line, on, between, .. } = expectation;
    let component = &expectation.component.ok_or_else(|| Fault::missing(&key("component")))?;
    if case.problem() != Problem::Flow && *measure != Measure::Difference {
        return Err(Fault::reason(&key("measure"), "belongs to a flow"));
    }
    if line.is_some() {
        return Err(Fault::reason(&key("line"), "belongs to measures along a line; leave it out"));
    }
    let (components, word): (&[Component], &str) = match measure {
        Measure::Force => (&[Component::X, Component::Y], "\"x\" or \"y\" with measure = \"force\""),
        Measure::Flux => (&[Component::Velocity], "\"velocity\" with measure = \"flux\""),
        _ => (&[Component::U, Component::V, Component::P], "\"u\", \"v\" or \"p\" with measure = \"difference\""),
    };
    if !components.contains(component) {
        return Err(Fault::reason(&key("component"), format!("must be {word}")));
    }
    if *measure == Measure::Difference {
        if on.is_some() {
            return Err(Fault::reason(&key("on"), "belongs to the measures force and flux; leave it out"));
        }
        let places = between.ok_or_else(|| Fault::missing(&key("between")))?;
        let inside =
            |[x, y]: [f64; 2]| (0.0..=case.domain.width).contains(&x) && (0.0..=case.domain.height).contains(&y);
        return if places.into_iter().all(inside) { Ok(()) } else { Err(Fault::range(&key("between"))) };
    }
    if between.is_some() {
        return Err(Fault::reason(&key("between"), "belongs to the measure difference; leave it out"));
    }
    let on = on.as_ref().ok_or_else(|| Fault::missing(&key("on")))?;
    let known = case.obstacles.iter().any(|obstacle| obstacle.name == *on)
        || (*measure == Measure::Flux && SIDES.contains(&on.as_str()));
    if known { Ok(()) } else { Err(Fault::range(&key("on"))) }
}

/// An extreme has a value and no profile, a profile the reverse, an error neither.
fn check_measure(expectation: &Expectation, key: &dyn Fn(&str) -> String) -> Result<(), Fault> {
    let Expectation { measure, value, profile, column, .. } = expectation;
    let stray = |name: &str, reason: &str| Err(Fault::reason(&key(name), reason));
    if *measure != Measure::Profile {
        let reason = match measure {
            Measure::Minimum | Measure::Maximum => {
                "belongs to the measure profile, and measure is \"minimum\" or \"maximum\""
            }
            _ => "belongs to the measure profile, which this is not",
        };
        if profile.is_some() || column.is_some() {
            return stray(if profile.is_some() { "profile" } else { "column" }, reason);
        }
    }
    match (measure, value, profile) {
        (Measure::Error | Measure::Profile | Measure::Loss, Some(_), _) => {
            stray("value", "belongs to the measures minimum, maximum and slope, and to force, difference and flux")
        }
        (Measure::Profile, None, None) => Err(Fault::missing(&key("profile"))),
        (Measure::Error | Measure::Profile | Measure::Loss, ..) => Ok(()),
        (_, None, _) => Err(Fault::missing(&key("value"))),
        (_, Some(0.0), _) => Err(Fault::range(&key("value"))),
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
