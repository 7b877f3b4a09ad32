//! Heat and tracers beside obstacles and on points whose spacing varies.

use glam::DVec2;
use stillpoint::case::{Case, Circle, Component, Exact as ExactKey, Obstacle, Refine, Solution};
use stillpoint::cloud::Cloud;
use stillpoint::cloud::voronoi::Cells;
use stillpoint::cpu;
use stillpoint::exact::Exact;
use stillpoint::measure::FieldError;
use stillpoint::scene::Scene;
use stillpoint::simulation::{Outcome, simulate};

use crate::bench::order;
use crate::cases::cavity_of;

fn run(case: &Case) -> Outcome {
    let scene = Scene::build(case).expect("a scene").into();
    let mut engine = cpu::double(&scene).expect("an engine");
    simulate(&scene, engine.as_mut(), &mut ()).expect("a run")
}

fn ball(centre: [f64; 2], radius: f64) -> Obstacle {
    Obstacle { name: "ball".to_owned(), circle: Some(Circle { centre, radius }), polygon: None, parts: None }
}

fn near_ball(spacing: f64, growth: f64) -> Refine {
    Refine { near: Some("ball".to_owned()), corners: None, spacing, growth }
}

/// A box with sides held at 1 and 0, without flow.
fn warm(n: usize, overrides: &[&str]) -> Case {
    let held = ["boundaries.left.temperature=1.0", "boundaries.right.temperature=0.0"];
    let rest = ["boundaries.top.velocity=[0.0, 0.0]", "effects.heat.diffusivity=1.0", "time.end=1.0"];
    let mut case = cavity_of(n, &[&held[..], &rest, overrides].concat());
    (case.effects.viscosity, case.effects.advection) = (None, None);
    case
}

/// Conductivity of a square array of insulating cylinders, over that between them, `f` their share of the area: Perrins, McKenzie
/// and McPhedran, Proc. R. Soc. Lond. A 369 (1979) 207-225.
fn array(f: f64) -> f64 {
    1.0 - 2.0 * f / (1.0 + f - 0.305827 * f.powi(4) / (1.0 - 1.402958 * f.powi(8)) - 0.013362 * f.powi(8))
}

/// What conducts from the left side to the right past a cylinder in the middle of the box: one of a square array.
#[test]
fn heat_conducts_past_an_insulating_cylinder_as_through_an_array_of_them() {
    let share = 0.2;
    let error = |n: usize, arrangement: &str, finest: Option<f64>| {
        let mut case = warm(n, &[&format!("cloud.arrangement={arrangement}")]);
        case.obstacles = vec![ball([0.5, 0.5], (share / std::f64::consts::PI).sqrt())];
        case.cloud.refine = finest.map(|finest| near_ball(finest / n as f64, 0.1)).into_iter().collect();
        let outcome = run(&case);
        let cloud = Cloud::build(&case).expect("a cloud");
        let (cells, temperature) = (Cells::build(&cloud), outcome.snapshot.carried("temperature"));
        let left = (0..cloud.len()).filter(|&point| cloud.position[point].x == 0.0);
        let flow: f64 = left
            .flat_map(|point| cells.faces(point).map(move |(other, weight)| (point, other, weight)))
            .map(|(point, other, weight)| weight * (temperature[point] - temperature[other]))
            .sum();
        assert!(temperature.iter().all(|value| (0.0..=1.0).contains(value)), "{arrangement}");
        ((cloud.len() as f64).sqrt() as usize, (flow / array(share) - 1.0).abs())
    };
    for (arrangement, finest) in [("regular", None), ("jittered", None), ("relaxed", None), ("relaxed", Some(0.5))] {
        let (coarse, fine) = (error(12, arrangement, finest), error(36, arrangement, finest));
        let found = order(coarse, fine);
        assert!(found > 1.6 && fine.1 < 2e-3, "{arrangement}, {finest:?}: order {found}, {coarse:?} {fine:?}");
    }
}

/// Start-up of conduction between two sides, on points four times closer at one of them.
#[test]
fn conduction_on_graded_points_is_of_second_order() {
    let error = |n: usize| {
        let mut case = warm(n, &["cloud.arrangement=relaxed", "effects.heat.diffusivity=0.05"]);
        case.effects.pressure = Some(stillpoint::case::Pressure::default());
        let spacing = 0.25 / n as f64;
        case.cloud.refine = vec![Refine { near: Some("left".to_owned()), corners: None, spacing, growth: 0.15 }];
        let outcome = run(&case);
        case.exact = Some(ExactKey { solution: Solution::Conduction });
        let exact = Exact::of(&case).expect("an exact solution");
        let FieldError { difference, exact } = FieldError::new(&outcome.snapshot, &exact, Component::Temperature);
        ((outcome.snapshot.position.len() as f64).sqrt() as usize, difference / exact)
    };
    let (coarse, fine) = (error(10), error(30));
    let found = order(coarse, fine);
    assert!(found > 1.7 && fine.1 < 2e-3, "order {found}, {coarse:?} {fine:?}");
}

/// A tracer that comes to a cylinder in a channel and goes past it.
fn passing(diffusivity: f64, refined: bool) -> Case {
    let tracer = format!(
        "effects.tracers=[{{ name = 'ink', diffusivity = {diffusivity:?}, shape = 'gaussian', centre = [0.4, 0.55], \
         radius = 0.12 }}]"
    );
    let mut case = cavity_of(
        30,
        &[
            "domain.width=2.0",
            "cloud.arrangement=relaxed",
            "boundaries.top.velocity=[0.0, 0.0]",
            "boundaries.left={ kind = 'inlet', velocity = [1.0, 0.0], profile = 'parabola' }",
            "boundaries.right={ kind = 'outlet' }",
            "effects.viscosity.kinematic=0.02",
            "time.end=1.0",
            &tracer,
        ],
    );
    case.obstacles = vec![ball([0.8, 0.5], 0.15)];
    case.cloud.refine = if refined { vec![near_ball(1.0 / 60.0, 0.1)] } else { vec![] };
    case
}

/// Between the cylinder, whose skin it never reaches, and the fluid that presses on it a tracer that does not diffuse is a layer thinner
/// than a spacing, where fits go below 0: its amount is kept, its bounds are not. With a quarter of the viscosity both are.
#[test]
fn a_tracer_past_an_obstacle_keeps_its_amount_and_if_it_diffuses_its_bounds() {
    for (diffusivity, refined) in [(0.0, false), (0.0, true), (0.005, false), (0.005, true)] {
        let case = passing(diffusivity, refined);
        let outcome = run(&case);
        let cloud = Cloud::build(&case).expect("a cloud");
        let volume = Cells::build(&cloud).volume;
        let ink = outcome.snapshot.carried("ink");
        let amount = |value: &dyn Fn(usize) -> f64| (0..cloud.len()).map(|k| volume[k] * value(k)).sum::<f64>();
        let tracer = &case.effects.tracers[0];
        let (before, after) = (amount(&|k| tracer.initially(cloud.position[k])), amount(&|k| ink[k]));
        let middle: DVec2 = (0..cloud.len()).map(|k| volume[k] * ink[k] / after * cloud.position[k]).sum();
        assert!(middle.x > 0.9, "{middle}: it has passed");
        let (low, high) = ink.iter().fold((0.0_f64, 0.0_f64), |(low, high), &ink| (low.min(ink), high.max(ink)));
        let found = (diffusivity, refined, after / before - 1.0, low, high);
        assert!((after / before - 1.0).abs() < 0.06 && (0.1..=1.0).contains(&high), "{found:?}");
        assert!(diffusivity == 0.0 || low > -0.02, "{found:?}");
    }
}
