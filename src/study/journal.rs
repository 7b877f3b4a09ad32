//! runs.jsonl: every run of a study, on disk before the next begins, so that a study that was stopped goes on.

use std::fs::{File, OpenOptions};
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::{Machine, Run, Trial};
use crate::output::OutputError;

/// One line.
#[derive(Serialize, Deserialize)]
struct Entry {
    setting: Value,
    run: Run,
}

/// What has to be the same for a run to count: the whole setting, the program and the machine.
#[derive(Serialize)]
struct Identity<'a> {
    version: &'static str,
    machine: &'a Machine,
    #[serde(flatten)]
    trial: &'a Trial,
}

/// Appends to the file; a line that a kill cut off is dropped.
#[derive(Debug)]
pub struct Journal {
    path: PathBuf,
    file: File,
    identities: Vec<Value>,
    /// By trial, in the order they were made.
    runs: Vec<Vec<Run>>,
}

impl Journal {
    /// Opens the file, or makes it, and finds the runs of these trials in it.
    ///
    /// # Errors
    /// A line that is no run, other than the last; errors of the file system.
    pub fn open(path: &Path, trials: &[Trial], machine: &Machine) -> Result<Self, OutputError> {
        let options = OpenOptions::new().read(true).write(true).create(true).truncate(false).open(path);
        let mut file = options.map_err(OutputError::io(path))?;
        let mut text = Vec::new();
        file.read_to_end(&mut text).map_err(OutputError::io(path))?;
        // What stands behind the last end of a line is half a line.
        text.truncate(text.iter().rposition(|byte| *byte == b'\n').map_or(0, |end| end + 1));
        let cut = file.set_len(text.len() as u64).and_then(|()| file.seek(SeekFrom::End(0)));
        cut.map_err(OutputError::io(path))?;
        let identity = |trial| serde_json::to_value(Identity { version: env!("CARGO_PKG_VERSION"), machine, trial });
        let identities: Result<Vec<Value>, _> = trials.iter().map(identity).collect();
        let json = |source| OutputError::Json { path: path.to_owned(), source };
        let identities = identities.map_err(json)?;
        let mut runs = vec![Vec::new(); trials.len()];
        for (index, line) in text.split_inclusive(|byte| *byte == b'\n').enumerate() {
            let what = |error| format!("no run of a study: {error}; --fresh starts over");
            let wrong = |error| OutputError::Csv { path: path.to_owned(), line: index + 1, what: what(error) };
            let entry: Entry = serde_json::from_slice(line).map_err(wrong)?;
            if let Some(trial) = identities.iter().position(|known| *known == entry.setting) {
                runs[trial].push(entry.run);
            }
        }
        Ok(Self { path: path.to_owned(), file, identities, runs })
    }

    pub fn runs(&self) -> &[Vec<Run>] {
        &self.runs
    }

    /// Adds a run of a trial.
    ///
    /// # Errors
    /// Errors of the file system.
    pub fn append(&mut self, trial: usize, run: Run) -> Result<(), OutputError> {
        let entry = Entry { setting: self.identities[trial].clone(), run };
        let json = |source| OutputError::Json { path: self.path.clone(), source };
        let line = serde_json::to_string(&entry).map_err(json)? + "\n";
        // One write a run: a kill leaves at most the last line cut off.
        let written = self.file.write_all(line.as_bytes()).and_then(|()| self.file.flush());
        written.map_err(OutputError::io(&self.path))?;
        self.runs[trial].push(entry.run);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::super::tests::{good_run, study};
    use super::*;

    fn open(path: &Path, trials: &[Trial]) -> Result<Journal, OutputError> {
        Journal::open(path, trials, &Machine::here())
    }

    #[test]
    fn runs_are_found_again_by_their_whole_setting() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("runs.jsonl");
        let mut trials = study(2).trials;
        let mut journal = open(&path, &trials).expect("a new journal");
        journal.append(1, good_run(1.0 / 3.0)).expect("a line");
        journal.append(0, good_run(0.1)).expect("a line");
        let runs = [vec![good_run(0.1)], vec![good_run(1.0 / 3.0)]];
        assert_eq!(open(&path, &trials).expect("the same journal").runs(), runs);
        trials.reverse();
        assert_eq!(open(&path, &trials).expect("the same journal").runs(), [runs[1].clone(), runs[0].clone()]);
        trials[0].threads = 2;
        trials[1].case.time.courant = Some(0.25);
        assert_eq!(open(&path, &trials).expect("the same journal").runs(), [vec![], vec![]]);
        let other = Machine { cores: 999, ..Machine::here() };
        assert_eq!(Journal::open(&path, &study(2).trials, &other).expect("the same journal").runs(), [vec![], vec![]]);
    }

    #[test]
    fn a_line_cut_off_by_a_kill_is_dropped_and_its_run_made_again() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("runs.jsonl");
        let trials = study(1).trials;
        let mut journal = open(&path, &trials).expect("a new journal");
        journal.append(0, good_run(1.0)).expect("a line");
        journal.append(0, good_run(2.0)).expect("a line");
        let text = fs::read(&path).expect("the file");
        let first = text.iter().position(|byte| *byte == b'\n').expect("an end") + 1;
        for length in (first..text.len()).step_by(97).chain([text.len() - 1]) {
            fs::write(&path, &text[..length]).expect("a file");
            let mut journal = open(&path, &trials).expect("a cut journal");
            assert_eq!(journal.runs(), [vec![good_run(1.0)]], "cut at {length}");
            journal.append(0, good_run(2.0)).expect("a line");
            assert_eq!(fs::read(&path).expect("the file"), text, "cut at {length}");
        }
    }

    #[test]
    fn a_broken_line_is_named() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("runs.jsonl");
        fs::write(&path, "{}\n{}\n").expect("a file");
        let message = open(&path, &study(1).trials).expect_err("no journal").to_string();
        assert!(message.contains("runs.jsonl, line 1: no run of a study: missing field"), "{message}");
        assert!(message.ends_with("--fresh starts over"), "{message}");
    }
}
