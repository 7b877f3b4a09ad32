//! The command as a process, and what it leaves in a folder.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use crate::ROOT;

/// A shipped case on few points: half a second of some hundred steps.
pub struct Small {
    name: &'static str,
    set: &'static [&'static str],
}

pub const CAVITY: Small = Small {
    name: "cavity_re100_regular.toml",
    set: &["cloud.spacing=0.0625", "cloud.arrangement=jittered", "time.steady=1e-9"],
};

/// Points that move, with frames and a sensor.
pub const SHIFTED: Small = Small {
    name: "dam_break_shifted.toml",
    set: &["cloud.spacing=0.005715", "time.courant=0.05", "time.end=0.15", SENSOR],
};
pub const MPS: Small = Small { name: "dam_break_mps.toml", set: &["cloud.spacing=0.005715", "time.end=0.3", SENSOR] };

const SENSOR: &str = "output.sensors.foot={ at = [0.03, 0.0] }";

/// The command, with nothing to print to.
pub fn stillpoint(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_stillpoint"));
    command.current_dir(folder).args(arguments).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped());
    command
}

/// `run` of the cavity into `out`, with a checkpoint after every row.
pub fn run(folder: &Path, out: &str, more: &[&str]) -> Command {
    run_of(&CAVITY, folder, out, more)
}

/// `run` of a case into `out`, with a checkpoint after every row.
pub fn run_of(small: &Small, folder: &Path, out: &str, more: &[&str]) -> Command {
    let case = Path::new(ROOT).join("cases").join(small.name);
    let mut command = stillpoint(folder, &["run", &case.to_string_lossy(), "--out", out, "--engine", "cpu", "--quiet"]);
    let set = ["expect={}", "output.pictures=false", "output.report_every=5"];
    set.iter().chain(small.set).for_each(|key| {
        command.args(["--set", key]);
    });
    command.args(["--checkpoint-every", "5"]).args(more);
    command
}

pub fn message(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// What has to be the same however often a run was interrupted: every number, and every picture.
pub fn result(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let names = |folder: &Path| fs::read_dir(folder).into_iter().flatten().map(|entry| entry.expect("an entry").path());
    let mut paths: Vec<PathBuf> = names(folder).chain(names(&folder.join("frames"))).collect();
    paths.retain(|path| path.is_file() && !["summary.json", "checkpoint"].iter().any(|name| path.ends_with(name)));
    paths.sort();
    assert!(paths.iter().any(|path| path.ends_with("diagnostics.csv")), "{paths:?}");
    let read =
        |path: PathBuf| (path.strip_prefix(folder).expect("a file in it").to_owned(), fs::read(&path).expect("a file"));
    paths.into_iter().map(read).collect()
}
