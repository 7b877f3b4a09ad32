//! Finished runs of points that move, side by side: the same times in one picture, their courses in one plot.

use std::fs;
use std::path::{Path, PathBuf};

use crate::case::{Measure, Profile, ReferenceError};
use crate::motion::Row;
use crate::output::motion::Frames;
use crate::output::picture::{Film, draw_films};
use crate::output::{self, OutputError, RunFolder, Summary};

/// Why runs could not be compared. Each prints as one line.
#[derive(Debug, thiserror::Error)]
pub enum CompareError {
    #[error("{}: no finished run of points that move: {source}", path.display())]
    NotARun { path: PathBuf, source: OutputError },
    #[error("{}: has no frames; they are kept where output.frame_every is given", path.display())]
    NoFrames { path: PathBuf },
    #[error("{}: its domain is {found}, that of {} is {expected}; runs in one domain are compared", path.display(), first.display())]
    Domains { path: PathBuf, found: String, first: PathBuf, expected: String },
    #[error(transparent)]
    Reference(#[from] ReferenceError),
    #[error(transparent)]
    Output(#[from] OutputError),
}

/// What a run has left.
struct Run {
    summary: Summary,
    rows: Vec<Row>,
    frames: Frames,
    front: Option<Profile>,
}

impl Run {
    fn read(path: &Path) -> Result<Self, CompareError> {
        let read = || {
            let folder = RunFolder::open(path)?;
            let summary = Summary::read(&folder.summary())?;
            let rows = match summary.case.moves() {
                true => output::motion::read(&folder.motion())?,
                false => Vec::new(),
            };
            Ok((summary, rows, Frames::open(&folder.frames())?))
        };
        let (summary, rows, frames) =
            read().map_err(|source| CompareError::NotARun { path: path.to_owned(), source })?;
        if frames.count() == 0 {
            return Err(CompareError::NoFrames { path: path.to_owned() });
        }
        let front = summary.case.expect.values().find(|row| row.measure == Measure::Front);
        let front = front.and_then(|row| Some(Profile::read(row.profile.as_deref()?, row.column.as_deref())));
        Ok(Self { front: front.transpose()?, summary, rows, frames })
    }

    fn domain(&self) -> String {
        let domain = &self.summary.case.domain;
        format!("{} x {} m", domain.width, domain.height)
    }
}

/// Draws the runs into the folder `out`, which is made, and returns the pictures' paths.
///
/// # Errors
/// A folder that is no run with frames, runs in different domains, errors of the file system.
pub fn compare(paths: &[PathBuf], out: &Path) -> Result<Vec<PathBuf>, CompareError> {
    let runs = paths.iter().map(|path| Run::read(path)).collect::<Result<Vec<Run>, CompareError>>()?;
    for (run, path) in runs.iter().zip(paths) {
        if run.domain() != runs[0].domain() {
            let (found, expected) = (run.domain(), runs[0].domain());
            return Err(CompareError::Domains { path: path.clone(), found, first: paths[0].clone(), expected });
        }
    }
    let films: Vec<Film> = runs
        .iter()
        .map(|run| Film {
            case: &run.summary.case,
            time: run.summary.time,
            rows: &run.rows,
            frames: &run.frames,
            front: run.front.as_ref(),
        })
        .collect();
    fs::create_dir_all(out).map_err(OutputError::io(out))?;
    Ok(draw_films(out, &films, &names(paths))?)
}

/// The folders' names; their paths where two are called the same.
fn names(paths: &[PathBuf]) -> Vec<String> {
    let name = |path: &PathBuf| path.file_name().map(|name| name.to_string_lossy().into_owned());
    let alone = |path: &PathBuf| paths.iter().filter(|other| name(other) == name(path)).count() == 1;
    let shown = |path: &PathBuf| name(path).filter(|_| alone(path)).unwrap_or_else(|| path.display().to_string());
    paths.iter().map(shown).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_of_one_name_are_told_apart_by_their_paths() {
        let paths = ["a/x", "b/x", "b/y"].map(PathBuf::from);
        assert_eq!(names(&paths), ["a/x", "b/x", "y"]);
    }
}
