//! One mistake a row, and the words that a user gets for it.

use std::fs;

use super::{edited, folder, stillpoint, text};

/// What stands in the good study, what takes its place, and the whole message.
#[rustfmt::skip]
const MISTAKES: &[(&str, &str, &str)] = &[
    // TOML and the study's own keys.
    ("[set]", "[set", "study.toml:5: not valid TOML: unclosed table, expected `]`"),
    ("repeats = 1", "repeat = 1", "study.toml:4: repeat is not a key (did you mean repeats?); a study file has title, case, error, seconds, targets, along, repeats, repeat_below, most_runs, set, vary, grid"),
    ("title = \"Cavity\"", "title = \"\"", "study.toml:1: title = \"\": must be one line of text that names the study"),
    ("repeats = 1", "repeats = 0", "study.toml:4: repeats = 0: must be a whole number from 1 to 1000"),
    ("repeats = 1", "repeats = \"two\"", "study.toml:4: repeats = \"two\": must be a whole number from 1 to 1000"),
    ("repeats = 1", "repeat_below = -1", "study.toml:4: repeat_below = -1: must be a time from 0, s"),
    ("repeats = 1", "targets = [0.1, 0]", "study.toml:4: targets = [0.1, 0]: must be a list of numbers above 0, relative errors"),
    ("repeats = 1", "seconds = \"user\"", "study.toml:4: seconds = \"user\": must be \"cpu\", \"wall\" or \"engine\""),
    ("repeats = 1", "along = \"time.courant\"", "study.toml:4: along = \"time.courant\": must be a key that is varied: cloud.spacing, precision"),
    ("repeats = 1", "most_runs = 11", "study.toml:4: most_runs = 11: the study asks for 16 runs: 4 settings, each run once to warm up and 3 times to be timed; vary less, or raise it"),
    ("error = \"u_min\"\n", "", "study.toml: error is missing: it must be the NAME of an [expect.NAME] of the case"),
    ("[vary]\ncloud.spacing = [0.125, 0.0625]\nprecision = [\"f32\", \"f64\"]\n", "", "study.toml: vary is missing: it must be a table of keys as in [set], each with a list of values"),
    // The case and what it expects.
    ("cases/cavity_re100_regular.toml", "cases/none.toml", "study.toml:2: case = \"cases/none.toml\": cases/none.toml: no such file"),
    ("cases/cavity_re100_regular.toml", "a\\nb.toml", "study.toml:2: case = \"a\\nb.toml\": a\\nb.toml: no such file"),
    ("case = \"cases/cavity_re100_regular.toml\"\n", "", "study.toml: case is missing: it must be the path of a case file, from the study file's folder"),
    ("\"u_min\"", "\"u_mn\"", "study.toml:3: error = \"u_mn\": cases/cavity_re100_regular.toml has no [expect.u_mn] (did you mean u_min?); it has u_ghia, u_min, u_profile, v_ghia, v_max, v_min, v_profile"),
    // What is set and varied.
    ("time.end = 0.5", "time.ende = 0.5", "study.toml:6: time.ende is not a key (did you mean time.end?); [time] has end, courant, step, steady, splitting"),
    ("time.end = 0.5", "time.end = -1", "study.toml:6: time.end = -1: must be a time above 0, s"),
    ("time.end = 0.5", "enigne = \"cpu\"", "study.toml:6: enigne = \"cpu\": no such key (did you mean engine?); there are engine, precision, adapter, threads, and those in the tables of a case"),
    ("time.end = 0.5", "engine = \"fpga\"", "study.toml:6: engine = \"fpga\": must be \"cpu\" or \"gpu\""),
    ("time.end = 0.5", "threads = 0", "study.toml:6: threads = 0: must be a whole number from 1 to 1024"),
    ("time.end = 0.5", "adapter = \"X\"", "study.toml:6: adapter = \"X\": names a GPU, and engine is \"cpu\"; leave it out"),
    ("cloud.spacing = [0.125, 0.0625]", "cloud.spacing = 0.125", "study.toml:9: vary.cloud.spacing = 0.125: must be a list of values, or of tables { label = TEXT, KEY = VALUE, ... }"),
    ("cloud.spacing = [0.125, 0.0625]", "cloud.spacing = []", "study.toml:9: vary.cloud.spacing = []: must be a list of values, or of tables { label = TEXT, KEY = VALUE, ... }"),
    ("cloud.spacing = [0.125, 0.0625]", "cloud.spacing = [\n0.125,\n0.07]", "study.toml:11: cloud.spacing = 0.07: must divide both sides of the domain, 1 x 1 m; the nearest spacing that does is 0.07142857142857142"),
    ("[0.125, 0.0625]", "[0.125, \"fine\"]", "study.toml:9: cloud.spacing = \"fine\": must be a length above 0, m"),
    ("\"f64\"]", "\"f16\"]", "study.toml:10: precision = \"f16\": must be \"f32\" or \"f64\""),
    ("precision =", "precison =", "study.toml:10: precison = \"f32\": no such key (did you mean precision?); there are engine, precision, adapter, threads, and those in the tables of a case"),
    ("precision = [\"f32\", \"f64\"]", "ways = [{ time.courant = 0.4 }]", "study.toml:10: vary.ways[0] = { time = { courant = 0.4 } }: a table of keys needs a label, one line of text that names the choice"),
    ("precision = [\"f32\", \"f64\"]", "ways = [{ label = 3 }]", "study.toml:10: vary.ways[0].label = 3: must be one line of text that names the choice"),
    ("precision = [\"f32\", \"f64\"]", "ways = [{ label = \"a\", cloud.spacing = 0.25 }]", "study.toml:9: cloud.spacing = 0.125: is varied by ways and by cloud.spacing"),
    ("precision = [\"f32\", \"f64\"]", "method.radius = [1.6]", "study.toml: with radius 1.6, 1/8: method.radius = 1.6: point 49 at (0, 0) m has 3 neighbours; allowed: a radius that gives every point 5"),
    ("time.end = 0.5", "domain.periodic = \"y\"", "study.toml: with f32, 1/8: cases/cavity_re100_regular.toml:17: boundaries.top.velocity = [1.0, 0.0]: the domain repeats along y (domain.periodic), so that there is no wall; leave it out"),
    // Grids.
    ("[set]", "[[grid]]\nlabl = \"a\"\n[set]", "study.toml:6: grid[0].labl is not a key (did you mean grid[0].label?); [grid[0]] has label, case, error, along, set, vary"),
    ("[set]", "[[grid]]\ncase = \"none.toml\"\n[set]", "study.toml:6: grid[0].case = \"none.toml\": none.toml: no such file"),
    ("[set]", "[[grid]]\n[[grid]]\nalong = \"threads\"\n[set]", "study.toml:7: grid[1].along = \"threads\": must be a key that is varied: cloud.spacing, precision"),
    ("[set]", "[[grid]]\nlabel = \" \"\n[set]", "study.toml:6: grid[0].label = \" \": must be one line of text that names the grid"),
];

#[test]
fn every_mistake_is_named_before_anything_runs() {
    let folder = folder("");
    let study = folder.path().join("study.toml");
    let before = fs::read_dir(folder.path()).expect("the folder").count();
    for (from, to, expected) in MISTAKES {
        fs::write(&study, edited(from, to)).expect("a file");
        let output = stillpoint(folder.path(), &["cost", "study.toml", "--out", "out"]);
        assert_eq!(text(&output.stderr), format!("error: {expected}\n"), "{to:?}");
        assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0), "{to:?}");
    }
    let after = fs::read_dir(folder.path()).expect("the folder").count();
    assert_eq!(before, after, "something was written");
}

#[test]
fn a_gpu_that_is_not_there_is_named() {
    let folder = folder(&edited("time.end = 0.5", "engine = \"gpu\"\nadapter = \"no such card\""));
    let output = stillpoint(folder.path(), &["cost", "study.toml", "--out", "out"]);
    let message = text(&output.stderr);
    assert!(message.starts_with("error: study.toml:7: adapter = \"no such card\": no GPU adapter "), "{message}");
    assert_eq!((output.status.code(), message.lines().count()), (Some(2), 1));
    assert!(!folder.path().join("out").exists());
}

#[test]
fn a_folder_with_something_else_in_it_is_left_alone() {
    let folder = folder(super::GOOD);
    let output = stillpoint(folder.path(), &["cost", "study.toml", "--out", "cases"]);
    assert_eq!(text(&output.stderr), "error: cases: has something in it already and no study; give another --out\n");
    assert_eq!(output.status.code(), Some(2));
    let output = stillpoint(folder.path(), &["cost", "study.toml", "--set", "repeats=none"]);
    let expected = "error: --set repeats=none: repeats = \"none\": must be a whole number from 1 to 1000\n";
    assert_eq!((text(&output.stderr).as_str(), output.status.code()), (expected, Some(2)));
    assert!(!folder.path().join("runs").exists());
}
