//! The command as a process: what it prints where, its exit codes, and that bad input leaves nothing behind.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

const CASE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/cases/cavity_re100_regular.toml");

fn stillpoint(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_stillpoint"));
    command.current_dir(folder).args(arguments).output().expect("the command starts")
}

fn empty_folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("UTF-8")
}

#[test]
fn check_says_what_the_case_is_and_how_large() {
    let folder = empty_folder();
    let output = stillpoint(folder.path(), &["check", CASE]);
    assert_eq!((output.status.code(), text(&output.stderr)), (Some(0), String::new()));
    assert_eq!(text(&output.stdout), "ok: Lid-driven cavity, Re 100, regular points, about 4225 points\n");
    let output = stillpoint(folder.path(), &["check", CASE, "--set", "cloud.spacing=0.0625", "--set", "title=Coarse"]);
    assert_eq!(text(&output.stdout), "ok: Coarse, about 289 points\n");
}

#[test]
fn bad_input_exits_with_2_and_one_line_and_writes_nothing() {
    let folder = empty_folder();
    fs::write(folder.path().join("bad.toml"), "title = \"x\"\nwidht = 1\n").expect("a file");
    for (arguments, expected) in [
        (&["check", "none.toml"][..], "error: none.toml: no such file\n"),
        (&["check", "."], "error: .: a folder, where a file was expected\n"),
        (&["check", "bad.toml"], "error: bad.toml:2: widht is not a key; a case file has title, domain, cloud, fluid,"),
        (&["run", "bad.toml"], "error: bad.toml:2: widht is not a key"),
        (&["plan", "bad.toml"], "error: bad.toml:2: widht is not a key"),
        (&["run", CASE, "--set", "cloud.spacing=nan"], "error: --set cloud.spacing=nan: cloud.spacing = NaN: must be"),
        (&["run", CASE, "--out", "bad.toml"], "error: bad.toml: not a folder"),
        (&["run", CASE, "--out", "."], "error: .: has something in it already; give another --out, or --force"),
    ] {
        let output = stillpoint(folder.path(), arguments);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
        assert!(message.starts_with(expected), "{arguments:?} says {message:?}, not {expected:?}");
        assert_eq!((message.lines().count(), output.stdout.len()), (1, 0), "{message:?}");
    }
    let left: Vec<_> = fs::read_dir(folder.path()).expect("the folder").collect();
    assert_eq!(left.len(), 1, "{left:?}");
}

#[test]
fn a_wrong_command_line_exits_with_2_and_says_what_would_be_right() {
    let folder = empty_folder();
    for (arguments, expected) in [
        (&[][..], "Usage: stillpoint"),
        (&["walk"], "unrecognized subcommand 'walk'"),
        (&["run"], "<CASE>"),
        (&["run", CASE, "--engine", "fpga"], "[possible values: auto, cpu, gpu]"),
        (&["check", CASE, "--sett", "a=1"], "a similar argument exists: '--set'"),
    ] {
        let output = stillpoint(folder.path(), arguments);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
        assert!(message.contains(expected), "{arguments:?} says {message:?}, which lacks {expected:?}");
    }
    assert_eq!(stillpoint(folder.path(), &["--version"]).status.code(), Some(0));
}

/// `plan --measure` prices every operation of a step and every effect, and its rows add up.
#[test]
fn plan_measures_what_a_step_costs() {
    let case = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/heated_cavity_ra1e4.toml");
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_stillpoint"))
        .args(["plan", &case.to_string_lossy(), "--measure", "--set", "cloud.spacing=0.0625"])
        .output()
        .expect("the program starts");
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let micro = |name: &str| -> f64 {
        // Effects stand below the operations, some of which begin alike.
        let mut rows = text.lines().rev().filter(|line| line.ends_with('%'));
        let row = rows.find_map(|line| line.trim().strip_prefix(name));
        let row = row.unwrap_or_else(|| panic!("no row {name} in\n{text}"));
        row.split_whitespace().next().and_then(|cell| cell.parse().ok()).expect("a number")
    };
    let effects = ["advection", "heat", "gravity", "buoyancy", "viscosity", "pressure", "step"]
        .map(|name| micro(&format!("{name} ")));
    let (all, step) = (micro("all operations"), micro("a step"));
    assert!(effects.iter().all(|&price| price > 0.0), "{text}");
    assert!(all > 0.85 * step && all < 1.15 * step, "{text}");
}

#[test]
fn runs_that_cannot_be_compared_exit_with_2_and_one_line_and_leave_no_pictures() {
    let folder = empty_folder();
    let dam = concat!(env!("CARGO_MANIFEST_DIR"), "/cases/dam_break_shifted.toml");
    let still = ["--set", "cloud.spacing=0.125", "--set", "time.end=0.1", "--set", "method.radius=2.8"];
    let moving = ["--engine", "cpu", "--set", "time.end=0.01", "--set", "output.pictures=false", "--set", "expect={}"];
    let run = |case: &str, out: &str, rest: &[&str]| {
        let code = stillpoint(folder.path(), &[&["run", case, "--out", out, "--quiet"], rest].concat()).status.code();
        assert!(matches!(code, Some(0 | 1)), "{case}: {code:?}");
    };
    run(CASE, "still", &still);
    run(dam, "dam", &moving);
    run(dam, "wide", &[&moving[..], &["--set", "domain.width=0.34290"]].concat());
    for (second, expected) in [
        ("still", "error: still: has no frames; they are kept where output.frame_every is given\n"),
        ("none", "error: none: no finished run of points that move: "),
        (
            "wide",
            "error: wide: its domain is 0.3429 x 0.17145 m, that of dam is 0.28575 x 0.17145 m; runs in one domain",
        ),
    ] {
        let output = stillpoint(folder.path(), &["compare", "dam", second, "--out", "compared"]);
        let message = text(&output.stderr);
        assert_eq!((output.status.code(), message.lines().count()), (Some(2), 1), "{message}");
        assert!(message.starts_with(expected), "{second} says {message:?}, not {expected:?}");
        assert!(!folder.path().join("compared").exists());
    }
}

#[test]
fn lost_points_have_a_file_and_a_line() {
    let folder = empty_folder();
    let tank = concat!(env!("CARGO_MANIFEST_DIR"), "/cases/hydrostatic_mps.toml");
    let run = |out: &str, rest: &[&str]| {
        let short =
            ["--engine", "cpu", "--set", "time.end=0.002", "--set", "output.pictures=false", "--set", "expect={}"];
        let output = stillpoint(folder.path(), &[&["run", tank, "--out", out], &short[..], rest].concat());
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        text(&output.stdout)
    };
    assert!(!run("rest", &[]).contains("left the domain") && !folder.path().join("rest/lost.csv").exists());
    let told =
        run("turn", &["--set", "initial.rotation=48", "--set", "time.end=0.001", "--set", "output.report_every=1"]);
    let table = fs::read_to_string(folder.path().join("turn/lost.csv")).expect("lost.csv");
    let mut rows = table.lines();
    assert_eq!(rows.next(), Some("point,step,time,x,y"));
    let first = rows.next().and_then(|row| row.split_once(',')).expect("a row").0;
    let line = format!(
        "{} points left the domain, the first of them point {first}, seen outside after step 1",
        1 + rows.count()
    );
    assert!(told.contains(&line), "{told:?} lacks {line:?}");
}
