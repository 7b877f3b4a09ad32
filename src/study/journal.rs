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
