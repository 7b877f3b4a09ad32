//! Checks of points that move: what they need, what they leave no room for, and what belongs to them alone.

use super::super::fault::Fault;
use super::super::{
    Arrangement, Axes, Boundaries, Case, Fill, Gradient, Motion, Operators, Pressure, PressureForm, Problem, Remap,
    SideKind, Solver,
};
use super::require;

/// Largest displacement in a step, in spacings: beyond, points run into each other before a pressure parts them.
const LONGEST_STEP: f64 = 0.5;
/// Fewest spacings along a side of the fill, as of a domain.
const FEWEST_CELLS: f64 = 4.0;
/// Part of a spacing by which a side may miss a number of them: room for decimals like 0.3333333.
const WHOLE_WITHIN: f64 = 1e-6;
/// Highest wave over the depth below it: the columns of points are stretched by as much.
const HIGHEST_WAVE: f64 = 0.5;

pub(super) fn check(case: &Case) -> Result<(), Fault> {
    if !case.moves() {
        return check_standing(case);
    }
    check_flow(case)?;
    check_method(case)?;
    let pressure = case.effects.pressure.as_ref().ok_or_else(|| lacks("effects.pressure"))?;
    check_pressure(case, pressure)?;
    let fill = case.cloud.fill.as_ref().ok_or_else(|| lacks("cloud.fill"))?;
    check_fill(case, fill)?;
    check_output(case)
}

fn lacks(key: &str) -> Fault {
    Fault::reason("effects.advection.motion", format!("needs the table {key}, which is absent"))
}

/// On points that stand nothing of this has a meaning.
fn check_standing(case: &Case) -> Result<(), Fault> {
    let pressure = case.effects.pressure.as_ref();
    if case.cloud.fill.is_some() {
        let reason = "has a free surface, which fixed points cannot follow: it needs effects.advection.motion = \"lagrangian\" \
                      or \"shifted\"";
        return Err(Fault::reason("cloud.fill", reason));
    }
    let given = [
        ("initial.rotation", case.initial.rotation != 0.0),
        ("effects.pressure.relaxation", pressure.is_some_and(|pressure| pressure.relaxation.is_some())),
        ("effects.pressure.form", pressure.is_some_and(|pressure| pressure.form() == PressureForm::Integral)),
        ("output.frame_every", case.output.frame_every.is_some()),
        ("output.sensors", !case.output.sensors.is_empty()),
    ];
    match given.iter().find(|(_, given)| *given) {
        Some((key, _)) => {
            Err(Fault::reason(key, "belongs to points that move, and effects.advection.motion is \"fixed\""))
        }
        None => Ok(()),
    }
}

fn check_flow(case: &Case) -> Result<(), Fault> {
    if case.problem() != Problem::Flow {
        return Err(Fault::reason("effects.advection.motion", "belongs to a flow in time; leave it out"));
    }
    let motion = "points that move (effects.advection.motion)";
    let stray = |key: &str, reason: &str| Err(Fault::reason(key, format!("{reason} with {motion}")));
    if case.exact.is_some() {
        return stray("exact", "must be left out");
    }
    if case.domain.periodic != Axes::None {
        return stray("domain.periodic", "must be \"none\"");
    }
    let walls = &case.boundaries;
    let sides = [("left", &walls.left), ("right", &walls.right), ("bottom", &walls.bottom), ("top", &walls.top)];
    if let Some((side, _)) = sides.iter().find(|(_, wall)| wall.kind != SideKind::Wall) {
        return stray(&format!("boundaries.{side}.kind"), "must be \"wall\", along which fluid slips,");
    }
    if let Some((side, _)) = sides.iter().find(|(_, wall)| **wall != Boundaries::default().left) {
        return stray(&format!("boundaries.{side}.velocity"), "must be [0, 0]");
    }
    if case.effects.advection.as_ref().is_some_and(|advection| advection.remap == Remap::Forward) {
        return stray("effects.advection.remap", "must be left out: nothing is carried back");
    }
    if case.time.step.is_none() && case.courant() > LONGEST_STEP {
        return stray("time.courant", &format!("must be at most {LONGEST_STEP}"));
    }
    Ok(())
}

fn check_method(case: &Case) -> Result<(), Fault> {
    let method = &case.method;
    if method.order != 2 {
        return Err(Fault::reason("method.order", "must be 2 with points that move (effects.advection.motion)"));
    }
    if case.motion() == Motion::Shifted && method.operators == Operators::Integral {
        let reason = "moves points by fits: it needs method.operators = \"interpolation\"";
        return Err(Fault::reason("effects.advection.motion", reason));
    }
    if case.cloud.arrangement == Arrangement::Random {
        let reason = "must be \"regular\" or \"jittered\" with points that move (effects.advection.motion)";
        return Err(Fault::reason("cloud.arrangement", reason));
    }
    // A point sees one wall across an axis.
    let least = 2.0 * method.radius() * case.cloud.spacing;
    for (key, length) in [("domain.width", case.domain.width), ("domain.height", case.domain.height)] {
        if length <= least {
            let reason = format!(
                "must be above {least}, twice method.radius in spacings, with points that move: \
                 else a point would meet two walls across; take a smaller cloud.spacing"
            );
            return Err(Fault::reason(key, reason));
        }
    }
    Ok(())
}

fn check_pressure(case: &Case, pressure: &Pressure) -> Result<(), Fault> {
    let (form, word, operators) = match case.method.operators {
        Operators::Interpolation => (PressureForm::Collocated, "collocated", "interpolation"),
        Operators::Integral => (PressureForm::Integral, "integral", "integral"),
    };
    if pressure.form() != form {
        let reason = format!("must be {word:?} with points that move and method.operators = {operators:?}");
        return Err(Fault::reason("effects.pressure.form", reason));
    }
    let gradient = matches!(pressure.gradient, Some(Gradient::Fit | Gradient::Adjoint));
    for (key, given) in [("divergence", pressure.divergence.is_some()), ("gradient", gradient)] {
        if given {
            let reason = "belongs to the conservative form, which points that move have not; leave it out";
            return Err(Fault::reason(&format!("effects.pressure.{key}"), reason));
        }
    }
    if form == PressureForm::Collocated && pressure.gradient.is_some() {
        let reason = "belongs to method.operators = \"integral\", and fits have a gradient of their own; leave it out";
        return Err(Fault::reason("effects.pressure.gradient", reason));
    }
    if form == PressureForm::Collocated && pressure.solver == Some(Solver::ConjugateGradient) {
        let reason = "the collocated matrix (effects.pressure.form) is not symmetric: \
                      conjugate gradients do not apply; use bicgstab";
        return Err(Fault::reason("effects.pressure.solver", reason));
    }
    require(pressure.relaxation.is_none_or(|share| (0.0..=1.0).contains(&share)), "effects.pressure.relaxation")
}

fn check_fill(case: &Case, fill: &Fill) -> Result<(), Fault> {
    let size = [case.domain.width, case.domain.height];
    let room = WHOLE_WITHIN * case.cloud.spacing;
    let within = |corner: [f64; 2]| (0..2).all(|axis| corner[axis] >= -room && corner[axis] <= size[axis] + room);
    require(within(fill.from), "cloud.fill.from")?;
    require(within(fill.to), "cloud.fill.to")?;
    let side = [0, 1].map(|axis| fill.to[axis] - fill.from[axis]);
    if side.iter().any(|side| side / case.cloud.spacing < FEWEST_CELLS - WHOLE_WITHIN) {
        let reason =
            format!("must be at least {FEWEST_CELLS} spacings (cloud.spacing) above and right of cloud.fill.from");
        return Err(Fault::reason("cloud.fill.to", reason));
    }
    if (0..2).all(|axis| side[axis] >= size[axis] - room) {
        let reason = "fills the whole domain: a free surface needs room above or beside it";
        return Err(Fault::reason("cloud.fill.to", reason));
    }
    let Some(wave) = &fill.wave else { return Ok(()) };
    require(wave.amplitude > 0.0, "cloud.fill.wave.amplitude")?;
    require(wave.half_waves >= 1, "cloud.fill.wave.half_waves")?;
    let highest = (HIGHEST_WAVE * side[1]).min(size[1] - fill.to[1]);
    if wave.amplitude > highest {
        let reason = format!("must be at most {highest}: half of the depth, and no higher than the domain has room");
        return Err(Fault::reason("cloud.fill.wave.amplitude", reason));
    }
    Ok(())
}

fn check_output(case: &Case) -> Result<(), Fault> {
    require(case.output.frame_every.is_none_or(|every| every > 0.0), "output.frame_every")?;
    for (name, sensor) in &case.output.sensors {
        let [x, y] = sensor.at;
        let inside = (0.0..=case.domain.width).contains(&x) && (0.0..=case.domain.height).contains(&y);
        let path = ["output", "sensors", name, "at"].map(str::to_owned);
        if !inside {
            return Err(Fault { path: path.to_vec(), problem: super::super::fault::Problem::Range });
        }
    }
    Ok(())
}
