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
    }
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
