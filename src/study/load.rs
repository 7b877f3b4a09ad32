//! From a study file to its settings, all of them checked before any is run.

use std::path::{Path, PathBuf};

use super::choice::is_line;
use super::expand::Expansion;
use super::file::{Clock, StudyFile};
use super::keys::STUDY_FILE;
use super::planned::plan_all;
use super::setting::{EngineKind, Setting, Trial};
use crate::case::decode::decode;
use crate::case::document::Document;
use crate::case::fault::Fault;
use crate::case::load::explain;
use crate::case::{CaseError, text};
use crate::scene::SceneError;

/// A study, ready to be run.
#[derive(Debug, Clone, PartialEq)]
pub struct Study {
    pub title: String,
    /// What the error is drawn against.
    pub seconds: Clock,
    /// Relative errors for which the cheapest setting is named, the largest first.
    pub targets: Vec<f64>,
    pub repeats: u32,
    /// s
    pub repeat_below: f64,
    /// Their labels.
    pub grids: Vec<String>,
    /// The rows, grid by grid.
    pub settings: Vec<Setting>,
    /// What is run for them.
    pub trials: Vec<Trial>,
}

/// Why a study cannot be run. Each prints as one line.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    #[error(transparent)]
    File(#[from] CaseError),
    #[error("{}: with {setting}: {source}", path.display())]
    Case { path: PathBuf, setting: String, source: CaseError },
    #[error("{}: with {setting}: {source}", path.display())]
    Scene { path: PathBuf, setting: String, source: SceneError },
}

const MOST_REPEATS: u32 = 1000;
/// Each is a case that is loaded before the first is run.
const MOST_RUNS: u32 = 10_000;

impl Study {
    /// Reads and checks a study file, and loads the case of each of its settings. `overrides` are `key=value`, as after
    /// `--set`.
    ///
    /// # Errors
    /// The first thing wrong with the file, with a case, or with a key that it changes; a GPU that is not there.
    pub fn load(path: &Path, overrides: &[String]) -> Result<Self, StudyError> {
        Self::from_text(&text::read(path).map_err(CaseError::from)?, path, overrides)
    }

    /// As [`Study::load`], of a text that is not read from `path`: errors name it, cases are looked for beside it.
    ///
    /// # Errors
    /// As [`Study::load`].
    pub fn from_text(text: &str, path: &Path, overrides: &[String]) -> Result<Self, StudyError> {
        let mut document = Document::parse(text, path)?;
        overrides.iter().try_for_each(|given| document.set(given))?;
        let file = decode::<StudyFile>(document.root()).and_then(|file| check(&file).map(|()| file));
        let mut file = file.map_err(|fault| explain(fault, &document, &STUDY_FILE))?;
        file.targets.sort_by(|a, b| b.total_cmp(a));
        let plans = plan_all(&file, &document).map_err(|fault| explain(fault, &document, &STUDY_FILE))?;
        let mut expansion = Expansion::new(path, &document);
        for (index, plan) in plans.iter().enumerate() {
            expansion.add_all(index, plan)?;
        }
        let Expansion { settings, trials, .. } = expansion;
        let on_gpu = trials.iter().any(|trial| trial.engine == EngineKind::Gpu);
        Ok(Self {
            title: file.title,
            seconds: file.seconds.unwrap_or(if on_gpu { Clock::Wall } else { Clock::Cpu }),
            targets: file.targets,
            repeats: file.repeats,
            repeat_below: file.repeat_below,
            grids: plans.into_iter().map(|plan| plan.label).collect(),
            settings,
            trials,
        })
    }
}

fn check(file: &StudyFile) -> Result<(), Fault> {
    let require = |holds: bool, key: &str| if holds { Ok(()) } else { Err(Fault::range(key)) };
    require(is_line(&file.title), "title")?;
    require((1..=MOST_REPEATS).contains(&file.repeats), "repeats")?;
    require(file.repeat_below >= 0.0, "repeat_below")?;
    require((1..=MOST_RUNS).contains(&file.most_runs), "most_runs")?;
    require(file.targets.iter().all(|target| *target > 0.0), "targets")
}
