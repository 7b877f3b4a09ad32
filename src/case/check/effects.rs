//! Checks of the effects, and of the method and the time step where they depend on them.

use super::super::fault::Fault;
use super::super::{
    Boundaries, Case, Divergence, Drag, Effects, Gradient, Operators, Preconditioner, Pressure, PressureForm, Problem,
    Remap, Scheme, Solver, Time,
};
use super::require;

/// Largest displacement of a forward remap, in spacings: beyond, its worst mode grows in every step.
pub const LONGEST_FORWARD: f64 = 1.0;

pub(super) fn check(case: &Case) -> Result<(), Fault> {
    if case.problem() != Problem::Flow {
        return check_problem(case);
    }
    if case.method.operators == Operators::Integral
        && case.effects.pressure.as_ref().is_some_and(|pressure| pressure.form() == PressureForm::Collocated)
    {
        let reason = "must be \"interpolation\" with effects.pressure.form = \"collocated\", whose rows are fits";
        return Err(Fault::reason("method.operators", reason));
    }
    if case.effects == Effects::default() {
        let reason = "nothing to compute: give at least one of effects.viscosity, effects.pressure, effects.advection, \
                      effects.gravity, effects.heat, effects.tracers";
        return Err(Fault::reason("effects", reason));
    }
    if let Some(viscosity) = &case.effects.viscosity {
        require(viscosity.kinematic > 0.0, "effects.viscosity.kinematic")?;
        match viscosity.scheme {
            Scheme::Explicit => second_derivatives(case, "effects.viscosity")?,
            Scheme::Implicit => check_implicit(case)?,
        }
        let within = viscosity.tolerance.is_none_or(|tolerance| tolerance > 0.0 && tolerance < 1.0);
        require(within, "effects.viscosity.tolerance")?;
        if viscosity.tolerance.is_some() && viscosity.scheme == Scheme::Explicit {
            let reason = "belongs to a solve, and effects.viscosity.scheme is \"explicit\"; leave it out";
            return Err(Fault::reason("effects.viscosity.tolerance", reason));
        }
    }
    if let Some(pressure) = &case.effects.pressure {
        check_pressure(pressure)?;
        check_preconditioner(case, pressure)?;
        if pressure.form() == PressureForm::Collocated {
            second_derivatives(case, "effects.pressure.form = \"collocated\"")?;
        }
    }
    if let Some(gravity) = &case.effects.gravity {
        require(gravity.acceleration != [0.0, 0.0], "effects.gravity.acceleration")?;
    }
    case.effects.drag.as_ref().map_or(Ok(()), |drag| check_drag(case, drag))?;
    check_remap(case)
}

fn check_drag(case: &Case, drag: &Drag) -> Result<(), Fault> {
    let stray = |reason: &str| Err(Fault::reason("effects.drag", reason));
    if case.effects.viscosity.is_none() {
        return stray("is that of viscosity in narrow ways, and the table effects.viscosity is absent");
    }
    if case.implicit_viscosity() {
        return stray("goes with effects.viscosity.scheme = \"explicit\" alone");
    }
    if case.moves() {
        return stray("must be left out with points that move (effects.advection.motion)");
    }
    if case.exact.is_some() {
        return stray("has no place in the exact solution (exact.solution); leave out one of them");
    }
    require(drag.permeability > 0.0, "effects.drag.permeability")?;
    require(drag.inertia >= 0.0, "effects.drag.inertia")?;
    require(drag.circle.as_ref().is_none_or(|circle| circle.radius > 0.0), "effects.drag.circle.radius")?;
    require(drag.polygon.as_ref().is_none_or(|corners| corners.len() >= 3), "effects.drag.polygon")?;
    match (&drag.circle, &drag.polygon) {
        (Some(_), Some(_)) => Err(Fault::reason("effects.drag.polygon", "there is a circle; leave one out")),
        _ => Ok(()),
    }
}

/// Implicit viscosity goes through the faces of the cells, between velocities that are given on every side.
fn check_implicit(case: &Case) -> Result<(), Fault> {
    let collocated = |pressure: &Pressure| pressure.form() == PressureForm::Collocated;
    let reason = if case.moves() {
        "must be \"explicit\" with points that move (effects.advection.motion)"
    } else if case.effects.pressure.as_ref().is_some_and(collocated) {
        "must be \"explicit\" with effects.pressure.form = \"collocated\", whose walls ask for the force on them"
    } else if case.has_open_sides() {
        "must be \"explicit\" with boundaries.*.kind = \"slip\" or \"outlet\", whose velocities are not given"
    } else {
        return Ok(());
    };
    Err(Fault::reason("effects.viscosity.scheme", reason))
}

/// Problems without time: what they leave no room for, and what they need.
fn check_problem(case: &Case) -> Result<(), Fault> {
    let Effects { viscosity, pressure, advection, gravity, drag, heat, buoyancy, tracers } = &case.effects;
    let name = if case.derivatives.is_some() { "derivatives" } else { "poisson" };
    let stray = |key: &str| Err(Fault::reason(key, format!("belongs to a flow, and there is [{name}]; leave one out")));
    if case.derivatives.is_some() && case.poisson.is_some() {
        return Err(Fault::reason("poisson", "a case has one problem, and there is [derivatives]; leave one out"));
    }
    if case.time != Time::default() {
        return stray("time");
    }
    let others = gravity.is_some() || drag.is_some() || heat.is_some() || buoyancy.is_some() || !tracers.is_empty();
    if viscosity.is_some() || advection.is_some() || others || (pressure.is_some() && case.derivatives.is_some()) {
        return stray("effects");
    }
    if case.boundaries != Boundaries::default() {
        return stray("boundaries");
    }
    let Some(pressure) = (match case.problem() {
        Problem::Poisson(_) => pressure.as_ref(),
        _ => return Ok(()),
    }) else {
        return Err(Fault::reason("poisson", "needs the table [effects.pressure], which says how it is solved"));
    };
    if case.method.operators == Operators::Integral {
        return Err(Fault::reason("method.operators", "must be \"interpolation\" with [poisson]"));
    }
    if pressure.divergence.is_some() {
        return stray("effects.pressure.divergence");
    }
    if pressure.gradient.is_some() {
        return stray("effects.pressure.gradient");
    }
    if pressure.form() == PressureForm::Collocated {
        second_derivatives(case, "effects.pressure.form = \"collocated\"")?;
    }
    check_pressure(pressure)?;
    check_preconditioner(case, pressure)
}

/// A fit of order 1 has none.
fn second_derivatives(case: &Case, needs: &str) -> Result<(), Fault> {
    if case.method.second_derivatives() {
        return Ok(());
    }
    Err(Fault::reason("method.order", format!("must be 2, 3 or 4 with {needs}, which needs second derivatives")))
}

fn check_pressure(pressure: &Pressure) -> Result<(), Fault> {
    require(
        pressure.tolerance.is_none_or(|tolerance| tolerance > 0.0 && tolerance < 1.0),
        "effects.pressure.tolerance",
    )?;
    require(pressure.max_iterations >= 1, "effects.pressure.max_iterations")?;
    if pressure.form() != PressureForm::Collocated {
        return check_pair(pressure);
    }
    if pressure.divergence.is_some() {
        let reason = "belongs to the conservative form, and effects.pressure.form is \"collocated\", \
                      which takes the divergence of the fit; leave it out";
        return Err(Fault::reason("effects.pressure.divergence", reason));
    }
    if pressure.solver == Some(Solver::ConjugateGradient) {
        let reason = "the collocated matrix (effects.pressure.form) is not symmetric: \
                      conjugate gradients do not apply; use bicgstab";
        return Err(Fault::reason("effects.pressure.solver", reason));
    }
    if pressure.gradient.is_some() {
        let reason = "belongs to the conservative form, and effects.pressure.form is \"collocated\", \
                      which takes the gradient of the fit; leave it out";
        return Err(Fault::reason("effects.pressure.gradient", reason));
    }
    Ok(())
}

/// Points that move have a coarse pressure with either solver, those that stand with conjugate gradients.
fn check_preconditioner(case: &Case, pressure: &Pressure) -> Result<(), Fault> {
    let reason = match (pressure.preconditioner, pressure.solver()) {
        (Some(_), Solver::Direct) => {
            "belongs to an iterative solver, and effects.pressure.solver is \"direct\"; leave it out"
        }
        (Some(Preconditioner::Multigrid), Solver::Bicgstab) if !case.moves() => {
            "must be \"jacobi\" with effects.pressure.solver = \"bicgstab\" on points that stand still"
        }
        _ => return Ok(()),
    };
    Err(Fault::reason("effects.pressure.preconditioner", reason))
}

/// The adjoint gradient is that of the plain flux, and those of MPS are its own.
fn check_pair(pressure: &Pressure) -> Result<(), Fault> {
    if pressure.form() == PressureForm::Conservative
        && matches!(pressure.gradient(), Gradient::Least | Gradient::Corrected)
    {
        let reason = "belongs to the form \"integral\", of points that move, and effects.pressure.form is \"conservative\": \
                      allowed: \"fit\" or \"adjoint\"";
        return Err(Fault::reason("effects.pressure.gradient", reason));
    }
    if (pressure.divergence(), pressure.gradient()) == (Divergence::Fit, Gradient::Adjoint) {
        let reason = "has no adjoint gradient: with effects.pressure.gradient = \"adjoint\" it must be \"faces\"";
        return Err(Fault::reason("effects.pressure.divergence", reason));
    }
    Ok(())
}

fn check_remap(case: &Case) -> Result<(), Fault> {
    let forward = case.effects.advection.as_ref().is_some_and(|advection| advection.remap == Remap::Forward);
    if forward && case.courant() > LONGEST_FORWARD {
        let reason = "must be at most 1 with effects.advection.remap = \"forward\", whose errors grow beyond; \
                      use \"departure\" for longer steps";
        return Err(Fault::reason("time.courant", reason));
    }
    Ok(())
}
