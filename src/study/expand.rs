//! From a grid to its settings: every combination, its case loaded and its points tried.

use std::path::Path;

use super::StudyError;
use super::choice::{Choice, Varied};
use super::gpus::Gpus;
use super::keys::{KNOBS, STUDY_FILE};
use super::planned::Planned;
use super::setting::{Knobs, Setting, Trial, in_words, refuse};
use crate::case::document::Document;
use crate::case::error::one_line;
use crate::case::fault::Fault;
use crate::case::load::{Change, explain};
use crate::case::{Case, CaseError, keys};
use crate::cloud::Cloud;
use crate::scene::Scene;

/// Clouds of at most so many points are laid out before the study begins, to see that they can be.
const CHEAP: f64 = 5000.0;

/// Gathers the settings of a study and what is run for them.
pub(super) struct Expansion<'a> {
    path: &'a Path,
    document: &'a Document,
    pub settings: Vec<Setting>,
    pub trials: Vec<Trial>,
    gpus: Gpus,
}

impl<'a> Expansion<'a> {
    /// `path` is the study file's.
    pub fn new(path: &'a Path, document: &'a Document) -> Self {
        Self { path, document, settings: Vec::new(), trials: Vec::new(), gpus: Gpus::default() }
    }

    /// Adds every combination of a grid.
    pub fn add_all(&mut self, grid: usize, plan: &Planned) -> Result<(), StudyError> {
        let count = plan.varied.iter().map(|varied| varied.choices.len()).product();
        for number in 0..count {
            let mut rest = number;
            let mut chosen: Vec<(&Varied, &Choice)> = Vec::new();
            for varied in plan.varied.iter().rev() {
                chosen.push((varied, &varied.choices[rest % varied.choices.len()]));
                rest /= varied.choices.len();
            }
            chosen.reverse();
            self.add(grid, plan, &chosen)?;
        }
        Ok(())
    }

    fn add(&mut self, grid: usize, plan: &Planned, chosen: &[(&Varied, &Choice)]) -> Result<(), StudyError> {
        let mut changes = plan.set.clone();
        for (k, (varied, choice)) in chosen.iter().enumerate() {
            for change in &choice.changes {
                let same = |other: &&(&Varied, &Choice)| other.1.changes.iter().any(|known| known.key == change.key);
                if let Some((other, _)) = chosen[..k].iter().find(same) {
                    let reason = format!("is varied by {} and by {}", other.key(), varied.key());
                    return Err(refuse(&change.key.join("."), Some(&change.value), &change.place, reason).into());
                }
                changes.push(change.clone());
            }
        }
        let words = |parts: &[(&Varied, &Choice)]| {
            parts.iter().map(|(varied, choice)| in_words(&varied.key(), &choice.value)).collect::<Vec<_>>().join(", ")
        };
        let (family, along) = chosen.split_at(chosen.len() - usize::from(plan.lines));
        let along = words(along);
        let family = if family.is_empty() { plan.label.clone() } else { words(family) };
        let words = words(chosen);
        let trial = self.trial(plan, changes, &words)?;
        let known = self.trials.iter().position(|known| *known == trial);
        let trial = known.unwrap_or_else(|| {
            self.trials.push(trial);
            self.trials.len() - 1
        });
        let values = chosen.iter().map(|(varied, choice)| (varied.key(), choice.value.clone())).collect();
        self.settings.push(Setting { grid, values, family, along, words, trial });
        Ok(())
    }

    fn trial(&mut self, plan: &Planned, mut changes: Vec<Change>, words: &str) -> Result<Trial, StudyError> {
        let fault = |path: &[String], reason: String| explain(Fault::at(path, reason), self.document, &STUDY_FILE);
        let knobs = Knobs::take(&mut changes)?;
        if let Some(Change { key, value, place }) = changes.iter().find(|change| change.key.len() == 1) {
            let near = keys::closest(&key[0], &KNOBS).map(|near| format!(" (did you mean {near}?)"));
            let (near, knobs) = (near.unwrap_or_default(), KNOBS.join(", "));
            let reason = format!("no such key{near}; there are {knobs}, and those in the tables of a case");
            return Err(refuse(&key[0], Some(value), place, reason).into());
        }
        let path = self.path.parent().unwrap_or(Path::new("")).join(&plan.case.0);
        let mut case = Case::load_changed(&path, &changes).map_err(|error| match error {
            CaseError::Text(error) => fault(&plan.case.1, error.to_string()).into(),
            // A key that stands in the case, at odds with what the study makes of others.
            error if error.is_in(&path) => {
                StudyError::Case { path: self.path.to_owned(), setting: one_line(words), source: error }
            }
            error => error.into(),
        })?;
        let (error, at) = &plan.error;
        if !case.expect.contains_key(error) {
            let known: Vec<&str> = case.expect.keys().map(String::as_str).collect();
            let near = keys::closest(error, &known).map(|near| format!(" (did you mean {near}?)")).unwrap_or_default();
            let known = if known.is_empty() { "none".to_owned() } else { known.join(", ") };
            let reason = format!("{} has no [expect.{error}]{near}; it has {known}", path.display());
            return Err(fault(at, reason).into());
        }
        case.expect.retain(|name, _| name == error);
        let trial = self.gpus.trial(case, knobs, &self.document.place(&[]))?;
        self.try_cloud(&trial.case, words)?;
        Ok(trial)
    }

    /// Lays out the points of a small case, unless one with the same points was.
    fn try_cloud(&self, case: &Case, words: &str) -> Result<(), StudyError> {
        let same =
            |known: &Case| (&known.domain, &known.cloud, &known.method) == (&case.domain, &case.cloud, &case.method);
        if self.trials.iter().any(|trial| same(&trial.case)) || Cloud::estimate(case) > CHEAP {
            return Ok(());
        }
        let failed = |source| StudyError::Scene { path: self.path.to_owned(), setting: one_line(words), source };
        Scene::build(case).map(|_| ()).map_err(failed)
    }
}
