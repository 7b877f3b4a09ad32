//! Implicit viscosity: its solve, its order in time and space, steps far beyond the limit of explicit viscosity, and what a scene
//! without it has of it.

use std::sync::Arc;

use glam::DVec2;
use stillpoint::case::{Case, Component, Line};
use stillpoint::cpu;
use stillpoint::engine::Outcome as Ended;
use stillpoint::exact::Exact;
use stillpoint::measure::{FieldError, LineMeasure, Sampler};
use stillpoint::scene::Scene;
use stillpoint::simulation::{Diagnostics, Limit, Outcome, simulate};
use stillpoint::step::{Buffer, Operation};

use crate::bench::{Bench, most, order};
use crate::cases::{ARRANGEMENTS, cavity, cavity_of};
use crate::rows::Rows;

const IMPLICIT: &str = "effects.viscosity.scheme=implicit";
const OURS: [Operation; 7] = [
    Operation::ImplicitViscosity,
    Operation::ImplicitKick,
    Operation::PredictImplicit,
    Operation::AddMeanPressure,
    Operation::RelaxPressure,
    Operation::MeanKickByFit,
    Operation::MeanKickByAdjoint,
];
const ARRAYS: [Buffer; 6] = [
    Buffer::Middle,
    Buffer::ViscousResidual,
    Buffer::ViscousDirection,
    Buffer::ViscousProduct,
    Buffer::Dilation,
    Buffer::MeanPressure,
];

fn run(case: &Case) -> (Outcome, Vec<Diagnostics>) {
    let (scene, mut rows) = (Arc::new(Scene::build(case).expect("a scene")), Rows::default());
    let outcome = simulate(&scene, cpu::double(&scene).expect("an engine").as_mut(), &mut rows).expect("a run");
    (outcome, rows.rows)
}

/// The solution of the solve, put into its equation by hand.
#[test]
fn the_solve_gives_the_velocity_whose_viscous_force_leads_to_it() {
    for (name, arrangement) in ARRANGEMENTS {
        let changes = ["effects.viscosity={ kinematic = 0.3, scheme = 'implicit', tolerance = 1e-12 }"];
        let mut bench = Bench::new(&cavity(&[arrangement, &changes].concat()));
        let before = bench.sample(|p| DVec2::new((3.0 * p.y).sin(), p.x * p.x));
        bench.write_vectors(Buffer::Projected, &before);
        bench.apply(&[Operation::ImplicitViscosity, Operation::ImplicitKick]);
        let info = bench.engine.viscous_solve_info().expect("a solve");
        assert!(info.outcome == Ended::Converged && info.iterations > 10, "{name}: {info:?}");
        let (found, kick) = (bench.vectors(Buffer::Middle), bench.vectors(Buffer::Kick));
        let cells = bench.scene.cells().expect("cells");
        // Of a kick of a second.
        let reach = 0.3;
        for point in 0..bench.scene.sizes.interior {
            let force: DVec2 = cells.faces(point).map(|(other, face)| face * (found[other] - found[point])).sum();
            let off = found[point] - before[point] - reach / cells.volume[point] * force;
            assert!(off.length() < 1e-9, "{name}: {off} at {point}");
            assert!((kick[point] - (found[point] - before[point])).length() < 1e-15, "{name}");
        }
        let walls = bench.scene.sizes.interior..;
        assert_eq!(found[walls.clone()], bench.scene.initial_velocity()[walls], "{name}: the walls' own");
    }
}

/// Couette's flow or Poiseuille's, viscosity alone.
fn plates(n: usize, changes: &[&str]) -> Case {
    let base = ["domain.periodic=x", "effects.viscosity={ kinematic = 0.1, scheme = 'implicit', tolerance = 1e-9 }"];
    let mut case = cavity_of(n, &[&base, &["time.end=2.0", "cloud.arrangement=jittered"], changes].concat());
    (case.effects.pressure, case.effects.advection) = (None, None);
    case
}

fn couette(n: usize, step: f64, changes: &[&str]) -> (Case, Outcome) {
    let step = format!("time.step={step:e}");
    let case = plates(n, &[changes, &["exact.solution=couette", step.as_str()]].concat());
    let outcome = run(&case).0;
    (case, outcome)
}

/// Steps from 100 to 400 times as long as explicit ones may be.
#[test]
fn a_shear_is_of_order_two_in_time_with_halves_of_kicks_and_one_with_whole_ones() {
    for (splitting, range) in [("time.splitting=reflection", 1.8..2.4), ("time.splitting=projection", 0.85..1.15)] {
        let [long, middle, short] = [0.2, 0.1, 0.05].map(|step| couette(32, step, &[splitting]).1.snapshot.velocity);
        let apart = |a: &[DVec2], b: &[DVec2]| {
            (a.iter().zip(b).map(|(a, b)| (*a - *b).length_squared()).sum::<f64>() / a.len() as f64).sqrt()
        };
        let order = (apart(&long, &middle) / apart(&middle, &short)).log2();
        assert!(range.contains(&order), "{splitting}: order {order}");
    }
}

#[test]
fn a_shear_is_of_order_two_in_space_and_time_together() {
    let error = |n: usize, step: f64| {
        let (case, outcome) = couette(n, step, &[]);
        let exact = Exact::of(&case).expect("an exact flow");
        let FieldError { difference, exact } = FieldError::new(&outcome.snapshot, &exact, Component::Velocity);
        difference / exact
    };
    let (coarse, fine) = (error(16, 0.2), error(32, 0.1));
    let order = order((16, coarse), (32, fine));
    assert!(order > 1.8 && fine < 3e-4, "order {order}, {coarse} to {fine}");
}

/// The extremes of the velocity on the middle lines of the Stokes cavity, relative to the spectral ones of `cases/stokes_cavity.toml`.
fn extremes(outcome: &Outcome, case: &Case) -> [f64; 2] {
    let snapshot = &outcome.snapshot;
    let sampler = Sampler::new(&snapshot.position, case.cloud.spacing).expect("a sampler");
    let along =
        |component, line| LineMeasure::new(&sampler, snapshot, &case.domain, component, line).expect("a profile");
    let (u, v) = (along(Component::U, Line::X(0.5)), along(Component::V, Line::Y(0.5)));
    [u.minimum().value / -0.207756 - 1.0, v.maximum().value / 0.184445 - 1.0].map(f64::abs)
}

fn stokes(n: usize, times: f64, changes: &[&str]) -> Case {
    // What explicit viscosity would take on a lattice: 0.8 of 2 over 8 nu / l0^2.
    let step = format!("time.step={:e}", times * 0.2 / (n * n) as f64);
    let base = ["effects.viscosity={ kinematic = 1.0, scheme = 'implicit' }", "output.report_every=1"];
    let mut case = cavity_of(n, &[&base, changes, &[step.as_str()]].concat());
    case.effects.advection = None;
    case
}

#[test]
fn stokes_flow_is_right_in_steps_of_50_to_1000_times_the_explicit_limit() {
    for splitting in ["time.splitting=reflection", "time.splitting=projection"] {
        for (times, end) in [(50.0, "time.end=0.8"), (200.0, "time.end=3.0"), (1000.0, "time.end=10.0")] {
            let case = stokes(32, times, &[splitting, end]);
            let (outcome, rows) = run(&case);
            let off = extremes(&outcome, &case);
            assert!(off.into_iter().all(|off| off < 0.01), "{splitting}, {times}: {off:?}");
            assert!(outcome.warnings.is_empty() && outcome.fallbacks == 0, "{times}: {:?}", outcome.warnings);
            assert!(rows.iter().all(|row| row.max_speed <= 1.0 + 1e-9), "{splitting}, {times}");
            assert!(rows.iter().any(|row| row.viscous_iterations.is_some_and(|solve| solve > 10)), "{rows:?}");
            let last = rows.last().expect("a row");
            assert!(last.change < 0.1, "{last:?}");
        }
    }
}

/// On scattered points and with the adjoint gradient too.
#[test]
fn stokes_flow_is_right_on_any_points() {
    for (name, arrangement) in ARRANGEMENTS {
        for gradient in ["effects.pressure.gradient=fit", "effects.pressure.gradient=adjoint"] {
            let case = stokes(32, 100.0, &[arrangement, &[gradient, "time.end=1.5"]].concat());
            let (outcome, rows) = run(&case);
            let off = extremes(&outcome, &case);
            assert!(off.into_iter().all(|off| off < 0.05), "{name}, {gradient}: {off:?}");
            assert!(rows.iter().all(|row| row.max_speed < 1.5), "{name}, {gradient}");
        }
    }
}

/// The same steady flow as with explicit viscosity, to what the two Laplacians differ by.
#[test]
fn a_flow_with_everything_ends_where_explicit_viscosity_takes_it() {
    let end = ["cloud.arrangement=jittered", "effects.viscosity.kinematic=0.05", "time.end=6.0"];
    let explicit = run(&cavity(&end)).0;
    let implicit = run(&cavity(&[&end[..], &[IMPLICIT]].concat())).0;
    let off =
        explicit.snapshot.velocity.iter().zip(&implicit.snapshot.velocity).map(|(a, b)| (*a - *b).length_squared());
    let off = (off.sum::<f64>() / explicit.snapshot.velocity.len() as f64).sqrt();
    // m/s; at the ends of the lid alone it is more.
    assert!(off > 1e-6 && off < 0.02, "{off}");
    assert!(implicit.steps < explicit.steps, "{} and {} steps", implicit.steps, explicit.steps);
}

#[test]
fn fluid_at_rest_stays_at_rest_under_gravity() {
    let changes = [IMPLICIT, "effects.gravity.acceleration=[0.5, -2.0]", "boundaries.top.velocity=[0.0, 0.0]"];
    for (name, arrangement) in ARRANGEMENTS {
        for splitting in ["time.splitting=reflection", "time.splitting=projection"] {
            let tight = ["effects.pressure.tolerance=1e-12", "effects.viscosity.tolerance=1e-12", splitting];
            let (outcome, _) = run(&cavity(&[arrangement, &changes, &tight].concat()));
            let speed = outcome.snapshot.velocity.iter().map(|u| u.length()).fold(0.0, most);
            assert!(speed < 1e-9, "{name}, {splitting}: {speed:e} m/s");
        }
    }
}

#[test]
fn no_limit_of_viscosity_bounds_the_step_but_the_decay_of_the_slowest_shear() {
    let thick = ["effects.viscosity.kinematic=1.0", "time.end=0.1", "output.report_every=1"];
    let (outcome, rows) = run(&cavity(&[&thick[..], &[IMPLICIT]].concat()));
    let decay = 1.0 / std::f64::consts::PI.powi(2);
    assert_eq!(outcome.steps, (0.1 / (0.1 * decay)).ceil() as u64);
    assert!(rows.iter().all(|row| row.limit == Limit::Viscosity));
    assert!(run(&cavity(&thick)).0.steps > 5 * outcome.steps);
    // One step of everything: no warning of a limit that there is none of.
    let (outcome, _) = run(&stokes(20, 1000.0, &["time.end=1.0"]));
    assert!(outcome.warnings.is_empty(), "{:?}", outcome.warnings);
}

#[test]
fn a_scene_without_it_has_none_of_its_operations_and_arrays_and_with_it_another_answer() {
    for gradient in ["effects.pressure.gradient=fit", "effects.pressure.gradient=adjoint"] {
        let plan = |changes: &[&str]| Scene::build(&cavity(changes)).expect("a scene").plan;
        let (with, without) = (plan(&[gradient, IMPLICIT]), plan(&[gradient]));
        assert_eq!(with.operations().filter(|operation| OURS.contains(operation)).count(), 6);
        assert!(!without.operations().any(|operation| OURS.contains(&operation)));
        assert!(!without.buffers().iter().any(|buffer| ARRAYS.contains(buffer)));
        assert!(ARRAYS.iter().all(|buffer| with.buffers().contains(buffer)));
        assert!(!with.operations().any(|operation| matches!(operation, Operation::Viscosity(_))));
        assert!(!with.buffers().contains(&Buffer::LaplacianRow), "rows of explicit viscosity");
    }
    let fixed = ["time.end=0.2", "time.step=0.02", "cloud.arrangement=jittered"];
    let of = |changes: &[&str]| run(&cavity(&[&fixed, changes].concat())).0.snapshot.velocity;
    let apart = |a: &[DVec2], b: &[DVec2]| a.iter().zip(b).map(|(a, b)| (*a - *b).length()).fold(0.0, most);
    let (explicit, implicit) = (of(&[]), of(&[IMPLICIT]));
    assert!(apart(&explicit, &implicit) > 1e-5);
    assert!(apart(&implicit, &of(&[IMPLICIT, "effects.viscosity.tolerance=1e-2"])) > 1e-5);
}
