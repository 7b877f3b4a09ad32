//! A stalled iterative solve is handed to the direct one, is counted, and its answer is right.

use stillpoint::cpu;
use stillpoint::engine::Outcome;
use stillpoint::simulation::{Outcome as Run, simulate};
use stillpoint::step::Buffer;

use crate::bench::{Bench, most};
use crate::cases::{ARRANGEMENTS, cavity_of};

fn run(overrides: &[&str]) -> (Run, Bench) {
    let base = ["time.end=0.4", "time.step=0.04", "output.report_every=1"];
    let mut bench = Bench::new(&cavity_of(16, &[&base, overrides].concat()));
    let scene = bench.scene.clone();
    bench.engine = cpu::double(&scene).expect("an engine");
    let outcome = simulate(&scene, bench.engine.as_mut(), &mut ()).expect("a run");
    (outcome, bench)
}

#[test]
fn one_iteration_stalls_and_the_direct_solve_steps_in() {
    for (name, arrangement) in ARRANGEMENTS {
        for form in ["effects.pressure.form=conservative", "effects.pressure.form=collocated"] {
            let with = |more: &[&str]| run(&[arrangement, &[form], more].concat());
            let (stalled, mut bench) = with(&["effects.pressure.max_iterations=1"]);
            let (direct, _) = with(&["effects.pressure.solver=direct"]);
            assert_eq!(stalled.fallbacks, stalled.steps + 1, "{name}, {form}: every step, and the first half kick");
            assert_eq!(direct.fallbacks, 0, "{name}, {form}: a direct solve is none");
            let off = stalled.snapshot.velocity.iter().zip(&direct.snapshot.velocity).map(|(a, b)| (*a - *b).length());
            assert!(off.fold(0.0, most) < 1e-12, "{name}, {form}");
            assert_eq!(bench.engine.solve_info().outcome, Outcome::Converged);
            assert!(bench.scalars(Buffer::Pressure).iter().any(|p| p.abs() > 1e-3), "{name}, {form}");
        }
    }
}

#[test]
fn enough_iterations_need_no_direct_solve() {
    for (name, arrangement) in ARRANGEMENTS {
        let (outcome, _) = run(arrangement);
        assert_eq!(outcome.fallbacks, 0, "{name}");
        assert!(outcome.iterations > outcome.steps, "{name}");
    }
}

/// After a fall-back, what is reported is the residual of the answer that is used, not of the one thrown away.
#[test]
fn the_residual_reported_after_a_direct_solve_is_its_own() {
    for form in ["effects.pressure.form=conservative", "effects.pressure.form=collocated"] {
        let (_, bench) = run(&[form, "effects.pressure.max_iterations=1"]);
        let info = bench.engine.solve_info();
        assert!(info.last_residual < 1e-8, "{form}: {info:?}");
    }
}
