//! Whole runs against flows that are known: orders of convergence, and what long and short steps do to the error.

use std::sync::Arc;

use stillpoint::case::{Case, Component};
use stillpoint::cpu;
use stillpoint::exact::Exact;
use stillpoint::measure::FieldError;
use stillpoint::scene::Scene;
use stillpoint::simulation::{Stop, simulate};

use crate::bench::order;
use crate::cases::{ARRANGEMENTS, FIT, vortices, wake};

/// Relative errors of velocity and pressure at the end of a run.
fn errors(case: &Case) -> [f64; 2] {
    let scene = Arc::new(Scene::build(case).expect("a scene"));
    let mut engine = cpu::double(&scene).expect("an engine");
    let outcome = simulate(&scene, engine.as_mut(), &mut ()).expect("a run");
    assert!(matches!(outcome.stop, Stop::End | Stop::Steady), "{:?}", outcome.stop);
    assert_eq!((outcome.fallbacks, &outcome.warnings[..]), (0, &[][..]));
    let exact = Exact::of(case).expect("an exact flow");
    [Component::Velocity, Component::P].map(|component| {
        let FieldError { difference, exact } = FieldError::new(&outcome.snapshot, &exact, component);
        difference / exact
    })
}

/// Short steps and a tight tolerance: what is left is of the spacing alone.
const FINE: [&str; 3] = ["time.courant=0.1", "effects.pressure.tolerance=1e-8", FIT];

#[test]
fn vortices_decay_as_they_should_at_order_two_on_every_arrangement() {
    for (name, arrangement) in ARRANGEMENTS {
        // With jitter 0.45 and 2.6 spacings some fits are weak.
        let radius: &[&str] = if name == "regular" { &[] } else { &["method.radius=2.8"] };
        let of = |n: usize| errors(&vortices(n, &[arrangement, radius, &FINE].concat()));
        let (coarse, fine) = (of(32), of(64));
        let [velocity, pressure] = [0, 1].map(|k| order((32, coarse[k]), (64, fine[k])));
        assert!(velocity > 1.75 && fine[0] < 1.5e-3, "{name}: order {velocity}, {coarse:?} to {fine:?}");
        assert!(pressure > 1.75 && fine[1] < 1e-2, "{name}: order {pressure}, {coarse:?} to {fine:?}");
    }
}

#[test]
fn a_steady_flow_through_a_box_is_met_at_order_two() {
    for (name, arrangement) in ARRANGEMENTS {
        let of = |n: usize| errors(&wake(n, &[arrangement, &[FIT][..]].concat()));
        let (coarse, fine) = (of(16), of(32));
        let velocity = order((16, coarse[0]), (32, fine[0]));
        assert!(velocity > 1.75 && fine[0] < 2.5e-3, "{name}: order {velocity}, {coarse:?} to {fine:?}");
        // Along walls the pressure is of first order.
        assert!(coarse[1] / fine[1] > 1.8 && fine[1] < 2e-2, "{name}: {coarse:?} to {fine:?}");
    }
}

#[test]
fn on_scattered_points_fitted_faces_are_what_makes_the_order_two() {
    for (name, arrangement) in &ARRANGEMENTS[1..] {
        let radius = ["method.radius=2.8"];
        let with = |divergence: &str| errors(&vortices(48, &[arrangement, &radius[..], &[divergence]].concat()))[0];
        let [plain, fitted] = ["effects.pressure.divergence=faces", FIT].map(with);
        assert!(plain > 4.0 * fitted, "{name}: {plain} with plain faces, {fitted} with fitted ones");
    }
}

#[test]
fn a_viscosity_a_tenth_too_large_misses_the_vortices() {
    let case = vortices(32, &FINE);
    let right = errors(&case)[0];
    let mut thick = case.clone();
    thick.effects.viscosity.as_mut().expect("a viscosity").kinematic *= 1.1;
    let scene = Arc::new(Scene::build(&thick).expect("a scene"));
    let outcome = simulate(&scene, cpu::double(&scene).expect("an engine").as_mut(), &mut ()).expect("a run");
    let exact = Exact::of(&case).expect("an exact flow");
    let FieldError { difference, exact } = FieldError::new(&outcome.snapshot, &exact, Component::Velocity);
    assert!(difference / exact > 5.0 * right, "{} against {right}", difference / exact);
}

#[test]
fn both_pressure_forms_and_both_remaps_follow_the_vortices() {
    for (changes, most) in [
        (&["effects.advection.remap=forward", FIT][..], 0.02),
        (&["effects.pressure.form=collocated", "method.radius=3.1", "method.weight=quadratic"], 0.02),
        (&["effects.pressure.gradient=adjoint"], 0.06),
    ] {
        let [velocity, _] = errors(&vortices(32, &[&["cloud.arrangement=jittered"], changes].concat()));
        assert!(velocity < most, "{changes:?}: {velocity}");
    }
}

/// As the vortices decay, steps get twice as long and more. Reports tell when: the same flow at the same time, whether every step
/// is of its own length or all are of one. Half a step of forces too many or too few would be 1.5% of it.
#[test]
fn what_is_reported_is_of_its_time_while_steps_get_longer() {
    let with = |every: &str| {
        let thick = ["effects.viscosity.kinematic=0.05", "time.end=0.4", "time.courant=0.2"];
        errors(&vortices(32, &[&thick[..], &["effects.pressure.tolerance=1e-8", every]].concat()))[0]
    };
    let [changing, constant] = ["output.report_every=1", "output.report_every=1000"].map(with);
    assert!((changing - constant).abs() < 2e-3, "{changing} with steps of many lengths, {constant} of one");
}

/// The noise of plain faces is made anew in every step and smoothed away by every remap, at the flow's cost.
#[test]
fn with_plain_faces_on_scattered_points_the_error_grows_as_steps_get_shorter() {
    for remap in ["effects.advection.remap=departure", "effects.advection.remap=forward"] {
        let at =
            |courant: &str| errors(&vortices(32, &["cloud.arrangement=jittered", "time.end=0.25", remap, courant]))[0];
        let [long, short] = ["time.courant=0.8", "time.courant=0.1"].map(at);
        assert!(short > 2.0 * long, "{remap}: {short} after short steps, {long} after longer ones");
    }
}

/// A fit passes through its own point's value, so that a remap over a short way errs in proportion to the way: errors do not
/// grow as the number of steps does. What grows is a noise of the projection that remaps over shorter ways smooth less.
#[test]
fn much_shorter_steps_make_the_error_larger_and_not_much() {
    let at = |courant: &str| {
        let jittered = ["cloud.arrangement=jittered", "effects.pressure.tolerance=1e-8", "time.end=0.25", FIT];
        errors(&vortices(32, &[&jittered[..], &[courant]].concat()))[0]
    };
    let [short, shorter] = ["time.courant=0.04", "time.courant=0.01"].map(at);
    assert!(shorter > 1.2 * short && shorter < 2.5 * short, "{shorter} after still shorter steps than {short}");
}
