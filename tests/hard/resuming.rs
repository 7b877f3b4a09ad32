//! A run in two is the run in one go, to the last bit: every engine of the CPU, on any number of threads.

use std::path::Path;
use std::sync::Arc;

use stillpoint::case::Case;
use stillpoint::cpu;
use stillpoint::engine::{Data, Engine, EngineError};
use stillpoint::motion::Row;
use stillpoint::output::checkpoint::Checkpoint;
use stillpoint::output::{RunFolder, StopReason};
use stillpoint::run::{self, Job};
use stillpoint::scene::Scene;
use stillpoint::simulation::{Diagnostics, Observer, Outcome, State, resume, simulate};
use stillpoint::snapshot::Snapshot;
use stillpoint::step::Buffer;

use crate::cases::{ARRANGEMENTS, cavity_of, turning, vortices, wake};
use crate::columns::{MOTIONS, MPS, column};
use crate::folders::result;

type Open = fn(&Arc<Scene>) -> Result<Box<dyn Engine>, EngineError>;

/// Keeps every row, frame and state.
#[derive(Default)]
pub struct Keeper {
    pub rows: Vec<Diagnostics>,
    pub moved: Vec<Row>,
    pub frames: Vec<Snapshot>,
    pub states: Vec<State>,
}

impl Observer for Keeper {
    fn report(&mut self, row: &Diagnostics) {
        self.rows.push(row.clone());
    }

    fn moved(&mut self, row: &Row) {
        self.moved.push(row.clone());
    }

    fn frame(&mut self, snapshot: &Snapshot) {
        self.frames.push(snapshot.clone());
    }

    fn stop_requested(&self) -> bool {
        false
    }

    fn keep(&mut self, state: &State) {
        self.states.push(state.clone());
    }
}

fn bits(outcome: &Outcome) -> Vec<[u64; 3]> {
    let pairs = outcome.snapshot.velocity.iter().zip(&outcome.snapshot.pressure);
    pairs.map(|(u, p)| [u.x, u.y, *p].map(f64::to_bits)).collect()
}

fn same(one: &Outcome, other: &Outcome, name: &str) {
    assert!(bits(one) == bits(other), "{name}: the fields differ");
    assert!(one.state.arrays == other.state.arrays, "{name}: the arrays differ");
    assert_eq!(one.state.progress, other.state.progress, "{name}");
    assert_eq!((&one.stop, one.steps, one.iterations), (&other.stop, other.steps, other.iterations), "{name}");
    assert_eq!((one.fallbacks, &one.warnings), (other.fallbacks, &other.warnings), "{name}");
}

fn check(name: &str, case: &Case, open: Open) {
    let scene = Arc::new(Scene::build(case).expect("a scene"));
    let mut whole = Keeper::default();
    let expected = simulate(&scene, open(&scene).expect("an engine").as_mut(), &mut whole).expect("a run");
    let rows = whole.rows.len();
    assert!(rows > 2 && whole.states.len() == rows + 1, "{name}: {rows} rows");
    for begin in [0, 1, rows / 2, rows] {
        let state = whole.states[begin].clone();
        let mut rest = Keeper::default();
        let outcome = resume(&scene, open(&scene).expect("an engine").as_mut(), &mut rest, state).expect("the rest");
        assert_eq!(rest.rows, whole.rows[begin..], "{name} from row {begin}: no row is lost or made twice");
        if scene.plan.moves() {
            assert_eq!(rest.moved, whole.moved[1 + begin..], "{name} from row {begin}: nor of the points");
            let first = whole.frames.len() - rest.frames.len();
            assert!(rest.frames == whole.frames[first..] && first > 0, "{name} from row {begin}: nor a frame");
        }
        same(&outcome, &expected, &format!("{name} from row {begin}"));
    }
    // It would be seen: a state with one velocity off does not lead there.
    let mut state = whole.states[1].clone();
    for (_, data) in state.arrays.iter_mut().filter(|(buffer, _)| *buffer == scene.plan.moving()) {
        let Data::Real(values) = data else { panic!("floats") };
        values[100] += 1e-3;
    }
    let outcome = resume(&scene, open(&scene).expect("an engine").as_mut(), &mut (), state).expect("the rest");
    assert!(bits(&outcome) != bits(&expected), "{name}");
}

#[test]
fn a_run_in_two_gives_the_same_bits_as_one_in_one_go() {
    let base = ["time.end=1.0", "output.report_every=3"];
    for (name, open) in [("f64", cpu::double as Open), ("f32", cpu::single)] {
        for (arrangement, changes) in ARRANGEMENTS {
            for more in [
                &[][..],
                &["effects.pressure.form=collocated"],
                &["effects.advection.remap=forward", "time.splitting=projection"],
                &["effects.pressure.solver=direct", "effects.pressure.gradient=adjoint"],
                &["effects.pressure.max_iterations=1", "time.step=0.04"],
            ] {
                let case = cavity_of(16, &[changes, &base[..], more].concat());
                check(&format!("{name}, {arrangement}, {more:?}"), &case, open);
            }
        }
        check(
            &format!("{name}, vortices"),
            &vortices(16, &["cloud.arrangement=jittered", "output.report_every=3"]),
            open,
        );
        check(&format!("{name}, wake"), &wake(14, &["time.end=0.5", "output.report_every=2"]), open);
        check(
            &format!("{name}, steady"),
            &cavity_of(12, &["time.end=20.0", "time.steady=0.05", "output.report_every=5"]),
            open,
        );
    }
}

#[test]
fn points_that_move_go_on_to_the_same_bits() {
    for (name, open) in [("f64", cpu::double as Open), ("f32", cpu::single)] {
        for (motion, changes) in MOTIONS {
            check(&format!("{name}, {motion}"), &column(&[changes, &["time.end=0.05"]].concat()), open);
        }
    }
}

/// Heat that drives the flow, fluid that comes and goes, and a tracer that a prescribed flow carries: its departures are found
/// when the steps change in length, and once more by a run that goes on.
#[test]
fn what_the_flow_carries_goes_on_to_the_same_bits() {
    let base = ["cloud.arrangement=jittered", "time.end=0.6", "output.report_every=3"];
    let heat = [
        "effects.gravity.acceleration=[0.0, -1.0]",
        "effects.heat={ diffusivity = 0.02, initial = 0.3 }",
        "effects.buoyancy={ expansion = 0.5, reference = 0.2 }",
        "boundaries.left.temperature=1.0",
        "boundaries.bottom.heat_flux=0.05",
    ];
    let ink =
        "effects.tracers=[{ name = 'ink', diffusivity = 0.01, shape = 'gaussian', centre = [0.5, 0.6], radius = 0.2 }]";
    let through = [
        "boundaries.left={ kind = 'inlet', velocity = [1.0, 0.0], profile = 'parabola' }",
        "boundaries.right.kind=outlet",
        ink,
    ];
    for (name, open) in [("f64", cpu::double as Open), ("f32", cpu::single)] {
        for (what, case) in [
            ("heat", cavity_of(16, &[&base[..], &heat].concat())),
            ("a tracer", cavity_of(16, &[&base[..], &[ink]].concat())),
            ("inlet and outlet", cavity_of(16, &[&base[..], &through].concat())),
            ("a rotation", turning(16, &base)),
        ] {
            check(&format!("{name}, {what}"), &case, open);
            let state = Scene::build(&case).expect("a scene").plan.state();
            assert!(state.iter().any(|buffer| matches!(buffer, Buffer::Carried(_))), "{what}: {state:?}");
        }
    }
}

/// The arrays are large enough that loops are shared out.
#[test]
fn any_number_of_threads_goes_on_to_the_same_bits() {
    let overrides = ["cloud.arrangement=jittered", "time.step=0.002", "time.end=0.006", "output.report_every=1"];
    let case = cavity_of(160, &[&overrides[..], &["effects.pressure.tolerance=1e-4"]].concat());
    let scene = Arc::new(Scene::build(&case).expect("a scene"));
    let on = |threads: usize, state: Option<State>| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool of threads");
        pool.install(|| {
            let mut keeper = Keeper::default();
            let mut engine = cpu::single(&scene).expect("an engine");
            let outcome = match state {
                Some(state) => resume(&scene, engine.as_mut(), &mut keeper, state),
                None => simulate(&scene, engine.as_mut(), &mut keeper),
            };
            (outcome.expect("a run"), keeper.states)
        })
    };
    let (expected, states) = on(1, None);
    for threads in [2, 3] {
        let (outcome, _) = on(threads, Some(states[1].clone()));
        same(&outcome, &expected, &format!("{threads} threads"));
    }
}

/// Asks for a stop after so many looks, in the middle of a row or between two.
struct Impatient(std::cell::Cell<u32>);

impl Observer for Impatient {
    fn report(&mut self, _: &Diagnostics) {}

    fn stop_requested(&self) -> bool {
        self.0.set(self.0.get().saturating_sub(1));
        self.0.get() == 0
    }
}

/// What Ctrl-C leaves is complete, and what is gone on with is the run that was not stopped.
#[test]
fn a_stopped_run_keeps_its_state_unasked_and_goes_on_to_the_same_files() {
    let cavity = cavity_of(16, &["cloud.arrangement=jittered", "time.end=2.0", "output.report_every=7"]);
    stop_and_go_on(&cavity);
    stop_and_go_on(&column(&["output.pictures=true"]));
    stop_and_go_on(&column(&[MPS, &["output.frame_every=0.015"]].concat()));
}

fn stop_and_go_on(case: &Case) {
    let scene = Arc::new(Scene::build(case).expect("a scene"));
    let root = tempfile::tempdir().expect("a temporary folder");
    let open = || cpu::double(&scene).expect("an engine");
    let folder = |name: &str| RunFolder::create(&root.path().join(name), false).expect("a folder");
    let whole = folder("whole");
    fn job<'a>(scene: &'a Arc<Scene>, folder: &'a RunFolder) -> Job<'a> {
        Job { case_path: Path::new("c.toml"), scene, folder, checkpoint_every: None }
    }
    run::run(job(&scene, &whole), open().as_mut(), &mut ()).expect("a run");
    for looks in [1, 3] {
        let stopped = folder(&format!("stopped after {looks}"));
        let report = run::run(job(&scene, &stopped), open().as_mut(), &mut Impatient(looks.into())).expect("a run");
        assert_eq!(report.summary.stop, StopReason::Interrupted);
        let path = stopped.checkpoint();
        let state = Checkpoint::read(&path).expect("a checkpoint").state(&scene, &path).expect("a state");
        assert!(state.progress.step <= report.summary.steps);
        // Frames end a row early.
        assert!(case.moves() || state.progress.step.is_multiple_of(7), "a row that was asked for");
        let report = run::resume(job(&scene, &stopped), state, open().as_mut(), &mut ()).expect("the rest");
        assert_eq!(report.summary.stop, StopReason::End);
        assert!(result(stopped.path()) == result(whole.path()), "after {looks} looks");
        assert!(!path.exists());
    }
}
