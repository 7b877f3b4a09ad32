//! Slip sides, inlets and outlets: what is exact, what goes through, and what the absent cost.

use glam::DVec2;
use stillpoint::case::Case;
use stillpoint::cpu;
use stillpoint::scene::Scene;
use stillpoint::simulation::{Outcome, simulate};
use stillpoint::step::{Buffer, Operation};

use crate::cases::{ARRANGEMENTS, FIT, cavity, cavity_of};

const REST: &str = "boundaries.top.velocity=[0.0, 0.0]";
const COLLOCATED: &[&str] = &["effects.pressure.form=collocated", "method.radius=3.1", "method.weight=quadratic"];
const SLIP: [&str; 2] = ["boundaries.top.kind=slip", "boundaries.bottom.kind=slip"];
const CHANNEL: [&str; 5] = [
    REST,
    "boundaries.left={ kind = 'inlet', velocity = [1.0, 0.0], profile = 'parabola' }",
    "boundaries.right={ kind = 'outlet' }",
    "time.end=0.4",
    "time.step=0.02",
];

fn run(case: &Case) -> Outcome {
    let scene = Scene::build(case).expect("a scene").into();
    let mut engine = cpu::double(&scene).expect("an engine");
    let outcome = simulate(&scene, engine.as_mut(), &mut ()).expect("a run");
    assert_eq!(outcome.fallbacks, 0);
    outcome
}

fn farthest(outcome: &Outcome, exact: impl Fn(DVec2) -> DVec2) -> f64 {
    let places = outcome.snapshot.position.iter().zip(&outcome.snapshot.velocity);
    places.map(|(&place, &velocity)| (velocity - exact(place)).length()).fold(0.0, f64::max)
}

/// Along slip sides fluid falls as it does far from any: `u = g t` everywhere, on the sides too, in every form of the pressure.
#[test]
fn fluid_that_slips_falls_freely() {
    let base = [REST, "domain.periodic=x", "effects.gravity.acceleration=[0.5, 0.0]", "time.end=0.5", "time.step=0.02"];
    for (name, arrangement) in ARRANGEMENTS {
        for more in
            [&[][..], &["effects.pressure.gradient=adjoint"], &[FIT], &["time.splitting=projection"], COLLOCATED]
        {
            let with = run(&cavity(&[&base[..], &SLIP, arrangement, more].concat()));
            let off = farthest(&with, |_| DVec2::new(0.25, 0.0));
            assert!(off < 1e-11, "{name}, {more:?}: {off:e}");
        }
        let without = run(&cavity(&[&base[..], arrangement].concat()));
        assert!(farthest(&without, |_| DVec2::new(0.25, 0.0)) > 0.2);
    }
}

#[test]
fn fluid_at_rest_between_slip_sides_stays_at_rest() {
    let heavy = [REST, "effects.gravity.acceleration=[0.3, -9.81]"];
    for ((name, arrangement), form) in ARRANGEMENTS.into_iter().flat_map(|of| [(of, &[][..]), (of, COLLOCATED)]) {
        let case = cavity(&[&heavy, &SLIP[..], arrangement, form].concat());
        let off = farthest(&run(&case), |_| DVec2::ZERO);
        assert!(off < 1e-4, "{name}, {form:?}: {off:e} m/s");
        let direct = ["effects.pressure.solver=direct"];
        let case = cavity(&[&heavy, &SLIP[..], arrangement, form, &direct].concat());
        let off = farthest(&run(&case), |_| DVec2::ZERO);
        assert!(off < 1e-10, "{name}, {form:?}: {off:e} m/s");
    }
}

/// Through a slip side nothing passes, at an outlet the pressure is 0, and at an inlet the velocity is what it is to be.
#[test]
fn every_side_does_what_its_kind_says() {
    for ((name, arrangement), form) in ARRANGEMENTS.into_iter().flat_map(|of| [(of, &[][..]), (of, COLLOCATED)]) {
        let outcome = run(&cavity(&[&CHANNEL[..], &["boundaries.top.kind=slip"], arrangement, form].concat()));
        let mut largest = 0.0_f64;
        for (k, place) in outcome.snapshot.position.iter().enumerate() {
            let (velocity, pressure) = (outcome.snapshot.velocity[k], outcome.snapshot.pressure[k]);
            largest = largest.max(pressure.abs());
            if place.x == 1.0 {
                assert_eq!(pressure, 0.0, "{name}, {place}");
            }
            if place.y == 1.0 && place.x > 0.0 {
                assert!(velocity.y == 0.0, "{name}, {place}: {velocity}");
            }
            if place.x == 0.0 {
                let exact = DVec2::new(4.0 * place.y * (1.0 - place.y), 0.0);
                assert!((velocity - exact).length() < 1e-14, "{name}, {place}: {velocity}");
            }
        }
        assert!(largest > 0.01, "{name}");
    }
}

#[test]
fn the_way_the_pressure_of_an_outlet_is_solved_for_leaves_the_answer() {
    let with = |form: &[&str], solver: &str| {
        let solver = format!("effects.pressure.solver={solver}");
        let tight = ["effects.pressure.tolerance=1e-10", "cloud.arrangement=jittered", solver.as_str()];
        run(&cavity(&[&CHANNEL[..], &tight, form].concat()))
    };
    for (form, solver) in [(&[][..], "conjugate_gradient"), (&[], "bicgstab"), (COLLOCATED, "bicgstab")] {
        let (base, other) = (with(form, "direct"), with(form, solver));
        let differences = base.snapshot.velocity.iter().zip(&other.snapshot.velocity).map(|(a, b)| (*a - *b).length());
        let off = differences.fold(0.0, f64::max);
        assert!(off < 1e-6, "{solver}: {off:e}");
        let pressures = base.snapshot.pressure.iter().zip(&other.snapshot.pressure).map(|(a, b)| (a - b).abs());
        let off = pressures.fold(0.0, f64::max);
        assert!(off < 1e-5, "{solver}: {off:e} Pa");
    }
}

#[test]
fn every_option_of_a_side_changes_the_answer() {
    let changes = [
        "boundaries.left.profile=uniform",
        "boundaries.left.velocity=[1.1, 0.0]",
        "boundaries.top.kind=slip",
        "boundaries.top.kind=outlet",
        "boundaries.top.velocity=[0.5, 0.0]",
    ];
    for (form, changed) in changes.into_iter().flat_map(|changed| [(&[][..], changed), (COLLOCATED, changed)]) {
        let [base, other] = [&[][..], &[changed]].map(|more| run(&cavity(&[&CHANNEL[..], form, more].concat())));
        let differences = base.snapshot.velocity.iter().zip(&other.snapshot.velocity).map(|(a, b)| (*a - *b).length());
        assert!(differences.fold(0.0, f64::max) > 1e-3, "{changed}, {form:?}");
    }
}

#[test]
fn absent_kinds_of_sides_have_no_operation_and_no_array() {
    let plan = |overrides: &[&str]| Scene::build(&cavity(overrides)).expect("a scene").plan;
    let count = |overrides: &[&str]| {
        let plan = plan(overrides);
        let of_sides = |operation: &Operation| matches!(operation, Operation::OpenSides(_) | Operation::HoldOutlets);
        let its = plan.operations().filter(of_sides).count();
        let rows = [Buffer::OpenPoints, Buffer::OpenRow, Buffer::OpenCount, Buffer::OpenNormal, Buffer::WallFlux];
        let rows = [&rows[..], &[Buffer::Outlet]].concat();
        (its, plan.buffers().iter().filter(|buffer| rows.contains(buffer)).count())
    };
    assert_eq!([count(&[]), count(&[REST, SLIP[0]]), count(&CHANNEL)], [(0, 0), (4, 4), (4, 5)]);
    let collocated = |overrides: &[&str]| count(&[overrides, COLLOCATED].concat());
    assert_eq!([collocated(&[]), collocated(&[REST, SLIP[0]]), collocated(&CHANNEL)], [(0, 0), (4, 4), (5, 5)]);
}

/// Two slip sides meet where nothing passes either.
#[test]
fn fluid_stands_still_in_the_corner_of_two_slip_sides() {
    let slip = ["boundaries.left.kind=slip", "boundaries.bottom.kind=slip", "time.end=0.3"];
    for form in [&[][..], COLLOCATED] {
        let outcome = run(&cavity(&[&slip[..], form].concat()));
        let places = outcome.snapshot.position.iter().zip(&outcome.snapshot.velocity);
        let beside = |place: DVec2| place.length() < 0.08;
        let moving = places.clone().filter(|(place, _)| beside(**place)).map(|(_, u)| u.length()).fold(0.0, f64::max);
        assert!(moving > 1e-4, "{form:?}: {moving}");
        let corner = places.filter(|(place, _)| **place == DVec2::ZERO).map(|(_, u)| *u).next();
        assert_eq!(corner, Some(DVec2::ZERO), "{form:?}");
    }
}

/// Poiseuille's flow comes in and leaves as it came: fits of a collocated pressure hold it to rounding on any points, the
/// conservative form to an order of 1.5 on lattices, more between finer ones. Uniform fluid between slip sides goes through as it is.
#[test]
fn a_parabola_goes_through_a_channel() {
    let steady = ["effects.viscosity.kinematic=1.0", "effects.pressure.solver=direct", "time.end=2.0"];
    let parabola = |place: DVec2| DVec2::new(4.0 * place.y * (1.0 - place.y), 0.0);
    let at = |n: usize, more: &[&str]| run(&cavity_of(n, &[&CHANNEL[..3], &steady, more].concat()));
    for (name, arrangement) in ARRANGEMENTS {
        let off = farthest(&at(10, &[arrangement, COLLOCATED].concat()), parabola);
        assert!(off < 1e-7, "{name}: {off:e}");
    }
    let [coarse, fine] = [10, 20].map(|n| {
        let snapshot = at(n, &[]).snapshot;
        let places = snapshot.position.iter().zip(&snapshot.velocity);
        let squares = places.map(|(&place, &velocity)| (velocity - parabola(place)).length_squared());
        (squares.sum::<f64>() / snapshot.position.len() as f64).sqrt()
    });
    assert!((coarse / fine).log2() > 1.4 && fine < 3e-3, "{coarse:e}, {fine:e}");
    for form in [&[][..], COLLOCATED] {
        let plug = ["boundaries.left.profile=uniform", SLIP[0], SLIP[1]];
        let case = cavity_of(10, &[&CHANNEL[..3], &steady, form, &plug].concat());
        let off = farthest(&run(&case), |_| DVec2::X);
        assert!(off < 1e-7, "{form:?}: {off:e}");
    }
}
