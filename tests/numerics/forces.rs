//! Forces on obstacles, fluxes and differences: their rules on flows that are known, and what a run reports.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::{DMat2, DVec2};
use stillpoint::case::{Case, Circle, Component, Expectation, Measure, Obstacle};
use stillpoint::cloud::{Cloud, Shape};
use stillpoint::cpu;
use stillpoint::exact::Exact;
use stillpoint::measure::{FieldError, Probe, Sampler};
use stillpoint::scene::Scene;
use stillpoint::simulation::{Stop, simulate};
use stillpoint::snapshot::Snapshot;

use crate::bench::order;
use crate::cases::{FIT, wake};
use crate::rows::Rows;

const CENTRE: DVec2 = DVec2::new(0.6, 0.45);
const RADIUS: f64 = 0.17;
const ARRANGEMENTS: [&str; 3] = ["regular", "jittered", "relaxed"];

/// Kovasznay's flow outside a circle, `n` spacings to a metre.
fn around(n: usize, overrides: &[&str]) -> Case {
    let mut case = wake(n, overrides);
    let circle = Some(Circle { centre: CENTRE.to_array(), radius: RADIUS });
    case.obstacles = vec![Obstacle { name: "ball".to_owned(), circle, polygon: None, parts: None }];
    case
}

/// The exact flow at the points of a cloud.
fn exact_state(case: &Case, cloud: &Cloud) -> Snapshot {
    let exact = Exact::of(case).expect("an exact flow");
    let velocity = cloud.position.iter().map(|&place| exact.velocity(place, 0.0)).collect();
    let pressure = cloud.position.iter().map(|&place| exact.pressure(place, 0.0)).collect();
    Snapshot { position: cloud.position.clone(), velocity, pressure, ..Snapshot::default() }
}

/// The force of the exact flow on the circle, by a fine trapezoid rule, and what it would be if none of it cancelled.
fn exact_force(case: &Case) -> (DVec2, f64) {
    let exact = Exact::of(case).expect("an exact flow");
    let dynamic = case.fluid.density * case.effects.viscosity.as_ref().expect("a viscosity").kinematic;
    let (count, h) = (720, 1e-5);
    let traction = |k: usize| {
        let normal = DVec2::from_angle(TAU * k as f64 / count as f64);
        let place = CENTRE + RADIUS * normal;
        let slope = |d: DVec2| (exact.velocity(place + h * d, 0.0) - exact.velocity(place - h * d, 0.0)) / (2.0 * h);
        // Columns are derivatives along x and along y.
        let gradient = DMat2::from_cols(slope(DVec2::X), slope(DVec2::Y));
        let stress = (gradient + gradient.transpose()) * dynamic;
        stress * normal - exact.pressure(place, 0.0) * normal
    };
    let length = TAU * RADIUS / count as f64;
    ((0..count).map(traction).sum::<DVec2>() * length, (0..count).map(|k| traction(k).length()).sum::<f64>() * length)
}

fn value(probes: &[Probe], name: &str, state: &Snapshot) -> f64 {
    probes.iter().find(|probe| probe.name == name).expect("a probe").value(state)
}

#[test]
fn forces_of_an_exact_flow_are_met_at_order_two_and_more() {
    for arrangement in ARRANGEMENTS {
        let arrangement = format!("cloud.arrangement={arrangement}");
        let error = |n: usize| {
            let case = around(n, &[&arrangement]);
            let cloud = Cloud::build(&case).expect("a cloud");
            let (state, (right, size)) = (exact_state(&case, &cloud), exact_force(&case));
            let probes = Probe::of_case(&case, &cloud.position).expect("probes");
            let found = ["force_x_ball", "force_y_ball"].map(|name| value(&probes, name, &state));
            (DVec2::from_array(found) - right).length() / size
        };
        let errors = [20, 40, 80].map(error);
        let found = order((20, errors[0]), (80, errors[2]));
        assert!(found > 1.8 && errors[1] < 0.01, "{arrangement}: order {found}, {errors:?}");
    }
}

fn expectation(measure: Measure, component: Component) -> Expectation {
    Expectation {
        component: Some(component),
        sensor: None,
        length: None,
        duration: None,
        delay: None,
        after: None,
        line: None,
        measure,
        value: Some(1.0),
        profile: None,
        column: None,
        on: None,
        between: None,
        tracer: None,
        side: None,
        tolerance: 0.1,
        source: "itself".to_owned(),
    }
}

#[test]
fn fluxes_and_differences_of_an_exact_flow_are_what_they_are() {
    let case = around(40, &["cloud.arrangement=jittered"]);
    let cloud = Cloud::build(&case).expect("a cloud");
    let (state, exact) = (exact_state(&case, &cloud), Exact::of(&case).expect("an exact flow"));
    let sampler = Sampler::of(&case, &cloud.position).expect("a sampler");
    let measured =
        |row: Expectation| Probe::of_expectation("it", &row, &case, &sampler).expect("a probe").value(&state);
    let through =
        |on: &str| measured(Expectation { on: Some(on.to_owned()), ..expectation(Measure::Flux, Component::Velocity) });
    let fine = |from: DVec2, to: DVec2, normal: DVec2| {
        let at = |k: usize| exact.velocity(from.lerp(to, (k as f64 + 0.5) / 4000.0), 0.0).dot(normal);
        (0..4000).map(at).sum::<f64>() * from.distance(to) / 4000.0
    };
    let size = cloud.size;
    let mut sum = 0.0;
    for (side, from, to, normal) in [
        ("left", DVec2::ZERO, DVec2::new(0.0, size.y), DVec2::NEG_X),
        ("right", DVec2::new(size.x, 0.0), size, DVec2::X),
        ("bottom", DVec2::ZERO, DVec2::new(size.x, 0.0), DVec2::NEG_Y),
        ("top", DVec2::new(0.0, size.y), size, DVec2::Y),
    ] {
        let (found, right) = (through(side), fine(from, to, normal));
        assert!((found - right).abs() < 2e-5, "{side}: {found}, not {right}");
        sum += found;
    }
    assert!(sum.abs() < 5e-5 && through("ball").abs() < 1e-3, "{sum}, {}", through("ball"));

    let between = Some([[0.2, 0.3], [1.3, 0.8]]);
    for (component, of) in [
        (Component::U, (|flow: &Exact, place| flow.velocity(place, 0.0).x) as fn(&Exact, DVec2) -> f64),
        (Component::V, |flow, place| flow.velocity(place, 0.0).y),
        (Component::P, |flow, place| flow.pressure(place, 0.0)),
    ] {
        let found = measured(Expectation { between, ..expectation(Measure::Difference, component) });
        let right = of(&exact, DVec2::new(0.2, 0.3)) - of(&exact, DVec2::new(1.3, 0.8));
        assert!((found - right).abs() < 1e-4, "{component:?}: {found}, not {right}");
    }
}

/// Relative errors of the velocity and of the force at the end of a run.
fn run(case: &Case) -> [f64; 2] {
    let scene = Arc::new(Scene::build(case).expect("a scene"));
    let mut rows = Rows::default();
    let mut engine = cpu::double(&scene).expect("an engine");
    let outcome = simulate(&scene, engine.as_mut(), &mut rows).expect("a run");
    assert!(matches!(outcome.stop, Stop::End | Stop::Steady), "{:?}", outcome.stop);
    let exact = Exact::of(case).expect("an exact flow");
    let FieldError { difference, exact } = FieldError::new(&outcome.snapshot, &exact, Component::Velocity);
    let last = rows.rows.last().expect("a row");
    let [x, y] = last.probes[..] else { panic!("{last:?}") };
    let (right, size) = exact_force(case);
    [difference / exact, DVec2::new(x, y).distance(right) / size]
}

/// Its outline prescribes the exact velocity, and so lets it through.
#[test]
fn a_steady_flow_outside_an_obstacle_is_met_at_order_two_and_its_force_ever_closer() {
    for arrangement in ARRANGEMENTS {
        let arrangement = format!("cloud.arrangement={arrangement}");
        let of = |n: usize| run(&around(n, &[&arrangement, FIT]));
        let (coarse, fine) = (of(16), of(32));
        let velocity = order((16, coarse[0]), (32, fine[0]));
        assert!(velocity > 1.6 && fine[0] < 4e-3, "{arrangement}: order {velocity}, {coarse:?} to {fine:?}");
        // Along walls the pressure is of first order.
        assert!(fine[1] < 0.7 * coarse[1] && fine[1] < 5e-3, "{arrangement}: {coarse:?} to {fine:?}");
    }
}

#[test]
fn the_shape_of_the_obstacle_changes_the_force() {
    let case = around(32, &["cloud.arrangement=jittered"]);
    let square = |half: f64| {
        let corners = [[-half, -half], [half, -half], [half, half], [-half, half]];
        let corners = corners.map(|corner| (CENTRE + DVec2::from_array(corner)).to_array()).to_vec();
        let obstacle = Obstacle { name: "ball".to_owned(), circle: None, polygon: Some(corners), parts: None };
        assert!((Shape::of(&obstacle).area() - 4.0 * half * half).abs() < 1e-12);
        Case { obstacles: vec![obstacle], ..case.clone() }
    };
    let force = |case: &Case| {
        let cloud = Cloud::build(case).expect("a cloud");
        let probes = Probe::of_case(case, &cloud.position).expect("probes");
        value(&probes, "force_x_ball", &exact_state(case, &cloud))
    };
    let [round, small, large] = [force(&case), force(&square(0.12)), force(&square(0.2))];
    assert!((round / small - 1.0).abs() > 0.1 && (large / small - 1.0).abs() > 0.1, "{round} {small} {large}");
}
