//! Runs that are killed in the middle of whatever they do, and gone on with: nothing is lost, and nothing differs.

use std::fs;
use std::path::Path;
use std::thread::sleep;
use std::time::Instant;

use crate::folders::{CAVITY, MPS, SHIFTED, Small, message, result, run_of, stillpoint};
use crate::random::Random;

/// Of the cavity.
const LONG: &[&str] = &["--set", "time.end=30.0"];

/// Kills a run `kills` times in a row at random moments, each time another process that went on with it, until it is done,
/// and again from the beginning; compares what is left with a run that was left alone.
fn kill(small: &Small, more: &[&str], kills: usize, seed: u64) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let started = Instant::now();
    let output = run_of(small, folder.path(), "whole", more).output().expect("the command starts");
    assert!(output.status.success(), "{}", message(&output));
    let length = started.elapsed();
    let expected = result(&folder.path().join("whole"));
    let mut random = Random::new(seed);
    let (mut done, mut ends, mut longest) = (0, 0, 0);
    while done < kills {
        let mut in_a_row = 0;
        let out = folder.path().join("killed");
        loop {
            let begun = out.join("checkpoint").exists();
            let mut command = match begun {
                true => stillpoint(folder.path(), &["resume", "killed", "--quiet"]),
                false => run_of(small, folder.path(), "killed", &[more, &["--force"]].concat()),
            };
            let mut process = command.spawn().expect("the command starts");
            if done < kills {
                sleep(length.mul_f64(0.3 * (random.number() + 1.0)));
                // A process that is over already is not killed.
                if process.try_wait().expect("a process").is_none() {
                    process.kill().expect("a process");
                    process.wait().expect("an end");
                    (done, in_a_row) = (done + 1, in_a_row + 1);
                    check(&out);
                    continue;
                }
            }
            let output = process.wait_with_output().expect("an end");
            let message = message(&output);
            // A kill behind the end of the run, when its checkpoint was gone, left nothing to do but its last lines.
            assert!(output.status.success() || message.contains("came to its end"), "{message}");
            break;
        }
        assert!(result(&out) == expected, "after {in_a_row} kills something differs");
        assert!(!out.join("checkpoint").exists(), "the checkpoint of a run that is over is gone");
        (ends, longest) = (ends + 1, longest.max(in_a_row));
        fs::remove_dir_all(&out).expect("a folder");
    }
    println!("{done} kills, {ends} runs came to their end, one of them after {longest} kills: the same bits each time");
}

/// Whatever there is after a kill is whole.
fn check(out: &Path) {
    for name in ["diagnostics.csv", "motion.csv", "frames/times.csv"] {
        if let Ok(rows) = fs::read_to_string(out.join(name)) {
            assert!(rows.is_empty() || rows.ends_with('\n'), "half a row");
            assert!(!rows.contains("NaN") && !rows.contains("inf"), "{rows}");
        }
    }
}

#[test]
fn a_killed_run_goes_on_to_the_same_bits() {
    kill(&CAVITY, LONG, 8, 1);
}

#[test]
fn killed_runs_of_points_that_move_go_on_to_the_same_bits() {
    kill(&SHIFTED, &[], 4, 3);
    kill(&MPS, &[], 2, 4);
}

#[test]
#[ignore = "some minutes"]
fn two_hundred_kills() {
    kill(&CAVITY, LONG, 200, 2);
}

#[test]
#[ignore = "some minutes"]
fn a_hundred_kills_of_points_that_move() {
    kill(&SHIFTED, &[], 50, 5);
    kill(&MPS, &[], 50, 6);
}
