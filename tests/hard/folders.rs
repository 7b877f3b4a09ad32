//! The command as a process, and what it leaves in a folder.

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

/// The cavity on few points: half a second of some hundred steps.
const CASE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/cases/cavity_re100_regular.toml");

/// The command, with nothing to print to.
pub fn stillpoint(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_stillpoint"));
    command.current_dir(folder).args(arguments).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped());
    command
}

/// `run` of the cavity into `out`, with a checkpoint after every row.
pub fn run(folder: &Path, out: &str, more: &[&str]) -> Command {
    let mut command = stillpoint(folder, &["run", CASE, "--out", out, "--engine", "cpu", "--quiet"]);
    let set = ["expect={}", "output.pictures=false", "cloud.spacing=0.0625", "cloud.arrangement=jittered"];
    set.iter().chain(&["output.report_every=5", "time.steady=1e-9"]).for_each(|key| {
        command.args(["--set", key]);
    });
    command.args(["--checkpoint-every", "5"]).args(more);
    command
}

pub fn message(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// What has to be the same however often a run was interrupted.
pub fn result(folder: &Path) -> Vec<Vec<u8>> {
    ["diagnostics.csv", "points.csv", "points.vtu"].map(|name| fs::read(folder.join(name)).expect(name)).to_vec()
}
