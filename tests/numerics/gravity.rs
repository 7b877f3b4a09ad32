//! Gravity: what it does exactly, and what it leaves alone.

use glam::DVec2;
use stillpoint::case::Case;
use stillpoint::cpu;
use stillpoint::scene::Scene;
use stillpoint::simulation::{Outcome, simulate};
use stillpoint::step::Operation;

use crate::bench::{largest_difference, without_mean};
use crate::cases::{ARRANGEMENTS, FIT, cavity};

const G: DVec2 = DVec2::new(0.3, -9.81);
const GIVEN: [&str; 4] = [
    "effects.gravity.acceleration=[0.3, -9.81]",
    "boundaries.top.velocity=[0.0, 0.0]",
    "fluid.density=1000.0",
    "effects.pressure.solver=direct",
];

fn run(case: &Case) -> Outcome {
    let scene = Scene::build(case).expect("a scene").into();
    let mut engine = cpu::double(&scene).expect("an engine");
    simulate(&scene, engine.as_mut(), &mut ()).expect("a run")
}

/// In a closed box the pressure balances it: no flow, `p = rho g . x`, to rounding, on any points, in every form.
#[test]
fn fluid_at_rest_stays_at_rest_under_a_pressure_linear_in_place() {
    for (name, arrangement) in ARRANGEMENTS {
        for form in [
            &[][..],
            &["effects.pressure.gradient=adjoint"],
            &[FIT],
            &["effects.pressure.form=collocated"],
            &["time.splitting=projection"],
        ] {
            let outcome = run(&cavity(&[&GIVEN, arrangement, form].concat()));
            let (speed, reached) =
                (outcome.snapshot.velocity.iter().map(|u| u.length()).fold(0.0, f64::max), G.length());
            if form == ["effects.pressure.gradient=adjoint"] && name != "regular" {
                // Minus the adjoint of the divergence is not exact for linear fields on scattered points.
                assert!(speed > 1e-6, "{name}, {form:?}: {speed}");
                continue;
            }
            assert!(speed < 1e-11 * reached, "{name}, {form:?}: {speed} m/s after 1 s");
            let exact: Vec<f64> = outcome.snapshot.position.iter().map(|place| 1000.0 * G.dot(*place)).collect();
            let off = largest_difference(&outcome.snapshot.pressure, &without_mean(&exact));
            assert!(off < 1e-9 * 1000.0 * reached, "{name}, {form:?}: {off} Pa");
        }
    }
}

/// Without a pressure it falls: `u = g t` inside, at rest on the walls.
#[test]
fn without_a_pressure_fluid_falls() {
    let mut case = cavity(&GIVEN[..3]);
    (case.effects.pressure, case.effects.viscosity, case.effects.advection) = (None, None, None);
    (case.time.end, case.time.step) = (0.5, Some(0.1));
    let scene = Scene::build(&case).expect("a scene");
    let outcome = run(&case);
    let (inside, walls) = outcome.snapshot.velocity.split_at(scene.sizes.interior);
    assert!(inside.iter().all(|u| (*u - 0.5 * G).length() < 1e-12), "{:?}", inside[0]);
    assert!(walls.iter().all(|u| *u == DVec2::ZERO));
}

/// Steps are as short as a fall from rest over the courant number's spacings asks for, with advection alone.
#[test]
fn a_fall_bounds_the_step() {
    let mut case = cavity(&GIVEN[..3]);
    case.time.end = 0.5;
    let fall = (2.0 * 0.8 * 0.05 / G.length()).sqrt();
    assert_eq!(run(&case).steps, (0.5 / fall).ceil() as u64);
    (case.effects.advection, case.effects.viscosity) = (None, None);
    assert_eq!(run(&case).steps, 1);
}

#[test]
fn a_scene_without_it_has_none_of_its_operations() {
    let (with, without) =
        (Scene::build(&cavity(&GIVEN[..3])).expect("a scene"), Scene::build(&cavity(&[])).expect("a scene"));
    let its = |scene: &Scene| {
        scene.plan.operations().filter(|o| matches!(o, Operation::Gravity | Operation::HoldWalls)).count()
    };
    assert_eq!((its(&with), its(&without)), (4, 0));
    assert_eq!(with.plan.buffers(), without.plan.buffers());
}
