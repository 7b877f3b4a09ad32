//! The same case gives the same bits, on any number of threads; the same scene in other units, the same to rounding.

use std::sync::Arc;

use stillpoint::case::Case;
use stillpoint::cpu;
use stillpoint::scene::Scene;
use stillpoint::simulation::{Outcome, simulate};
use stillpoint::snapshot::Snapshot;

use crate::bench::{Open, most};
use crate::cases::{self, ARRANGEMENTS, cavity, cavity_of};

fn run(open: Open, case: &Case) -> Outcome {
    let scene = Arc::new(Scene::build(case).expect("a scene"));
    let mut engine = open(&scene).expect("an engine");
    simulate(&scene, engine.as_mut(), &mut ()).expect("a run")
}

fn on_threads(threads: usize, case: &Case) -> Outcome {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool of threads");
    pool.install(|| run(cpu::single, case))
}

fn bits(snapshot: &Snapshot) -> Vec<[u64; 3]> {
    let pairs = snapshot.velocity.iter().zip(&snapshot.pressure);
    pairs.map(|(u, p)| [u.x, u.y, *p].map(f64::to_bits)).collect()
}

#[test]
fn a_run_repeated_gives_the_same_bits() {
    for (name, arrangement) in ARRANGEMENTS {
        let case = cavity_of(16, &[arrangement, &["time.end=0.5"]].concat());
        let (first, second) = (run(cpu::single, &case), run(cpu::single, &case));
        assert_eq!(bits(&first.snapshot), bits(&second.snapshot), "{name}");
        assert_eq!((first.steps, first.iterations), (second.steps, second.iterations), "{name}");
        let moved =
            cavity_of(16, &[arrangement, &["time.end=0.5", "boundaries.top.velocity=[1.000001, 0.0]"]].concat());
        assert_ne!(bits(&run(cpu::single, &moved).snapshot), bits(&first.snapshot), "{name}: a slip would be seen");
    }
}

#[test]
fn one_thread_and_two_and_three_give_the_same_bits() {
    for form in ["conservative", "collocated"] {
        let form = format!("effects.pressure.form={form}");
        // Above 24 x 1024 points, below which loops are serial anyway; few iterations, which end in a direct solve.
        let overrides = [
            "cloud.arrangement=jittered",
            &form,
            "time.step=0.002",
            "time.end=0.006",
            "effects.pressure.tolerance=1e-4",
        ];
        let case = cavity_of(160, &overrides);
        let one = on_threads(1, &case);
        assert!(
            one.snapshot.position.len() > 24 * 1024 && one.steps == 3 && one.iterations > 3,
            "{one:?}",
            one = one.steps
        );
        for threads in [2, 3] {
            let other = on_threads(threads, &case);
            assert!(bits(&one.snapshot) == bits(&other.snapshot), "{form}: {threads} threads");
            assert_eq!(one.iterations, other.iterations, "{form}");
        }
    }
}

/// The same flow in a unit of length `metres` long: places, velocities and the viscosity change, and nothing in proportion.
fn scaled(open: Open, tolerance: &str, metres: f64, arrangement: &[&str]) -> Vec<[f64; 3]> {
    let case = cases::scaled(cavity(&[arrangement, &["time.end=0.5", tolerance]].concat()), metres);
    let outcome = run(open, &case);
    assert_eq!(outcome.fallbacks, 0, "{metres} m, {arrangement:?}");
    let Snapshot { position, velocity, pressure, .. } = outcome.snapshot;
    // Rounding decides on which side of a cell's edge a point is stored: compare place by place.
    let place = |&i: &usize| (position[i] / metres * 1e6).round().as_usizevec2().to_array();
    let mut order: Vec<usize> = (0..position.len()).collect();
    order.sort_by_key(place);
    let square = metres * metres;
    order.iter().map(|&i| [velocity[i].x / metres, velocity[i].y / metres, pressure[i] / square]).collect()
}

#[test]
fn nanometres_and_kilometres_give_the_same_flow_to_rounding() {
    for (name, arrangement) in ARRANGEMENTS {
        let compare = |base: &[[f64; 3]], other: &[[f64; 3]]| {
            let differences = base.iter().zip(other).flat_map(|(a, b)| (0..3).map(move |k| (a[k] - b[k]).abs()));
            differences.fold(0.0, most)
        };
        // The tolerance bounds what the solves leave, which differs: points near a cell's edge are stored in another order.
        let double = |metres| scaled(cpu::double, "effects.pressure.tolerance=1e-10", metres, arrangement);
        let single = |metres| scaled(cpu::single, "effects.pressure.tolerance=1e-5", metres, arrangement);
        let one = (double(1.0), single(1.0));
        for metres in [1e-9, 1e3] {
            let off = compare(&one.0, &double(metres));
            assert!(off < 1e-8, "{name}, {metres} m: {off:e}");
            let off = compare(&one.1, &single(metres));
            assert!(off < 2e-3, "{name}, {metres} m, f32: {off:e}");
        }
    }
}
