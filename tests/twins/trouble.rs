//! Numbers that are none, sources that overflow and solves that stall: the GPU ends as the CPU does.

use std::sync::Arc;

use stillpoint::engine::{Clock, Data, Engine, Outcome};
use stillpoint::gpu::Precision;
use stillpoint::scene::Scene;
use stillpoint::simulation::{Diagnostics, Observer, Stop, Trouble, simulate};
use stillpoint::step::{Buffer, Operation, Points};

use crate::cases::cavity_of;
use crate::compare::FACTOR;
use crate::engines::{Engines, candidate, gpu, reals};
use crate::spoiled::Spoiled;

fn scene(changes: &[&str]) -> Arc<Scene> {
    Arc::new(Scene::build(&cavity_of(16, changes)).expect("a scene"))
}

/// Setup and a first half kick.
fn begin(scene: &Scene, engine: &mut dyn Engine, clock: &Clock) {
    for &operation in scene.plan.setup.iter().chain(&scene.plan.kick) {
        engine.apply(operation, clock).unwrap_or_else(|error| panic!("{operation:?}: {error}"));
    }
}

/// The clamp to the rectangle must not make a number of one that is none.
#[test]
fn a_lost_velocity_is_not_replaced_by_that_of_a_corner() {
    let Some(candidate) = candidate() else { return };
    let scene = scene(&["cloud.arrangement=jittered"]);
    let (clock, moving, point) = (scene.clock(0.02), scene.plan.moving(), 123);
    let mut engines = Engines::new(&candidate, &scene);
    let lost = engines.each().map(|engine| {
        begin(&scene, engine, &clock);
        engine.advance(3, &clock).expect("steps");
        engine.apply(Operation::FitVelocity(Points::Standing), &clock).expect("fits");
        // After the fits: their coefficients are numbers, and the clamp alone could hide it.
        let mut values = reals(engine, moving);
        values[2 * point] = f64::NAN;
        engine.write(moving, &Data::Real(values)).expect("a velocity");
        engine.apply(Operation::RemapDeparture, &clock).expect("a remap");
        let velocity = reals(engine, Buffer::Velocity);
        (0..scene.sizes.points).filter(|&i| !velocity[2 * i].is_finite()).collect::<Vec<_>>()
    });
    assert!(lost[0].contains(&point), "{lost:?}");
    assert!(lost.iter().all(|points| *points == lost[0]), "{lost:?}");
}

/// Keeps the time of the last row, s.
#[derive(Default)]
struct LastRow(f64);

impl Observer for LastRow {
    fn report(&mut self, row: &Diagnostics) {
        self.0 = row.time;
    }

    fn stop_requested(&self) -> bool {
        false
    }
}

#[test]
fn a_lost_velocity_stops_the_run_and_the_last_good_state_is_kept() {
    let Some(candidate) = candidate() else { return };
    for form in ["effects.pressure.form=conservative", "effects.pressure.form=collocated"] {
        let scene = scene(&[form, "output.report_every=10", "time.end=20.0", "guard.retries=0"]);
        let inner = Box::new(gpu(&candidate, &scene, Precision::Single));
        let mut engine = Spoiled::new(inner, scene.plan.moving(), 123, 25);
        let mut row = LastRow::default();
        let outcome = simulate(&scene, &mut engine, &mut row).expect("a run");
        let Stop::Trouble { trouble: Trouble::NonFinite { field, .. }, step } = outcome.stop else {
            panic!("{form}: {:?}", outcome.stop)
        };
        assert!((21..=30).contains(&step), "{form}: step {step}");
        assert_eq!(field.buffer, Buffer::Projected, "{form}");
        let snapshot = &outcome.snapshot;
        assert!(snapshot.time == row.0 && row.0 > 0.0, "{form}: {} s, {} s", snapshot.time, row.0);
        assert!(snapshot.velocity.iter().all(|u| u.is_finite()) && snapshot.pressure.iter().all(|p| p.is_finite()));
        assert!(snapshot.velocity[..scene.sizes.interior].iter().any(|u| u.length() > 0.05), "{form}: not of rest");
    }
}

/// A source that overflows f32 while the velocity it is of does not.
#[test]
fn a_source_that_is_no_number_stops_the_run() {
    let Some(candidate) = candidate() else { return };
    for solver in ["conjugate_gradient", "bicgstab", "direct"] {
        let scene = scene(&["fluid.density=1e38", &format!("effects.pressure.solver={solver}")]);
        let clock = scene.clock(0.01);
        let mut engines = Engines::new(&candidate, &scene);
        let [double, single, gpu] = engines.each().map(|engine| {
            begin(&scene, engine, &clock);
            engine.advance(3, &clock).expect("steps")
        });
        assert_eq!((double.trouble, double.steps), (None, 3), "{solver}");
        for advance in [single, gpu] {
            let trouble = advance.trouble.unwrap_or_else(|| panic!("{solver}: {advance:?}"));
            assert_eq!((trouble.buffer, advance.fallbacks), (Buffer::Source, 0), "{solver}");
        }
    }
}

/// Solves that may take a single iteration: every one is handed on, counted, the first half kick's too, and what is reported
/// is the residual of the answer that is used.
#[test]
fn a_stalled_solve_reports_the_direct_one() {
    let Some(candidate) = candidate() else { return };
    for form in ["conservative", "collocated"] {
        let form = format!("effects.pressure.form={form}");
        let scene = scene(&[&form, "effects.pressure.max_iterations=1"]);
        let clock = scene.clock(0.02);
        let mut engines = Engines::new(&candidate, &scene);
        let [_, single, gpu] = engines.each().map(|engine| {
            begin(&scene, engine, &clock);
            let done = engine.advance(3, &clock).expect("steps");
            assert_eq!((done.steps, done.fallbacks), (3, 4), "{form}");
            engine.solve_info()
        });
        assert_eq!((gpu.outcome, gpu.iterations), (Outcome::Converged, 1), "{form}");
        assert!(gpu.first_residual > 1e-2, "{form}: {gpu:?}");
        assert!(
            gpu.last_residual > 0.0 && gpu.last_residual <= FACTOR * single.last_residual,
            "{form}: {gpu:?} {single:?}"
        );
        assert!(gpu.last_residual < 1e-4 * gpu.first_residual, "{form}: {gpu:?}");
    }
}
