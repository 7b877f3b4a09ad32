//! Checks that a case is one that its exact solution solves.

use super::super::fault::Fault;
use super::super::{Axes, Case, Domain, Field, Problem, Solution};

/// Part by which the sides of a box may miss a whole number of wavelengths.
const WHOLE_WITHIN: f64 = 1e-9;

pub(super) fn check(case: &Case) -> Result<(), Fault> {
    check_known(case)?;
    let Some(exact) = &case.exact else { return Ok(()) };
    if case.problem() != Problem::Flow {
        return Err(Fault::reason(
            "exact",
            "belongs to a flow; beside the tables derivatives and poisson leave it out",
        ));
    }
    let effects = &case.effects;
    match exact.solution {
        Solution::Rotation => return rotation(case),
        Solution::Couette | Solution::Poiseuille => return plates(case, exact.solution),
        Solution::Conduction => return conduction(case),
        Solution::TaylorGreen | Solution::Kovasznay => {}
    }
    let present = [
        ("viscosity", effects.viscosity.is_some()),
        ("pressure", effects.pressure.is_some()),
        ("advection", effects.advection.is_some()),
    ];
    if let Some((lacking, _)) = present.iter().find(|(_, present)| !present) {
        let reason = format!("solves the equations with every effect, and the table effects.{lacking} is absent");
        return Err(Fault::reason("exact.solution", reason));
    }
    if effects.gravity.is_some() {
        return Err(Fault::reason(
            "exact.solution",
            "has no gravity, and there is effects.gravity; leave out one of them",
        ));
    }
    match exact.solution {
        Solution::TaylorGreen => taylor_green(&case.domain),
        Solution::Kovasznay => kovasznay(&case.domain),
        _ => Ok(()),
    }
}

/// Prescribed: nothing may change it, and something is to be carried.
fn rotation(case: &Case) -> Result<(), Fault> {
    let effects = &case.effects;
    let pushed = [
        ("viscosity", effects.viscosity.is_some()),
        ("pressure", effects.pressure.is_some()),
        ("gravity", effects.gravity.is_some()),
        ("buoyancy", effects.buoyancy.is_some()),
    ];
    let reason = if let Some((name, _)) = pushed.iter().find(|(_, present)| *present) {
        format!("prescribes the velocity, which effects.{name} would change; leave out one of them")
    } else if effects.advection.is_none() {
        "carries fields, and the table effects.advection is absent".to_owned()
    } else if effects.heat.is_none() && effects.tracers.is_empty() {
        "carries fields, and there is neither effects.heat nor effects.tracers".to_owned()
    } else if case.domain.periodic != Axes::None {
        "does not repeat: it needs domain.periodic = \"none\"".to_owned()
    } else {
        return Ok(());
    };
    Err(Fault::reason("exact.solution", reason))
}

/// A flow along x between the bottom and the top.
fn plates(case: &Case, solution: Solution) -> Result<(), Fault> {
    let effects = &case.effects;
    let speeds = [&case.boundaries.bottom, &case.boundaries.top].map(|wall| wall.velocity[0]);
    let driven = effects.gravity.as_ref().map(|gravity| gravity.acceleration);
    let reason = if effects.viscosity.is_none() {
        "is a balance of viscosity, and the table effects.viscosity is absent"
    } else if case.domain.periodic != Axes::X {
        "is the same all along x: it needs domain.periodic = \"x\""
    } else if effects.buoyancy.is_some() {
        "has no buoyancy, and there is effects.buoyancy; leave out one of them"
    } else if solution == Solution::Couette && (driven.is_some() || speeds == [0.0, 0.0]) {
        "is driven by boundaries.top.velocity or boundaries.bottom.velocity alone, and not by effects.gravity"
    } else if solution == Solution::Poiseuille && (driven.is_none_or(|[_, y]| y != 0.0) || speeds != [0.0, 0.0]) {
        "is driven by effects.gravity.acceleration = [G, 0] alone, between plates at rest"
    } else {
        return Ok(());
    };
    Err(Fault::reason("exact.solution", reason))
}

/// Fluid at rest between the left side and the right.
fn conduction(case: &Case) -> Result<(), Fault> {
    let walls = &case.boundaries;
    let held = walls.left.temperature.is_some() && walls.right.temperature.is_some();
    let others = [&walls.bottom, &walls.top].iter().any(|wall| wall.temperature.is_some() || wall.heat_flux.is_some());
    let reason = if case.effects.heat.is_none() {
        "is of heat, and the table effects.heat is absent"
    } else if case.velocity_changes() || case.effects.advection.is_some() {
        "is of fluid at rest: of the effects it goes with effects.heat and effects.tracers alone"
    } else if !held || others {
        "needs boundaries.left.temperature and boundaries.right.temperature, and says nothing of heat at the other sides"
    } else {
        return Ok(());
    };
    Err(Fault::reason("exact.solution", reason))
}

/// A known field repeats where the domain does.
fn check_known(case: &Case) -> Result<(), Fault> {
    let key = match case.problem() {
        Problem::Derivatives(Field::Cosines) => "derivatives.field",
        Problem::Poisson(Field::Cosines) => "poisson.field",
        Problem::Poisson(Field::Waves) if !case.domain.periodic.each()[0] => {
            let reason = "has a slope across the walls at left and right: it needs domain.periodic = \"x\" or \"both\"";
            return Err(Fault::reason("poisson.field", reason));
        }
        _ => return Ok(()),
    };
    match case.domain.periodic {
        Axes::None => Ok(()),
        _ => Err(Fault::reason(key, "does not repeat with the domain: it needs domain.periodic = \"none\"")),
    }
}

fn taylor_green(domain: &Domain) -> Result<(), Fault> {
    if domain.periodic != Axes::Both {
        return Err(Fault::reason("exact.solution", "repeats along x and y: it needs domain.periodic = \"both\""));
    }
    let Domain { width, height, .. } = *domain;
    let waves = width.max(height) / width.min(height);
    if (waves - waves.round()).abs() > WHOLE_WITHIN * waves {
        let reason = format!(
            "has square vortices, as long as the shorter side of {width} x {height} m; \
             the longer one must be a whole number of them (domain.width, domain.height)"
        );
        return Err(Fault::reason("exact.solution", reason));
    }
    Ok(())
}

fn kovasznay(domain: &Domain) -> Result<(), Fault> {
    match domain.periodic {
        Axes::None => Ok(()),
        _ => Err(Fault::reason(
            "exact.solution",
            "prescribes the velocity on all four sides: it needs domain.periodic = \"none\"",
        )),
    }
}
