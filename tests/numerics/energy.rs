//! The pressure step with the adjoint gradient never adds kinetic energy, on any arrangement of points, at any dt.

use glam::DVec2;
use stillpoint::step::{Buffer, Operation};

use crate::bench::Bench;
use crate::cases::{ARRANGEMENTS, cavity_of};
use crate::random::Random;

const ADJOINT: &str = "effects.pressure.gradient=adjoint";
const DIRECT: &str = "effects.pressure.solver=direct";
const PROJECTION: &str = "time.splitting=projection";

fn energy(bench: &mut Bench) -> f64 {
    let (velocity, volume) = (bench.vectors(Buffer::Projected), bench.scalars(Buffer::Volume));
    velocity.iter().zip(&volume).map(|(u, v)| 0.5 * v * u.length_squared()).sum()
}

/// Velocities that rest on the walls: noise; a smooth one; the gradient of a noisy pressure, which the step is to take off
/// altogether and may take off more than once.
#[derive(Clone, Copy)]
enum Velocity {
    Noise,
    Smooth,
    Gradient,
}

const VELOCITIES: [Velocity; 3] = [Velocity::Noise, Velocity::Smooth, Velocity::Gradient];

fn velocity(bench: &mut Bench, random: &mut Random, kind: Velocity) -> Vec<DVec2> {
    let interior = bench.scene.sizes.interior;
    let mut velocity = match kind {
        Velocity::Noise => (0..bench.points()).map(|_| random.vector()).collect(),
        Velocity::Smooth => {
            let [a, b] = std::array::from_fn(|_| 6.0 * random.vector());
            bench.sample(|p| DVec2::new(a.dot(p).sin(), (b.dot(p) + 1.0).sin()))
        }
        Velocity::Gradient => {
            let pressure = random.numbers(bench.points());
            bench.write_scalars(Buffer::Pressure, &pressure);
            bench.write_vectors(Buffer::Projected, &[]);
            let correct = *bench.scene.plan.kick.last().expect("a correction");
            bench.apply(&[correct]);
            bench.write_scalars(Buffer::Pressure, &[]);
            bench.vectors(Buffer::Projected)
        }
    };
    velocity[interior..].fill(DVec2::ZERO);
    velocity
}

/// Energy after the pressure step over that before; the correction acts for `overlong` times the kick.
fn ratio(bench: &mut Bench, velocity: &[DVec2], dt: f64, overlong: f64) -> f64 {
    bench.clock = bench.scene.clock(dt);
    bench.write_vectors(Buffer::Velocity, velocity);
    let kick = bench.scene.plan.kick.clone();
    let from = kick.iter().position(|&operation| operation == Operation::Divergence).expect("a pressure step");
    bench.apply(&[Operation::ClearKick, Operation::Predict]);
    let before = energy(bench);
    bench.apply(&kick[from..from + 2]);
    bench.clock.kick *= overlong;
    bench.apply(&kick[from + 2..]);
    energy(bench) / before
}

/// The largest and the least ratio over clouds of all arrangements and many seeds.
fn ratios(overrides: &[&str], dt: &[f64], overlong: f64) -> [f64; 2] {
    let [mut least, mut most] = [f64::INFINITY, 0.0_f64];
    for seed in 1..=12 {
        for (name, arrangement) in ARRANGEMENTS {
            let seed_key = format!("cloud.seed={seed}");
            let seeded: &[&str] = if name == "regular" { &[] } else { &[&seed_key] };
            let mut bench = Bench::new(&cavity_of(12, &[arrangement, seeded, overrides, &[PROJECTION]].concat()));
            let mut random = Random::new(seed);
            for kind in VELOCITIES {
                let velocity = velocity(&mut bench, &mut random, kind);
                for &dt in dt {
                    let ratio = ratio(&mut bench, &velocity, dt, overlong);
                    assert!(ratio.is_finite(), "{name}, seed {seed}, dt {dt}");
                    (least, most) = (least.min(ratio), most.max(ratio));
                }
            }
        }
    }
    [least, most]
}

#[test]
fn the_adjoint_gradient_never_adds_energy() {
    let [least, most] = ratios(&[ADJOINT, DIRECT], &[1e-6, 1e-3, 1.0, 1e3], 1.0);
    assert!(most <= 1.0 + 1e-12, "{}", most - 1.0);
    assert!(least < 0.5 && most > 0.5, "the step does something, and not too much: {least} {most}");
}

#[test]
fn nor_does_it_with_conjugate_gradients_but_for_their_tolerance() {
    let iterative = ["effects.pressure.tolerance=1e-9", "effects.pressure.max_iterations=5000"];
    let [_, most] = ratios(&[&[ADJOINT], &iterative[..]].concat(), &[1e-3, 1.0], 1.0);
    assert!(most <= 1.0 + 1e-6, "{}", most - 1.0);
}

#[test]
fn a_correction_three_times_too_long_adds_energy() {
    let [_, most] = ratios(&[ADJOINT, DIRECT], &[1.0], 3.0);
    assert!(most > 1.1, "{most}");
}
