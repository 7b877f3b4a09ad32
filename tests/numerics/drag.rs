//! Drag of porous bodies: Brinkman's channel, the pointwise solution, steps of any length, and what a scene without it has of it.

use std::sync::Arc;

use glam::DVec2;
use stillpoint::case::Case;
use stillpoint::cpu;
use stillpoint::scene::Scene;
use stillpoint::simulation::{Outcome, simulate};
use stillpoint::step::{Buffer, Operation};

use crate::bench::{Bench, most, order};
use crate::cases::{cavity, cavity_of};

fn run(case: &Case) -> Outcome {
    let scene = Arc::new(Scene::build(case).expect("a scene"));
    simulate(&scene, cpu::double(&scene).expect("an engine").as_mut(), &mut ()).expect("a run")
}

/// Gravity along a channel that a porous body fills: `G k / nu (1 - cosh(s / sqrt(k)) / cosh(H / sqrt(k)))`, `s` from the middle.
fn brinkman(n: usize, arrangement: &str) -> f64 {
    let (gravity, viscosity, permeability, half) = (2.0, 0.5, 0.01_f64, 0.5_f64);
    let mut case = cavity_of(
        n,
        &[
            arrangement,
            "domain.periodic=x",
            "boundaries.top.velocity=[0.0, 0.0]",
            "effects.viscosity.kinematic=0.5",
            "effects.gravity.acceleration=[2.0, 0.0]",
            "effects.drag.permeability=0.01",
            // 15 times that in which the body stops the fluid.
            "time.end=0.3",
        ],
    );
    (case.effects.pressure, case.effects.advection) = (None, None);
    let snapshot = run(&case).snapshot;
    let root = permeability.sqrt();
    let exact = |y: f64| gravity * permeability / viscosity * (1.0 - ((y - half) / root).cosh() / (half / root).cosh());
    let (mut off, mut size) = (0.0, 0.0);
    for (place, velocity) in snapshot.position.iter().zip(&snapshot.velocity) {
        off += (*velocity - DVec2::new(exact(place.y), 0.0)).length_squared();
        size += exact(place.y).powi(2);
    }
    (off / size).sqrt()
}

#[test]
fn brinkmans_channel_is_met_at_order_two() {
    for arrangement in ["cloud.arrangement=regular", "cloud.arrangement=jittered"] {
        // The layer beside a plate is a tenth of the width.
        let (coarse, fine) = (brinkman(32, arrangement), brinkman(64, arrangement));
        let order = order((32, coarse), (64, fine));
        assert!(order > 1.8 && fine < 0.01, "{arrangement}: order {order}, {coarse} to {fine}");
    }
}

/// The velocity that is left, put into its equation by hand: `w + h (nu / k + F |w|) w = m`.
#[test]
fn what_is_left_of_a_velocity_solves_the_law_of_the_body() {
    let drag = "effects.drag={ permeability = 0.02, inertia = 7.0, circle = { centre = [0.5, 0.5], radius = 0.3 } }";
    for (splitting, mean) in [("time.splitting=reflection", 0.2), ("time.splitting=projection", 0.0)] {
        let mut bench = Bench::new(&cavity(&[drag, splitting]));
        let velocity = bench.sample(|p| DVec2::new(3.0 * p.x, -2.0 * p.y));
        let before = bench.sample(|p| DVec2::new(0.1 * p.y, 0.3));
        bench.write_vectors(Buffer::Velocity, &velocity);
        bench.write_vectors(Buffer::Kick, &before);
        if mean > 0.0 {
            let points = bench.points();
            bench.write_vectors(Buffer::PressureKick, &vec![DVec2::splat(mean); points]);
        }
        bench.apply(&[Operation::Drag]);
        let after = bench.vectors(Buffer::Kick);
        let mut reached = 0;
        for (point, place) in bench.scene.cloud.position.iter().enumerate() {
            let moving = velocity[point] + before[point] - mean;
            let left = moving + after[point] - before[point];
            let inside = place.distance(DVec2::splat(0.5)) <= 0.3;
            // Of a kick of a second.
            let rate = if inside { 0.01 / 0.02 + 7.0 * left.length() } else { 0.0 };
            assert!((left + rate * left - moving).length() < 1e-12, "{splitting}: {left} of {moving} at {place}");
            reached += u32::from(inside);
        }
        assert!(reached > 50 && reached < 200, "{reached} points in the body");
    }
}

/// A body that lets nothing through, in steps a million times as long as it takes to stop the fluid.
#[test]
fn a_dense_body_stops_the_fluid_in_steps_of_any_length() {
    let dense = "effects.drag={ permeability = 1e-10, polygon = [[0.3, 0.3], [0.7, 0.3], [0.7, 0.7], [0.3, 0.7]] }";
    let outcome = run(&cavity(&["cloud.arrangement=jittered", "time.end=4.0", dense]));
    let inside = |place: &DVec2| (*place - 0.5).abs().max_element() < 0.15;
    let speeds = outcome.snapshot.position.iter().zip(&outcome.snapshot.velocity);
    let (still, moving): (Vec<_>, Vec<_>) = speeds.partition(|(place, _)| inside(place));
    let fastest = |of: &[(&DVec2, &DVec2)]| of.iter().map(|(_, u)| u.length()).fold(0.0, most);
    assert!(outcome.warnings.is_empty(), "{:?}", outcome.warnings);
    assert!(still.len() > 20 && fastest(&still) < 0.01 && fastest(&moving) > 0.2, "{}", fastest(&still));
}

#[test]
fn a_scene_without_it_has_none_of_it_and_with_it_another_answer() {
    let everywhere = "effects.drag.permeability=0.01";
    let plan = |changes: &[&str]| Scene::build(&cavity(changes)).expect("a scene").plan;
    let (with, without) = (plan(&[everywhere]), plan(&[]));
    assert_eq!(with.operations().filter(|&operation| operation == Operation::Drag).count(), 2);
    assert!(!without.operations().any(|operation| operation == Operation::Drag));
    assert!(with.buffers().contains(&Buffer::Resistance) && !without.buffers().contains(&Buffer::Resistance));
    assert_eq!(with.buffers().len(), without.buffers().len() + 1);
    let fixed = ["time.end=0.2", "time.step=0.02"];
    let of = |changes: &[&str]| run(&cavity(&[&fixed, changes].concat())).snapshot.velocity;
    let apart = |a: &[DVec2], b: &[DVec2]| a.iter().zip(b).map(|(a, b)| (*a - *b).length()).fold(0.0, most);
    let base = of(&[everywhere]);
    let in_a_triangle = "effects.drag={ permeability = 0.01, polygon = [[0.2, 0.6], [0.8, 0.6], [0.5, 0.9]] }";
    let in_a_circle = "effects.drag={ permeability = 0.01, circle = { centre = [0.5, 0.7], radius = 0.2 } }";
    let with_inertia = "effects.drag={ permeability = 0.01, inertia = 5.0 }";
    for other in [&[][..], &["effects.drag.permeability=0.02"], &[in_a_triangle], &[in_a_circle], &[with_inertia]] {
        let changed = apart(&base, &of(other));
        assert!(changed > 1e-4, "{other:?}: {changed}");
    }
}
