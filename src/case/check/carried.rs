//! Checks of heat, buoyancy and tracers, and of what the sides say of heat.

use super::super::fault::Fault;
use super::super::{Case, Problem, Remap, Shape, Tracer};
use super::require;

/// Names of columns that are taken.
const TAKEN: [&str; 7] = ["x", "y", "u", "v", "p", "temperature", "pressure"];

pub(super) fn check(case: &Case) -> Result<(), Fault> {
    check_sides(case)?;
    if case.problem() != Problem::Flow {
        return Ok(());
    }
    let effects = &case.effects;
    if let Some(heat) = &effects.heat {
        require(heat.diffusivity > 0.0, "effects.heat.diffusivity")?;
    }
    if let Some(buoyancy) = &effects.buoyancy {
        require(buoyancy.expansion != 0.0, "effects.buoyancy.expansion")?;
        for (name, present) in [("heat", effects.heat.is_some()), ("gravity", effects.gravity.is_some())] {
            if !present {
                let reason = format!("is the weight of warm fluid, and the table effects.{name} is absent");
                return Err(Fault::reason("effects.buoyancy", reason));
            }
        }
    }
    effects.tracers.iter().enumerate().try_for_each(|(number, tracer)| {
        check_tracer(case, number, tracer, &|key| format!("effects.tracers.[{number}].{key}"))
    })?;
    let forward = effects.advection.as_ref().is_some_and(|advection| advection.remap == Remap::Forward);
    if forward && (effects.heat.is_some() || !effects.tracers.is_empty()) {
        let reason = "carries the velocity alone: with effects.heat or effects.tracers it must be \"departure\"";
        return Err(Fault::reason("effects.advection.remap", reason));
    }
    Ok(())
}

fn check_tracer(case: &Case, number: usize, tracer: &Tracer, key: &dyn Fn(&str) -> String) -> Result<(), Fault> {
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let Tracer { name, diffusivity, shape, radius, size, .. } = tracer;
    let twice = case.effects.tracers[..number].iter().any(|other| other.name == *name);
    let good = !name.is_empty() && name.chars().all(plain) && !TAKEN.contains(&name.as_str()) && !twice;
    require(good, &key("name"))?;
    require(*diffusivity >= 0.0, &key("diffusivity"))?;
    if *diffusivity == 0.0 && case.effects.advection.is_none() {
        let reason = "nothing moves it: give it a diffusivity above 0 or the case the table effects.advection";
        return Err(Fault::reason(&key("diffusivity"), reason));
    }
    let (own, given, other, stray) = match shape {
        Shape::Box => ("size", size.is_some(), "radius", radius.is_some()),
        Shape::Gaussian | Shape::Disc => ("radius", radius.is_some(), "size", size.is_some()),
    };
    if stray {
        return Err(Fault::reason(&key(other), "belongs to another shape (effects.tracers.shape); leave it out"));
    }
    if !given {
        return Err(Fault::missing(&key(own)));
    }
    require(radius.is_none_or(|radius| radius > 0.0), &key("radius"))?;
    require(size.is_none_or(|[width, height]| width > 0.0 && height > 0.0), &key("size"))
}

/// Heat at the sides belongs to heat, and one side is held or heated.
fn check_sides(case: &Case) -> Result<(), Fault> {
    let [x, y] = case.domain.periodic.each();
    for ((name, wall), periodic) in case.boundaries.each().into_iter().zip([x, x, y, y]) {
        for (key, given) in [("temperature", wall.temperature.is_some()), ("heat_flux", wall.heat_flux.is_some())] {
            let key = format!("boundaries.{name}.{key}");
            let reason = match given {
                true if case.effects.heat.is_none() => "there is no heat: the table effects.heat is absent",
                true if periodic => {
                    "the domain repeats there (domain.periodic), so that there is no wall; leave it out"
                }
                _ => continue,
            };
            return Err(Fault::reason(&key, reason));
        }
        if wall.temperature.is_some() && wall.heat_flux.is_some() {
            let key = format!("boundaries.{name}.heat_flux");
            return Err(Fault::reason(&key, "the side is held at boundaries.*.temperature; leave out one of them"));
        }
    }
    Ok(())
}
