//! Heat and tracers: what is conserved, what is exact, the orders of convergence, and what an absent one costs.

use stillpoint::case::{Case, Component, Scheme};
use stillpoint::cpu;
use stillpoint::exact::Exact;
use stillpoint::measure::FieldError;
use stillpoint::scene::Scene;
use stillpoint::simulation::{Outcome, prices, simulate};
use stillpoint::step::{Buffer, Carried, Effect, Operation, Stage};

use crate::bench::{Bench, order};
use crate::cases::{ARRANGEMENTS, cavity, cavity_of, turning};

const HEAT: &str = "effects.heat={ diffusivity = 0.05, initial = 0.3 }";
const TEMPERATURE: Buffer = Buffer::Carried(Carried::Temperature);

fn run(case: &Case) -> Outcome {
    let scene = Scene::build(case).expect("a scene").into();
    let mut engine = cpu::double(&scene).expect("an engine");
    simulate(&scene, engine.as_mut(), &mut ()).expect("a run")
}

/// Heat alone: no velocity effect.
fn still(overrides: &[&str]) -> Case {
    let mut case = cavity(&[&[HEAT, "boundaries.top.velocity=[0.0, 0.0]"], overrides].concat());
    (case.effects.viscosity, case.effects.pressure, case.effects.advection) = (None, None, None);
    case
}

fn amount(bench: &mut Bench) -> f64 {
    bench.scalars(TEMPERATURE).iter().zip(bench.scalars(Buffer::Volume)).map(|(t, volume)| t * volume).sum()
}

#[test]
fn between_insulated_walls_diffusion_conserves_and_evens_out() {
    for (name, arrangement) in ARRANGEMENTS {
        let mut bench = Bench::new(&still(arrangement));
        let values = bench.sample(|x| (3.0 * x.x).sin() + x.y * x.y);
        bench.write_scalars(TEMPERATURE, &values);
        bench.clock.dt = bench.scene.constants.diffusion_limit;
        let (before, span) = (amount(&mut bench), |values: &[f64]| {
            values.iter().copied().fold(f64::MIN, f64::max) - values.iter().copied().fold(f64::MAX, f64::min)
        });
        for _ in 0..50 {
            bench.apply(&[Stage::Start, Stage::Middle].map(|stage| Operation::Diffuse(Carried::Temperature, stage)));
        }
        let after = bench.scalars(TEMPERATURE);
        assert!((amount(&mut bench) - before).abs() < 1e-13 * before.abs(), "{name}");
        assert!(span(&after) < 0.9 * span(&values), "{name}: {} of {}", span(&after), span(&values));
    }
}

#[test]
fn a_heat_flux_brings_what_it_says_and_a_held_side_keeps_its_temperature() {
    for (name, arrangement) in ARRANGEMENTS {
        let mut case =
            still(&[arrangement, &["boundaries.left.heat_flux=0.2", "boundaries.top.heat_flux=-0.05"]].concat());
        case.time.end = 0.5;
        let (outcome, mut bench) = (run(&case), Bench::new(&case));
        bench.write_scalars(TEMPERATURE, outcome.snapshot.carried("temperature"));
        assert!((amount(&mut bench) - 0.3 - 0.5 * 0.15).abs() < 1e-12, "{name}");
        let mut case = still(&[arrangement, &["boundaries.left.temperature=2.0"]].concat());
        case.time.end = 0.5;
        let outcome = run(&case);
        let temperature = outcome.snapshot.carried("temperature");
        for (place, temperature) in outcome.snapshot.position.iter().zip(temperature) {
            assert!((0.3 - 1e-12..2.0 + 1e-12).contains(temperature), "{name}, {place}: {temperature}");
            assert!(place.x > 0.0 || *temperature == 2.0, "{name}, {place}: {temperature}");
        }
    }
}

fn exact_error(case: &Case, component: Component) -> f64 {
    let (outcome, exact) = (run(case), Exact::of(case).expect("an exact solution"));
    let FieldError { difference, exact } = match case.effects.tracers.first() {
        Some(tracer) => FieldError::of_tracer(&outcome.snapshot, &exact, tracer),
        None => FieldError::new(&outcome.snapshot, &exact, component),
    };
    difference / exact
}

#[test]
fn conduction_couettes_and_poiseuilles_flow_are_of_second_order() {
    let conduction = |n: usize, arrangement: &[&str]| {
        let text = format!("cloud.spacing={}", 1.0 / n as f64);
        let mut case = still(&[arrangement, &[text.as_str()]].concat());
        for (side, held) in [(&mut case.boundaries.left, 1.0), (&mut case.boundaries.right, 0.0)] {
            side.temperature = Some(held);
        }
        case.exact = Some(stillpoint::case::Exact { solution: stillpoint::case::Solution::Conduction });
        exact_error(&case, Component::Temperature)
    };
    let plates = |n: usize, overrides: &[&str]| {
        let mut case = cavity_of(n, &[&["domain.periodic=x", "time.end=0.5"], overrides].concat());
        (case.effects.pressure, case.effects.advection) = (None, None);
        case.effects.viscosity =
            Some(stillpoint::case::Viscosity { kinematic: 0.1, scheme: Scheme::Explicit, tolerance: None });
        exact_error(&case, Component::Velocity)
    };
    for (name, arrangement) in ARRANGEMENTS {
        let couette = |n| plates(n, &[arrangement, &["exact.solution=couette"]].concat());
        let still = ["boundaries.top.velocity=[0.0, 0.0]", "effects.gravity.acceleration=[0.4, 0.0]"];
        let poiseuille = |n| plates(n, &[arrangement, &still, &["exact.solution=poiseuille"]].concat());
        let heat = |n| conduction(n, arrangement);
        for (flow, error) in
            [("couette", &couette as &dyn Fn(usize) -> f64), ("poiseuille", &poiseuille), ("conduction", &heat)]
        {
            let (coarse, fine) = (error(16), error(32));
            let found = order((16, coarse), (32, fine));
            assert!(found > 1.7 && fine < 3e-3, "{flow}, {name}: order {found}, {coarse:e} {fine:e}");
        }
    }
}

/// One turn at two spacings a step: fits of order 4 lose 8% at 1/40 and 1.5% at 1/64.
#[test]
fn a_gaussian_turns_once_and_is_where_it_was() {
    let error = |n: usize| {
        exact_error(&turning(n, &["cloud.arrangement=jittered", "method.order=4", "time.courant=2"]), Component::Tracer)
    };
    let (coarse, fine) = (error(40), error(80));
    assert!(fine < 0.01 && order((40, coarse), (80, fine)) > 2.5, "{coarse:e} {fine:e}");
}

/// A field that is the same everywhere stays so, whatever the flow, and what is carried leaves the flow alone, to the bit.
#[test]
fn what_is_carried_leaves_the_flow_alone_and_what_is_uniform_stays() {
    let base = ["cloud.arrangement=jittered", "time.end=0.3", "time.step=0.01"];
    let all = "effects.tracers=[{ name = 'all', shape = 'box', centre = [0.5, 0.5], size = [2.0, 2.0] }]";
    let (alone, with) = (run(&cavity(&base)), run(&cavity(&[&base[..], &[all, HEAT]].concat())));
    assert!(alone.snapshot.velocity == with.snapshot.velocity);
    assert!(with.snapshot.carried("all").iter().all(|value| (value - 1.0).abs() < 1e-13));
    assert!(with.snapshot.carried("temperature").iter().all(|value| (value - 0.3).abs() < 1e-13));
}

#[test]
fn warm_fluid_rises() {
    let sides =
        ["boundaries.left.temperature=1.0", "boundaries.right.temperature=0.0", "boundaries.top.velocity=[0.0, 0.0]"];
    // What a solve leaves moves a fluid at rest.
    let weight = ["effects.gravity.acceleration=[0.0, -1.0]", "effects.pressure.tolerance=1e-12", HEAT];
    let lighter = "effects.buoyancy={ expansion = 0.5, reference = 0.5 }";
    let (without, with) =
        (run(&cavity(&[&sides[..], &weight].concat())), run(&cavity(&[&sides[..], &weight, &[lighter]].concat())));
    let fastest = |outcome: &Outcome| outcome.snapshot.velocity.iter().map(|u| u.length()).fold(0.0, f64::max);
    assert!(fastest(&without) < 1e-10 && fastest(&with) > 0.01, "{} {}", fastest(&without), fastest(&with));
    let near = |x: f64| {
        let places = with.snapshot.position.iter().zip(&with.snapshot.velocity);
        places.filter(|(p, _)| (p.x - x).abs() < 0.06 && (p.y - 0.5).abs() < 0.2).map(|(_, u)| u.y).sum::<f64>()
    };
    assert!(near(0.15) > 0.0 && near(0.85) < 0.0);
}

/// A tracer that a prescribed velocity carries pays for nothing else: a step takes at most a third of one with everything on the
/// same points, and the prices of the operations add up to what a step takes.
#[test]
fn a_scene_pays_for_the_effects_it_calls_for() {
    let priced = |case: &Case| {
        let scene = Scene::build(case).expect("a scene").into();
        let mut engine = cpu::double(&scene).expect("an engine");
        let prices = prices(&scene, engine.as_mut()).expect("prices");
        assert!((prices.sum() - prices.step).abs() < 0.15 * prices.step, "{prices:?}");
        assert!((prices.effects().values().sum::<f64>() - prices.sum()).abs() < 1e-9 * prices.step);
        (prices.step, prices.effects().into_keys().collect::<Vec<_>>())
    };
    let tracer = "effects.tracers=[{ name = 'c', shape = 'gaussian', centre = [0.5, 0.75], radius = 0.1 }]";
    let weight = ["effects.gravity.acceleration=[0.0, -1.0]", "effects.buoyancy.expansion=1.0", HEAT, tracer];
    let cloud = ["cloud.arrangement=jittered", "boundaries.left.temperature=1.0", "time.step=0.002"];
    let (all, effects) = priced(&cavity_of(40, &[&weight[..], &cloud].concat()));
    use Effect::{Advection, Buoyancy, Gravity, Heat, Pressure, Step, Tracers, Viscosity};
    assert_eq!(effects, [Advection, Heat, Tracers, Gravity, Buoyancy, Viscosity, Pressure, Step]);
    let (alone, effects) = priced(&turning(40, &["cloud.arrangement=jittered"]));
    assert_eq!(effects, [Tracers]);
    assert!(3.0 * alone < all, "{alone:e} s of {all:e} s");
}

/// Every key of heat, buoyancy and tracers changes the answer.
#[test]
fn every_option_of_what_is_carried_changes_it() {
    let tracer = |diffusivity: f64, shape: &str| {
        format!("effects.tracers=[{{ name = 'c', diffusivity = {diffusivity:?}, {shape} }}]")
    };
    let disc = tracer(0.01, "shape = 'disc', centre = [0.5, 0.6], radius = 0.2");
    let base = [
        "cloud.arrangement=jittered",
        "time.end=0.3",
        "effects.gravity.acceleration=[0.0, -1.0]",
        "effects.heat={ diffusivity = 0.05, initial = 0.3 }",
        "effects.buoyancy={ expansion = 0.5, reference = 0.5 }",
        "boundaries.left.temperature=1.0",
        "boundaries.right.heat_flux=0.1",
        disc.as_str(),
    ];
    let values = |more: &str| {
        let more: &[&str] = if more.is_empty() { &[] } else { &[more] };
        let outcome = run(&cavity(&[&base[..], more].concat()));
        outcome
            .snapshot
            .carried
            .into_iter()
            .flat_map(|(_, values)| values)
            .chain(outcome.snapshot.pressure)
            .collect::<Vec<_>>()
    };
    let before = values("");
    for changed in [
        "effects.heat.diffusivity=0.06",
        "effects.heat.initial=0.4",
        "effects.buoyancy.expansion=0.6",
        "effects.gravity.acceleration=[0.1, -1.0]",
        "effects.buoyancy.reference=0.3",
        "boundaries.left.temperature=1.1",
        "boundaries.right.heat_flux=-0.1",
        &tracer(0.02, "shape = 'disc', centre = [0.5, 0.6], radius = 0.2"),
        &tracer(0.01, "shape = 'gaussian', centre = [0.5, 0.6], radius = 0.2"),
        &tracer(0.01, "shape = 'disc', centre = [0.4, 0.6], radius = 0.2"),
        &tracer(0.01, "shape = 'disc', centre = [0.5, 0.6], radius = 0.3"),
        &tracer(0.01, "shape = 'box', centre = [0.5, 0.6], size = [0.3, 0.2]"),
    ] {
        let after = values(changed);
        assert!(before.iter().zip(&after).any(|(a, b)| (a - b).abs() > 1e-4), "{changed} changes nothing");
    }
}

/// Operations and arrays of heat, of tracers and of buoyancy are those of the scenes that ask for them.
#[test]
fn an_absent_field_has_no_operation_and_no_array() {
    let plan = |case: &Case| Scene::build(case).expect("a scene").plan;
    let carries = |operation: &Operation| {
        use Operation::*;
        matches!(
            operation,
            FindDepartures | CarryVelocity | FitScalar(_) | CarryScalar(_) | Diffuse(..) | HeatWalls(_) | Buoyancy
        )
    };
    let none = plan(&cavity(&["effects.gravity.acceleration=[0.0, -1.0]"]));
    assert!(!none.operations().any(|operation| carries(&operation)));
    let names = none.buffers().into_iter().map(|buffer| buffer.name()).collect::<Vec<_>>();
    for name in ["temperature", "tracer", "departure", "scalar", "heat"] {
        assert!(names.iter().all(|own| !own.starts_with(name)), "{name}");
    }
    let warm = plan(&cavity(&[HEAT]));
    assert!(!warm.operations().any(|o| matches!(o, Operation::Buoyancy | Operation::HeatWalls(_))));
    assert!(!warm.buffers().contains(&Buffer::HeatSupply));
    // Advection of a tracer alone: no diffusion, no cells, no forces, nothing of the pressure.
    let turning = plan(&turning(20, &[]));
    let kick: &[Operation] = &[];
    assert_eq!(turning.kick, kick);
    let own = Carried::Tracer(0);
    // The velocity stays, and so do the departures, while the step is as long.
    assert_eq!(turning.on_step, [Operation::FindDepartures]);
    assert_eq!(turning.drift, [Operation::FitScalar(own), Operation::CarryScalar(own)]);
    for absent in [Buffer::FaceWeight, Buffer::Kick, Buffer::Pressure, Buffer::LaplacianRow, Buffer::Reach(own)] {
        assert!(!turning.buffers().contains(&absent), "{absent:?}");
    }
}
