//! The remaps: exact where the fits are, and constants stay constant.

use glam::{DMat2, DVec2};
use stillpoint::step::{Buffer, Operation, Points};

use crate::bench::{Bench, most};
use crate::cases::{ARRANGEMENTS, cavity};

const FORWARD: &str = "effects.advection.remap=forward";

/// The velocity after a drift of `dt` s, from `before` at every point.
fn carried(bench: &mut Bench, before: &[DVec2], dt: f64) -> Vec<DVec2> {
    bench.clock.dt = dt;
    let moving = bench.scene.plan.moving();
    bench.write_vectors(moving, before);
    let drift = bench.scene.plan.drift.clone();
    bench.apply(&drift);
    bench.vectors(Buffer::Velocity)[..bench.scene.sizes.interior].to_vec()
}

fn farthest(bench: &Bench, found: &[DVec2], expected: impl Fn(DVec2) -> DVec2) -> f64 {
    let pairs = found.iter().zip(&bench.scene.cloud.position);
    pairs.map(|(&u, &place)| (u - expected(place)).length()).fold(0.0, most)
}

fn quadratic(p: DVec2) -> DVec2 {
    DVec2::new(0.8 - 0.3 * p.x + 0.5 * p.y - 0.9 * p.x * p.y, -0.4 + 0.7 * p.x * p.x - 0.2 * p.y * p.y)
}

#[test]
fn a_quadratic_velocity_is_carried_back_exactly_by_the_departure_remap() {
    for (name, arrangement) in ARRANGEMENTS {
        for weight in ["method.weight=none", "method.weight=quadratic"] {
            let mut bench = Bench::new(&cavity(&[arrangement, &[weight]].concat()));
            let before = bench.sample(quadratic);
            // Four spacings a step, farther than any one neighbourhood, and walls that paths may not cross.
            for dt in [1e-3, 0.05, 0.2] {
                let back = |p: DVec2, u: DVec2| (p - dt * u).clamp(DVec2::ZERO, DVec2::ONE);
                let expected = |p: DVec2| quadratic(back(p, quadratic(back(p, quadratic(p)))));
                let after = carried(&mut bench, &before, dt);
                let off = farthest(&bench, &after, expected);
                assert!(off < 1e-10, "{name}, {weight}, dt {dt}: {off:e}");
                let late = |p| expected(p) + 1e-6 * (quadratic(p) - expected(p)).normalize_or(DVec2::X);
                assert!(farthest(&bench, &after, late) > 1e-7, "{name}: a slip of 1e-6 is seen");
            }
        }
    }
}

#[test]
fn a_uniform_velocity_is_carried_anywhere_unchanged() {
    for (name, arrangement) in ARRANGEMENTS {
        for remap in [&[][..], &[FORWARD]] {
            let mut bench = Bench::new(&cavity(&[arrangement, remap].concat()));
            let wind = DVec2::new(0.7, -0.4);
            let before = bench.sample(|_| wind);
            let after = carried(&mut bench, &before, 0.05);
            let off = farthest(&bench, &after, |_| wind);
            assert!(off < 1e-14, "{name} {remap:?}: {off:e}");
        }
    }
}

#[test]
fn a_linear_velocity_is_carried_back_exactly_by_the_forward_remap() {
    let velocity = DMat2::from_cols(DVec2::new(0.5, -0.3), DVec2::new(0.8, -0.4));
    let centre = DVec2::splat(0.5);
    for (name, arrangement) in ARRANGEMENTS {
        let mut bench = Bench::new(&cavity(&[arrangement, &[FORWARD]].concat()));
        let dt = 0.05;
        // At r' = r + dt A r the fluid carries A r = A (1 + dt A)^-1 r'; walls stand, and hold the same field.
        let after_field = velocity * (DMat2::IDENTITY + dt * velocity).inverse();
        let mut before = bench.sample(|p| velocity * (p - centre));
        let interior = bench.scene.sizes.interior;
        for (u, &place) in before.iter_mut().zip(&bench.scene.cloud.position).skip(interior) {
            *u = after_field * (place - centre);
        }
        let after = carried(&mut bench, &before, dt);
        let off = farthest(&bench, &after, |p| after_field * (p - centre));
        assert!(off < 1e-10, "{name}: {off:e}");
        let unmoved = farthest(&bench, &after, |p| velocity * (p - centre));
        assert!(unmoved > 1e-3, "{name}: standing still would be seen, {unmoved:e}");
    }
}

#[test]
fn walls_keep_their_velocity_and_their_place() {
    for remap in [&[][..], &[FORWARD]] {
        let mut bench = Bench::new(&cavity(remap));
        let interior = bench.scene.sizes.interior;
        let held = bench.vectors(Buffer::Velocity)[interior..].to_vec();
        assert!(held.contains(&DVec2::X));
        let before = bench.sample(quadratic);
        carried(&mut bench, &before, 0.05);
        assert_eq!(bench.vectors(Buffer::Velocity)[interior..], held);
        if bench.scene.plan.drift.contains(&Operation::MovePoints) {
            let moved = bench.vectors(Buffer::Position(Points::Moved));
            let standing = &bench.scene.cloud.position;
            assert_eq!(moved[interior..], standing[interior..]);
            assert!(moved[..interior].iter().zip(standing).all(|(a, b)| a != b));
        }
    }
}

#[test]
fn without_advection_nothing_is_carried() {
    let mut case = cavity(&[]);
    case.effects.advection = None;
    let mut bench = Bench::new(&case);
    let before = bench.sample(quadratic);
    assert_eq!(carried(&mut bench, &before, 0.05), before[..bench.scene.sizes.interior]);
}
