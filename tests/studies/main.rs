//! Studies as a process: what each mistake says before anything runs, and what a whole study leaves.

mod mistakes;
mod whole;

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

/// A right study of a right case; each test below spoils or changes one thing of it.
const GOOD: &str = r#"title = "Cavity"
case = "cases/cavity_re100_regular.toml"
error = "u_min"
repeats = 1
[set]
time.end = 0.5
output.pictures = false
[vary]
cloud.spacing = [0.125, 0.0625]
precision = ["f32", "f64"]
"#;

/// A folder with the shipped cases and this study, `study.toml`.
fn folder(study: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for from in ["cases", "cases/reference", "cases/studies"] {
        fs::create_dir_all(folder.path().join(from)).expect("a folder");
        for entry in fs::read_dir(root.join(from)).expect("the shipped cases") {
            let path = entry.expect("an entry").path();
            if let (true, Some(name)) = (path.is_file(), path.file_name()) {
                fs::copy(&path, folder.path().join(from).join(name)).expect("a copy");
            }
        }
    }
    fs::write(folder.path().join("study.toml"), study).expect("a file");
    folder
}

fn stillpoint(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_stillpoint"));
    // Drivers complain on standard error where they have no folder of their own.
    command.current_dir(folder).env("XDG_RUNTIME_DIR", folder).args(arguments).output().expect("the command starts")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).expect("UTF-8")
}

fn edited(from: &str, to: &str) -> String {
    assert_eq!(GOOD.matches(from).count(), 1, "{from:?} is to stand in the good study once");
    GOOD.replace(from, to)
}
