//! One setting of a study: what is run, and the words for it.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use toml::Value;

use super::choice::is_line;
use super::keys::{KNOBS, must_be};
use crate::case::decode::decode;
use crate::case::error::{KeyError, KeyTrouble, Place};
use crate::case::load::{Change, shown};
use crate::case::{Case, CaseError};

/// What computes.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum EngineKind {
    #[default]
    Cpu,
    Gpu,
}

/// The floats of the fields.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Precision {
    F32,
    F64,
}

/// All that decides what a run gives and how long it takes, but for the machine.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Trial {
    /// Of its expectations it has the one that is measured.
    pub case: Case,
    pub engine: EngineKind,
    pub precision: Precision,
    /// The whole name of the GPU; none on the CPU.
    pub adapter: Option<String>,
    /// Of the CPU engine.
    pub threads: usize,
}

/// One row of a study.
#[derive(Debug, Clone, PartialEq)]
pub struct Setting {
    /// Which grid it belongs to, by its place in the study.
    pub grid: usize,
    /// The varied keys and their values, as a file has them.
    pub values: Vec<(String, String)>,
    /// What the settings of its line in the picture share, in words.
    pub family: String,
    /// Where it stands on that line, in words; empty where it is alone.
    pub along: String,
    /// All that is varied, in words.
    pub words: String,
    /// Which of the study's trials it is; rows of several grids may share one.
    pub trial: usize,
}

/// The keys of a setting that are no keys of its case, each with the place where it was given.
#[derive(Debug, Default)]
pub(super) struct Knobs {
    pub engine: Option<(EngineKind, Place)>,
    pub precision: Option<(Precision, Place)>,
    pub adapter: Option<(String, Place)>,
    pub threads: Option<(usize, Place)>,
}

const MOST_THREADS: usize = 1024;

impl Knobs {
    /// Takes them out of the changes; of two for one key the last holds.
    ///
    /// # Errors
    /// A wrong value.
    pub fn take(changes: &mut Vec<Change>) -> Result<Self, CaseError> {
        let mut knobs = Self::default();
        for change in changes.iter().filter(|change| is_knob(&change.key)) {
            match change.key[0].as_str() {
                "engine" => knobs.engine = Some(read(change, |_| true)?),
                "precision" => knobs.precision = Some(read(change, |_| true)?),
                "adapter" => knobs.adapter = Some(read(change, |name: &String| is_line(name))?),
                _ => knobs.threads = Some(read(change, |threads| (1..=MOST_THREADS).contains(threads))?),
            }
        }
        changes.retain(|change| !is_knob(&change.key));
        Ok(knobs)
    }
}

pub(super) fn is_knob(key: &[String]) -> bool {
    matches!(key, [name] if KNOBS.contains(&name.as_str()))
}

fn read<T: DeserializeOwned>(change: &Change, allowed: impl Fn(&T) -> bool) -> Result<(T, Place), CaseError> {
    let key = &change.key[0];
    let value = decode::<T>(&change.value).ok().filter(allowed);
    let value = value.ok_or_else(|| refuse(key, Some(&change.value), &change.place, must_be(&format!("set.{key}"))))?;
    Ok((value, change.place.clone()))
}

/// The error of a key whose value will not do.
pub(super) fn refuse(key: &str, value: Option<&Value>, place: &Place, reason: String) -> CaseError {
    let trouble = KeyTrouble::Value { value: value.map(shown), reason };
    CaseError::Key(Box::new(KeyError { place: place.clone(), key: key.to_owned(), trouble }))
}

/// A varied value in the words of a picture: `1/64`, `random`, `courant 0.4`.
pub(super) fn in_words(key: &str, value: &str) -> String {
    let name = key.rsplit('.').next().unwrap_or(key);
    match value.parse::<f64>() {
        Ok(spacing) if key == "cloud.spacing" => {
            let count = 1.0 / spacing;
            let whole = (count - count.round()).abs() < 1e-6 * count;
            if whole { format!("1/{}", count.round()) } else { value.to_owned() }
        }
        Ok(_) => format!("{name} {value}"),
        Err(_) if value == "true" || value == "false" => format!("{name} {value}"),
        Err(_) => value.replace('_', " "),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_said_shortly() {
        for (key, value, words) in [
            ("cloud.spacing", "0.015625", "1/64"),
            ("cloud.spacing", "0.0104166666666666667", "1/96"),
            ("cloud.spacing", "0.3", "0.3"),
            ("cloud.arrangement", "random", "random"),
            ("effects.pressure.solver", "conjugate_gradient", "conjugate gradient"),
            ("time.courant", "0.4", "courant 0.4"),
            ("output.pictures", "true", "pictures true"),
            ("threads", "2", "threads 2"),
        ] {
            assert_eq!(in_words(key, value), words);
        }
    }
}
