//! Whole studies: what they leave, that they go on where they were stopped, and that a run that fails is a row.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use stillpoint::study::Study;

use super::{GOOD, edited, folder, stillpoint, text};

/// The rows of a cost.csv by the names of its columns; none of its cells holds a comma.
fn rows(folder: &Path) -> Vec<BTreeMap<String, String>> {
    let table = fs::read_to_string(folder.join("cost.csv")).expect("cost.csv");
    let mut lines = table.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
    let header = lines.next().expect("a header");
    lines.map(|row| header.iter().cloned().zip(row).collect()).collect()
}

fn number(row: &BTreeMap<String, String>, column: &str) -> f64 {
    row[column].parse().unwrap_or_else(|_| panic!("{column} is {:?}", row[column]))
}

fn runs(folder: &Path) -> usize {
    fs::read_to_string(folder.join("runs.jsonl")).expect("the journal").lines().count()
}

#[test]
fn every_shipped_study_loads_and_the_cavity_asks_for_forty_settings_and_more() {
    let studies = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/studies");
    let mut count = 0;
    for entry in fs::read_dir(studies).expect("the folder of studies") {
        let path = entry.expect("an entry").path();
        let study = Study::load(&path, &[]).unwrap_or_else(|error| panic!("{error}"));
        assert!(!path.ends_with("cavity.toml") || study.trials.len() >= 40, "{} settings", study.trials.len());
        count += 1;
    }
    assert!(count >= 2, "{count} studies");
}

#[test]
fn the_smoke_study_leaves_its_tables_and_its_picture() {
    let folder = folder("");
    let output = stillpoint(folder.path(), &["cost", "cases/studies/smoke.toml"]);
    assert_eq!((output.status.code(), text(&output.stderr)), (Some(0), String::new()));
    assert!(text(&output.stdout).ends_with("written to runs/smoke\n"), "{}", text(&output.stdout));
    let study = folder.path().join("runs/smoke");
    let rows = rows(&study);
    assert_eq!(rows.len(), 12);
    for row in &rows {
        let columns = ["error", "cpu_s", "wall_s", "setup_s", "stepping_s", "solve_s", "operations_s", "reading_s"];
        assert!(columns.iter().all(|column| number(row, column).is_finite() && number(row, column) > 0.0), "{row:?}");
        let parts: f64 = ["solve_s", "operations_s", "reading_s"].iter().map(|part| number(row, part)).sum();
        assert!(parts <= 1.001 * number(row, "stepping_s"), "{row:?}");
        assert!(number(row, "wall_least_s") <= number(row, "wall_s"), "{row:?}");
        assert!(number(row, "wall_s") <= number(row, "wall_most_s"), "{row:?}");
        assert_eq!((row["runs"].as_str(), row["status"].as_str()), ("2", "steady"));
    }
    let points: Vec<f64> = rows.iter().map(|row| number(row, "points")).collect();
    assert_eq!(points[..3], [81.0, 169.0, 289.0]);
    let (coarse, fine) = (number(&rows[0], "error"), number(&rows[2], "error"));
    assert!(fine < coarse, "{fine} with fine points, {coarse} with coarse ones");
    let words = fs::read_to_string(study.join("cost.md")).expect("cost.md");
    assert!(words.contains("cargo run --release -- cost cases/studies/smoke.toml\n"), "{words}");

    let drawn = fs::read(study.join("cost.png")).expect("cost.png");
    fs::remove_file(study.join("cost.png")).expect("there was one");
    let output = stillpoint(folder.path(), &["render", "runs/smoke"]);
    assert_eq!(text(&output.stdout), "runs/smoke/cost.md\nruns/smoke/cost.png\n");
    assert_eq!(fs::read(study.join("cost.png")).expect("cost.png"), drawn, "the same picture");
    assert_eq!(fs::read_to_string(study.join("cost.md")).expect("cost.md"), words);
}

#[test]
fn a_study_goes_on_where_it_was_stopped_and_starts_over_when_asked() {
    let folder = folder(GOOD);
    let out = folder.path().join("runs/study");
    let cost = |more: &[&str]| {
        let output = stillpoint(folder.path(), &[&["cost", "study.toml"], more].concat());
        assert_eq!((output.status.code(), text(&output.stderr)), (Some(0), String::new()));
        fs::read_to_string(out.join("runs.jsonl")).expect("the journal")
    };
    let whole = cost(&[]);
    assert_eq!(runs(&out), 8, "4 settings, each to warm up and once timed");
    let table = fs::read_to_string(out.join("cost.csv")).expect("cost.csv");
    assert_eq!(cost(&[]), whole, "nothing is run again");
    assert_eq!(fs::read_to_string(out.join("cost.csv")).expect("cost.csv"), table);

    // As a kill leaves it: two runs short, and the next one cut off.
    let ends: Vec<usize> = whole.match_indices('\n').map(|(end, _)| end + 1).collect();
    fs::write(out.join("runs.jsonl"), &whole[..ends[5] + 40]).expect("a file");
    let again = cost(&[]);
    assert_eq!((again[..ends[5]] == whole[..ends[5]], runs(&out)), (true, 8));

    let more = cost(&["--set", "repeats=2"]);
    assert_eq!((more.starts_with(&again), runs(&out)), (true, 12));
    let fresh = cost(&["--fresh"]);
    assert!(runs(&out) == 8 && !fresh.starts_with(&again), "all is run again");
}

#[test]
fn a_setting_that_fails_is_a_row_and_not_the_end() {
    let ways = "ways = [\n\
        { label = \"good\" },\n\
        { label = \"diverging\", fluid.density = 1e300, effects.viscosity.kinematic = 1e5, time.step = 0.05 },\n\
        { label = \"clustering\", time.step = 0.05, time.courant = 1, effects.advection.remap = \"forward\", boundaries.top.velocity = [3.0, 0.0] },\n]";
    let folder = folder(&edited("precision = [\"f32\", \"f64\"]", ways).replace("[0.125, 0.0625]", "[0.125]"));
    let output = stillpoint(folder.path(), &["cost", "study.toml"]);
    assert_eq!((output.status.code(), text(&output.stderr)), (Some(0), String::new()));
    assert!(text(&output.stdout).contains("3 settings in "), "{}", text(&output.stdout));
    assert!(text(&output.stdout).contains(", 2 without an error\n"), "{}", text(&output.stdout));
    let rows = rows(&folder.path().join("runs/study"));
    let said: Vec<(&str, bool)> = rows.iter().map(|row| (row["status"].as_str(), row["error"].is_empty())).collect();
    assert_eq!(said[0], ("to the end", false));
    assert!(said[1].0.starts_with("diverged after t = ") && said[1].1, "{said:?}");
    assert!(said[2].0.starts_with("failed: time.step = 0.05: at 3 m/s points move") && said[2].1, "{said:?}");
}

#[test]
fn settings_that_grids_share_are_run_once() {
    let grids = "[[grid]]\nlabel = \"one\"\nset.precision = \"f32\"\n[[grid]]\nlabel = \"two\"\nvary.time.courant = [0.8]\n[set]";
    let folder = folder(&edited("[set]", grids).replace("[0.125, 0.0625]", "[0.125]"));
    let output = stillpoint(folder.path(), &["cost", "study.toml"]);
    assert_eq!((output.status.code(), text(&output.stderr)), (Some(0), String::new()));
    let out = folder.path().join("runs/study");
    // f32; f32 and f64 at the courant number that the case has anyway.
    assert_eq!((rows(&out).len(), runs(&out)), (3, 2 * 2));
}

#[test]
fn a_problem_without_time_can_be_studied() {
    let study = "title = \"Poisson\"\ncase = \"case.toml\"\nerror = \"p_min\"\nrepeats = 1\n[vary]\n\
        cloud.spacing = [0.1, 0.05]\neffects.pressure.solver = [\"conjugate_gradient\", \"direct\"]\n";
    let folder = folder(study);
    let case = fs::read_to_string(folder.path().join("cases/poisson.toml")).expect("a shipped case");
    let expected = "\n[expect.p_min]\ncomponent = \"p\"\nline = { x = 0.0 }\nmeasure = \"minimum\"\nvalue = -1.0\n\
        tolerance = 0.1\nsource = \"the known field\"\n";
    fs::write(folder.path().join("case.toml"), case + expected).expect("a file");
    let output = stillpoint(folder.path(), &["cost", "study.toml"]);
    assert_eq!((output.status.code(), text(&output.stderr)), (Some(0), String::new()));
    let rows = rows(&folder.path().join("runs/study"));
    assert_eq!(rows.len(), 4);
    for row in &rows {
        assert_eq!(row["status"], "to the end");
        assert!(["error", "solve_s", "setup_s", "reading_s"].iter().all(|part| number(row, part) > 0.0), "{row:?}");
    }
    for pair in rows.chunks(2) {
        let (coarse, fine) = (number(&pair[0], "error"), number(&pair[1], "error"));
        assert!(fine < 0.5 * coarse, "{fine} with fine points, {coarse} with coarse ones");
    }
}
