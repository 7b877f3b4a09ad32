//! What is watched while a run goes, the way back where it goes wrong, and what is left where nothing helps.

use std::sync::Arc;
use std::time::Instant;

use stillpoint::case::Case;
use stillpoint::cpu;
use stillpoint::engine::{Advance, Clock, Data, Engine, EngineError, EngineInfo, Measurement, SolveInfo};
use stillpoint::motion;
use stillpoint::scene::Scene;
use stillpoint::simulation::{Limit, Progress, State, Stop, Trouble};
use stillpoint::step::{Buffer, Operation};

use crate::cases::cavity_of;
use crate::columns::{MOTIONS, column};
use crate::flow::{Flow, flow_of, flow_on};
use crate::folders::{message, result, run, stillpoint};
use crate::spoiled::Spoiled;

fn limits(changes: &[&str]) -> Vec<Limit> {
    let flow = flow_of(&cavity_of(16, changes)).expect("a run");
    flow.rows.iter().map(|row| row.limit).collect()
}

#[test]
fn a_row_says_what_limits_its_steps() {
    let all = |changes: &[&str], limit| {
        let limits = limits(changes);
        assert!(!limits.is_empty() && limits.iter().all(|&found| found == limit), "{changes:?}: {limits:?}");
    };
    all(&[], Limit::Courant);
    all(&["effects.viscosity.kinematic=1.0", "time.end=0.02"], Limit::Viscosity);
    all(&["effects.heat={ diffusivity = 1.0, initial = 0.3 }", "time.end=0.02"], Limit::Diffusion);
    all(&["time.step=0.01"], Limit::Fixed);
    all(
        &["effects.gravity.acceleration=[0.0, -1e3]", "boundaries.top.velocity=[0.0, 0.0]", "time.end=0.1"],
        Limit::Gravity,
    );
    let mut still = cavity_of(16, &[]);
    still.effects.viscosity = None;
    still.effects.advection = None;
    let flow = flow_of(&still).expect("a run");
    assert!(flow.rows.iter().all(|row| row.limit == Limit::End) && flow.outcome.steps == 1);
}

fn spoiled(changes: &[&str]) -> Flow {
    let base = ["output.report_every=10", "time.end=2.0"];
    let scene = Arc::new(Scene::build(&cavity_of(16, &[&base[..], changes].concat())).expect("a scene"));
    let mut engine = Spoiled::new(cpu::double(&scene).expect("an engine"), scene.plan.moving(), 100, 25);
    flow_on(&scene, &mut engine).expect("a run")
}

#[test]
fn a_run_goes_back_to_its_last_good_state_and_on_with_half_the_step() {
    let flow = spoiled(&[]);
    let undisturbed = flow_of(&cavity_of(16, &["output.report_every=10", "time.end=2.0"])).expect("a run");
    assert!(flow.ended() && flow.is_finite(), "{}", flow.end());
    assert_eq!(flow.outcome.state.progress.halvings, 1);
    let warning = &flow.outcome.warnings[..];
    assert!(
        matches!(warning, [one] if one.ends_with("turned non-finite; went back to step 20 and on with half the step")),
        "{warning:?}"
    );
    // Rows before it are those of an undisturbed run; behind it steps are half as long, and the flow is the same.
    assert_eq!(flow.rows[..2], undisturbed.rows[..2]);
    let (row, whole) = (&flow.rows[2], &undisturbed.rows[2]);
    assert_eq!((row.step, row.limit), (30, Limit::Guard));
    assert!((row.dt / whole.dt - 0.5).abs() < 0.05, "{} s, {} s", row.dt, whole.dt);
    let off = flow.energy() / undisturbed.energy() - 1.0;
    assert!(off.abs() < 0.05 && off != 0.0, "{off}");
}

#[test]
fn a_run_gives_up_after_the_tries_it_has() {
    let flow = spoiled(&["guard.retries=0"]);
    let Stop::Trouble { trouble: Trouble::NonFinite { .. }, step } = flow.outcome.stop else {
        panic!("{}", flow.end())
    };
    assert!((21..=30).contains(&step) && flow.outcome.state.progress.step == 20 && flow.is_finite());
    // Viscosity that no half, quarter or eighth of the step makes stable, and that a two-hundredth does.
    let keys = ["time.step=0.2", "time.end=4.0", "effects.viscosity.kinematic=0.2", "output.report_every=10"];
    let ended = |retries: &str| {
        let mut case = cavity_of(16, &[&keys[..], &[retries]].concat());
        case.effects.advection = None;
        flow_of(&case).expect("a run")
    };
    let failed = ended("guard.retries=2");
    assert!(!failed.ended() && failed.is_finite() && failed.outcome.state.progress.halvings == 2, "{}", failed.end());
    let mended = ended("guard.retries=10");
    assert!(mended.ended() && mended.is_finite() && mended.most_energy() < 1.0, "{}", mended.end());
}

/// The same flow, which grows by itself, is stopped the sooner the less energy is let through.
#[test]
fn energy_that_nothing_accounts_for_stops_a_run() {
    let keys = ["time.step=0.1", "time.end=40.0", "effects.viscosity.kinematic=0.1", "output.report_every=1"];
    let steps = |energy: &str| {
        let mut case = cavity_of(16, &[&keys[..], &["guard.retries=0", energy]].concat());
        case.effects.advection = None;
        let flow = flow_of(&case).expect("a run");
        let Stop::Trouble { trouble, step } = &flow.outcome.stop else { panic!("{energy}: {}", flow.end()) };
        assert!(matches!(trouble, Trouble::Energy { .. }) && flow.is_finite(), "{energy}: {trouble}");
        *step
    };
    let (early, late) = (steps("guard.energy=2"), steps("guard.energy=1e6"));
    assert!(early < late, "{early}, {late}");
}

/// Rows that are far apart do not let it grow until numbers overflow.
#[test]
fn energy_is_looked_at_between_rows_too() {
    let keys = ["time.step=0.1", "time.end=100.0", "effects.viscosity.kinematic=0.1", "output.report_every=1000"];
    let mut case = cavity_of(16, &[&keys[..], &["guard.retries=0"]].concat());
    case.effects.advection = None;
    let flow = flow_of(&case).expect("a run");
    let Stop::Trouble { trouble: Trouble::Energy { found, .. }, step } = flow.outcome.stop else {
        panic!("{}", flow.end())
    };
    assert!(step == 50 && found.is_finite() && flow.is_finite(), "step {step}, {found}");
}

/// An engine that is gone after some steps, as a GPU that was pulled out.
struct Lost {
    inner: Box<dyn Engine>,
    left: u32,
}

impl Engine for Lost {
    fn info(&self) -> EngineInfo {
        self.inner.info()
    }

    fn write(&mut self, buffer: Buffer, data: &Data) -> Result<(), EngineError> {
        self.inner.write(buffer, data)
    }

    fn read(&mut self, buffer: Buffer) -> Result<Data, EngineError> {
        if self.left == 0 { Err(gone()) } else { self.inner.read(buffer) }
    }

    fn apply(&mut self, operation: Operation, clock: &Clock) -> Result<(), EngineError> {
        self.inner.apply(operation, clock)
    }

    fn advance(&mut self, steps: u32, clock: &Clock) -> Result<Advance, EngineError> {
        self.left = self.left.saturating_sub(steps);
        if self.left == 0 { Err(gone()) } else { self.inner.advance(steps, clock) }
    }

    fn solve_info(&self) -> SolveInfo {
        self.inner.solve_info()
    }

    fn measure(&mut self, elapsed: f64) -> Result<Measurement, EngineError> {
        self.inner.measure(elapsed)
    }
}

fn gone() -> EngineError {
    EngineError::Device("the device was lost: pulled out".to_owned())
}

#[test]
fn the_last_good_state_outlives_the_engine() {
    let scene = Arc::new(Scene::build(&cavity_of(16, &["output.report_every=10", "time.end=2.0"])).expect("a scene"));
    let mut engine = Lost { inner: cpu::double(&scene).expect("an engine"), left: 25 };
    let flow = flow_on(&scene, &mut engine).expect("a run");
    let Stop::Trouble { trouble: Trouble::Engine(error), .. } = &flow.outcome.stop else { panic!("{}", flow.end()) };
    assert_eq!((error, flow.outcome.state.progress.step, flow.rows.len()), (&gone(), 20, 2));
    assert!(flow.is_finite() && flow.outcome.snapshot.velocity.iter().any(|u| u.length() > 0.1));
}

/// Shares of a step: of what a row of diagnostics has of guards, and of points that move of all that is looked at. The least of
/// several times: other programs only add to them.
fn shares(scene: &Arc<Scene>) -> [f64; 2] {
    let mut engine = cpu::double(scene).expect("an engine");
    let clock = scene.clock(scene.case.time.step.unwrap_or(0.01));
    for &operation in scene.plan.setup.iter().chain(&scene.plan.kick) {
        engine.apply(operation, &clock).expect("an operation");
    }
    let mut state = State::read(scene, engine.as_mut(), &Progress::default()).expect("a state");
    let mut flags = motion::flags(scene);
    let mut least = [f64::INFINITY; 3];
    let mut timed = |which: usize, body: &mut dyn FnMut()| {
        let started = Instant::now();
        body();
        least[which] = least[which].min(started.elapsed().as_secs_f64());
    };
    for _ in 0..10 {
        timed(0, &mut || assert_eq!(engine.advance(10, &clock).expect("steps").trouble, None));
        timed(1, &mut || assert_eq!(state.renew(scene, engine.as_mut()).expect("a state"), None));
        timed(2, &mut || {
            if scene.plan.moves() {
                engine.read_all(&mut flags).expect("flags");
                let seen = motion::State::new(scene, &state.arrays, &flags);
                let row = motion::measure(scene, &seen, motion::watch(scene, &seen), 0, 0.0, 1.0);
                assert!(row.nearest[0] > 0.0);
            }
        });
    }
    [1, 2].map(|which| 10.0 * least[which] / least[0])
}

#[test]
fn the_guards_cost_less_than_three_hundredths_of_a_step() {
    let still = Arc::new(Scene::build(&cavity_of(48, &["cloud.arrangement=jittered"])).expect("a scene"));
    let every = f64::from(still.case.output.report_every);
    let [kept, _] = shares(&still);
    assert!(kept / every < 0.03, "{kept} of a step a row");
    // Measures and all.
    for (motion, changes) in MOTIONS {
        let moving = Arc::new(Scene::build(&column(&[changes, &["time.step=0.0005"]].concat())).expect("a scene"));
        let [kept, looked] = shares(&moving);
        assert!((kept + looked) / 10.0 < 0.03, "{motion}: {kept} and {looked} of a step a row");
    }
}

#[test]
fn a_step_too_short_to_get_anywhere_is_refused() {
    let refused = |changes: &[&str]| flow_of(&cavity_of(16, changes)).err().expect("a refusal");
    let said = refused(&["effects.viscosity.kinematic=1e300"]);
    assert!(
        said.starts_with("time.end = 1e0: steps of at most") && said.contains("(viscosity) make more than 1e9"),
        "{said}"
    );
    let said = refused(&["boundaries.top.velocity=[1e12, 0.0]"]);
    assert!(said.contains("(courant) make more than 1e9 of them"), "{said}");
}

#[test]
fn a_run_that_fails_ends_with_1_and_one_line_and_leaves_what_it_has() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let set = ["time.step=0.5", "time.end=40.0", "effects.viscosity.kinematic=0.1", "guard.retries=1"];
    let more: Vec<&str> = set.iter().flat_map(|key| ["--set", key]).collect();
    let output = run(folder.path(), "run", &more).output().expect("the command starts");
    let said = message(&output);
    assert_eq!((output.status.code(), said.lines().count()), (Some(1), 1), "{said}");
    for words in [
        "error: in or shortly before step ",
        ", with half the step too; kept: the state after step ",
        "; try a smaller",
    ] {
        assert!(said.contains(words), "{said:?} lacks {words:?}");
    }
    let out = folder.path().join("run");
    let left = result(&out);
    // Of letters that stand for numbers: those of points.vtu, which are the same numbers, may spell anything.
    let texts = left.iter().filter(|(path, _)| path.extension().is_some_and(|kind| kind == "csv"));
    let lost = |text: &[u8]| text.windows(3).any(|word| [&b"NaN"[..], b"inf"].contains(&word));
    assert_eq!(texts.filter(|(_, text)| !lost(text)).count(), 2, "diagnostics.csv and points.csv");
    // It fails in the same way when it is gone on with.
    let output = stillpoint(folder.path(), &["resume", "run", "--quiet"]).output().expect("the command starts");
    assert_eq!((output.status.code(), message(&output)), (Some(1), said));
    assert!(result(&out) == left);
}

#[test]
fn a_tolerance_that_is_large_beside_short_steps_is_doubted() {
    let warnings = |more: &[&str]| {
        let case = cavity_of(12, &[&["time.end=1e-5"], more].concat());
        flow_of(&case).expect("a flow").outcome.warnings
    };
    let creeping = "effects.viscosity.kinematic=1000.0";
    let said = warnings(&[creeping]);
    assert!(matches!(&said[..], [one] if one.starts_with("effects.pressure.tolerance = 1e-6 allows")), "{said:?}");
    let tried = said[0].rsplit_once("; try ").expect("a remedy").1;
    assert_eq!(warnings(&[creeping, &format!("effects.pressure.tolerance={tried}")]), [""; 0]);
    assert_eq!(warnings(&["time.end=0.1"]), [""; 0]);
}

#[test]
fn problems_without_time_have_no_guard() {
    let text = "title = \"P\"\ndomain = { width = 1.0, height = 1.0 }\nfluid = { density = 1.0 }\n\
                cloud = { arrangement = \"regular\", spacing = 0.1 }\nderivatives = { field = \"waves\" }\nguard = { retries = 1 }\n";
    let error = Case::from_text(text, std::path::Path::new("p.toml"), &[]).expect_err("a guard").to_string();
    assert!(error.contains("guard = { retries = 1 }: belongs to a flow"), "{error}");
}
