//! Checkpoint files: what was written is read back, and what was not is refused by name.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use stillpoint::case::Case;
use stillpoint::cpu;
use stillpoint::output::checkpoint::{self, Checkpoint};
use stillpoint::scene::Scene;
use stillpoint::simulation::{Motion, State, simulate};

use crate::cases::cavity_of;
use crate::columns::column;
use crate::folders::{SHIFTED, message, result, run, run_of, stillpoint};
use crate::random::Random;
use crate::resuming::Keeper;

/// A checkpoint of a run on 81 points, and what it holds.
pub fn written(path: &Path) -> (Arc<Scene>, State) {
    written_of(path, &cavity_of(8, &["cloud.arrangement=jittered", "time.end=0.5", "output.report_every=2"]))
}

/// The same of a column of 96 points that move.
pub fn written_of_moving(path: &Path) -> (Arc<Scene>, State) {
    written_of(path, &column(&["time.end=0.03", "output.report_every=2"]))
}

fn written_of(path: &Path, case: &Case) -> (Arc<Scene>, State) {
    let scene = Arc::new(Scene::build(case).expect("a scene"));
    let mut engine = cpu::single(&scene).expect("an engine");
    let mut keeper = Keeper::default();
    simulate(&scene, engine.as_mut(), &mut keeper).expect("a run");
    let state = keeper.states[1].clone();
    checkpoint::write(path, Path::new("a/case.toml"), case, &engine.info(), Some(7), &state).expect("a file");
    (scene, state)
}

fn refusal(bytes: &[u8]) -> String {
    match Checkpoint::decode(bytes, Path::new("run/checkpoint")) {
        Ok(_) => String::new(),
        Err(error) => error.to_string(),
    }
}

#[test]
fn what_was_written_is_read_back() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("checkpoint");
    let (scene, state) = written(&path);
    let checkpoint = Checkpoint::read(&path).expect("a checkpoint");
    let head = checkpoint.head.clone();
    assert_eq!((head.engine.as_str(), head.precision.as_str(), head.adapter), ("cpu", "f32", None));
    assert_eq!((head.case_path.as_path(), head.every), (Path::new("a/case.toml"), Some(7)));
    assert_eq!(checkpoint.case, scene.case);
    assert!(checkpoint.state(&scene, &path).expect("the state") == state);
    let left: Vec<_> = fs::read_dir(folder.path()).expect("a folder").collect();
    assert_eq!(left.len(), 1, "nothing half written is left");
    // A case of another size has other arrays.
    let other = Scene::build(&cavity_of(9, &[])).expect("a scene");
    let checkpoint = Checkpoint::read(&path).expect("a checkpoint");
    let error = checkpoint.state(&other, &path).expect_err("other arrays").to_string();
    assert!(error.ends_with("its arrays are not those that its case needs"), "{error}");
}

#[test]
fn every_length_and_every_altered_byte_is_refused_by_name() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("checkpoint");
    written(&path);
    let whole = fs::read(&path).expect("a file");
    assert_eq!(refusal(&whole), "");
    for length in 0..whole.len() {
        let said = refusal(&whole[..length]);
        let expected = if length == 0 { "not a checkpoint" } else { "cut short" };
        assert!(said.starts_with("run/checkpoint: ") && said.contains(expected), "{length} bytes: {said}");
    }
    let longer = [&whole[..], &[0]].concat();
    assert!(refusal(&longer).contains("cut short or added to"), "{}", refusal(&longer));
    let mut random = Random::new(3);
    for at in 0..whole.len() {
        let mut altered = whole.clone();
        altered[at] ^= 1 << ((random.number() + 1.0) * 4.0) as u32;
        let said = refusal(&altered);
        let expected: &[&str] = match at {
            0..8 => &["not a checkpoint of Stillpoint"],
            8..12 => &["from a newer Stillpoint", "not a checkpoint"],
            _ => &["altered", "cut short"],
        };
        assert!(
            said.starts_with("run/checkpoint: ") && expected.iter().any(|words| said.contains(words)),
            "{at}: {said}"
        );
    }
    let mut newer = whole.clone();
    newer[8] = 2;
    let expected = "run/checkpoint: a checkpoint of version 2, from a newer Stillpoint; this one reads version 1";
    assert_eq!(refusal(&newer), expected);
}

#[test]
fn numbers_that_are_none_are_refused() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("checkpoint");
    let (scene, mut state) = written(&path);
    let info = cpu::single(&scene).expect("an engine").info();
    let write = |state: &State| {
        checkpoint::write(&path, Path::new("c.toml"), &scene.case, &info, None, state).expect("a file");
        match Checkpoint::read(&path).and_then(|checkpoint| checkpoint.state(&scene, &path)) {
            Ok(_) => String::new(),
            Err(error) => error.to_string(),
        }
    };
    assert_eq!(write(&state), "");
    let good = state.clone();
    if let (_, stillpoint::engine::Data::Real(values)) = &mut state.arrays[0] {
        values[11] = f64::NAN;
    }
    assert!(write(&state).ends_with("velocity of point 5 is not finite"), "{}", write(&state));
    state = good;
    state.progress.dt = 0.0;
    assert!(write(&state).ends_with("cannot be used: its time step is none"), "{}", write(&state));
}

#[test]
fn how_a_motion_began_is_kept_and_belongs_to_points_that_move() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("checkpoint");
    let (scene, mut state) = written_of_moving(&path);
    let read = || Checkpoint::read(&path).and_then(|checkpoint| checkpoint.state(&scene, &path));
    assert!(read().expect("the state") == state);
    let motion = state.progress.motion.expect("a motion");
    assert!(motion.area > 0.0 && motion.energy > 0.0 && motion.frames == 1, "{motion:?}");
    let info = cpu::single(&scene).expect("an engine").info();
    let mut said = |motion: Option<Motion>| {
        state.progress.motion = motion;
        checkpoint::write(&path, Path::new("c.toml"), &scene.case, &info, None, &state).expect("a file");
        read().expect_err("no motion").to_string()
    };
    let none = said(Some(Motion { area: 0.0, ..motion }));
    assert!(none.ends_with("its first area or energy is none"), "{none}");
    assert!(said(None).ends_with("how its motion began does not go with its case"), "{}", said(None));
}

#[test]
fn frames_and_rows_that_a_checkpoint_counts_on_have_to_be_there() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let out = folder.path().join("run");
    let set = ["effects.advection.motion=lagrangian", "time.end=0.6"];
    let more: Vec<&str> = set.iter().flat_map(|key| ["--set", key]).collect();
    let output = run_of(&SHIFTED, folder.path(), "run", &more).output().expect("the command starts");
    let first = message(&output);
    assert!(first.contains("kept: the state after step"), "the paper's form comes to grief: {first}");
    let resume = || {
        let output = stillpoint(folder.path(), &["resume", "run", "--quiet"]).output().expect("the command starts");
        (output.status.code(), message(&output))
    };
    let left = result(&out);
    assert_eq!(resume(), (Some(1), first), "and does so again when it is gone on with");
    assert!(result(&out) == left);
    fs::remove_file(out.join("frames/0001.csv")).expect("a frame");
    let (code, said) = resume();
    let expected = "error: run/frames/times.csv, line 3: frame 1, which the checkpoint counts on, is not there";
    assert!(code == Some(2) && said.trim_end() == expected, "{said}");
    fs::write(out.join("motion.csv"), "step\n1\n").expect("a file");
    let (code, said) = resume();
    let expected = "error: run/motion.csv, line 1: not the header of a run's motion";
    assert!(code == Some(2) && said.trim_end() == expected, "{said}");
}

#[test]
fn a_run_without_a_checkpoint_and_one_that_is_spoiled_end_with_2_and_one_line() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let out = folder.path().join("run");
    let refused = |expected: &str| {
        let output = stillpoint(folder.path(), &["resume", "run"]).output().expect("the command starts");
        let said = message(&output);
        assert!(said.contains(expected) && said.lines().count() == 1, "{said:?}, not {expected:?}");
        assert_eq!(output.status.code(), Some(2), "{said}");
    };
    refused("error: run is not a folder");
    fs::create_dir(&out).expect("a folder");
    refused("error: run/checkpoint: no such file: the run kept no state to go on from");
    fs::write(out.join("checkpoint"), "a text").expect("a file");
    refused("error: run/checkpoint: not a checkpoint of Stillpoint");
    written(&out.join("checkpoint"));
    refused("error: run/diagnostics.csv: No such file");
    fs::write(out.join("diagnostics.csv"), "step\n1\n").expect("a file");
    refused("error: run/diagnostics.csv, line 1: not the header of a run's diagnostics");
    fs::remove_dir_all(&out).expect("a folder");
    let output = run(folder.path(), "run", &["--set", "time.end=0.5"]).output().expect("the command starts");
    assert!(output.status.success(), "{}", message(&output));
    refused("error: run: the run came to its end; there is nothing to go on with");
    // Nor does a second run write over the first.
    let before = result(&out);
    let output = run(folder.path(), "run", &[]).output().expect("the command starts");
    assert_eq!(output.status.code(), Some(2));
    assert!(message(&output).contains("has something in it already"), "{}", message(&output));
    assert!(result(&out) == before);
}
