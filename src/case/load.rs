//! From a case file and the command line's `--set` to a checked case.

use std::path::Path;

use toml::Value;

use super::Case;
use super::check::{check, check_profiles};
use super::decode::decode;
use super::document::Document;
use super::error::{CaseError, KeyError, KeyTrouble, Place};
use super::fault::{Fault, KeyPath, Problem, dotted};
use super::keys::{self, ALLOWED, Words};
use super::text;

/// Longest value that an error repeats in full, characters.
const SHOWN: usize = 60;

impl Case {
    /// Reads, completes and checks a case file. `overrides` are `key=value`, as after `--set`, the last one winning.
    ///
    /// What the file leaves open stands in the result: the defaults of its arrangement and of its form of pressure,
    /// and the paths of profiles, which the file gives from its own folder.
    ///
    /// # Errors
    /// The first thing wrong with the file, an override, or a profile it names. Nothing large is allocated before.
    pub fn load(path: &Path, overrides: &[String]) -> Result<Case, CaseError> {
        Case::from_text(&text::read(path)?, path, overrides)
    }

    /// As [`Case::load`], of a text that is not read from `path`: errors name it, profiles are looked for beside it.
    ///
    /// # Errors
    /// As [`Case::load`].
    pub fn from_text(text: &str, path: &Path, overrides: &[String]) -> Result<Case, CaseError> {
        let mut document = Document::parse(text, path)?;
        overrides.iter().try_for_each(|given| document.set(given))?;
        Case::from_document(&document, path)
    }

    /// As [`Case::load`], with keys changed by another file: errors name its place.
    pub(crate) fn load_changed(path: &Path, changes: &[Change]) -> Result<Case, CaseError> {
        let mut document = Document::parse(&text::read(path)?, path)?;
        for Change { key, value, place } in changes {
            document.put(key, value.clone(), place.clone()).map_err(|reason| {
                let trouble = KeyTrouble::Value { value: Some(shown(value)), reason };
                CaseError::Key(Box::new(KeyError { place: place.clone(), key: dotted(key), trouble }))
            })?;
        }
        Case::from_document(&document, path)
    }

    fn from_document(document: &Document, path: &Path) -> Result<Case, CaseError> {
        let explain = |fault| explain(fault, document, &CASE_FILE);
        let mut case = decode::<Case>(document.root()).map_err(explain)?;
        case.settle_form();
        check(&case).map_err(explain)?;
        case.settle_defaults();
        case.settle_profiles(path.parent().unwrap_or(Path::new("")));
        check_profiles(&case).map_err(explain)?;
        Ok(case)
    }

    fn settle_profiles(&mut self, folder: &Path) {
        for profile in self.expect.values_mut().filter_map(|expectation| expectation.profile.as_mut()) {
            *profile = folder.join(&*profile);
        }
    }
}

/// A key that takes another value than its file gives it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Change {
    pub key: KeyPath,
    pub value: Value,
    /// Where that was asked for.
    pub place: Place,
}

/// A kind of file, as its errors speak of it.
pub(crate) struct Kind {
    /// With its article.
    pub name: &'static str,
    pub words: &'static Words,
}

const CASE_FILE: Kind = Kind { name: "a case file", words: ALLOWED };

/// Puts a fault into the words and the place that a user can act on.
pub(crate) fn explain(fault: Fault, document: &Document, kind: &Kind) -> CaseError {
    let Fault { path, problem } = fault;
    let key = if path.is_empty() { "the file".to_owned() } else { dotted(&path) };
    let trouble = trouble(&path, problem, document.value(&path), kind);
    CaseError::Key(Box::new(KeyError { place: document.place(&path), key, trouble }))
}

fn trouble(path: &[String], problem: Problem, value: Option<&Value>, kind: &Kind) -> KeyTrouble {
    let allowed = keys::allowed(kind.words, path);
    let must_be = |fallback: String| format!("must be {}", allowed.map(str::to_owned).unwrap_or(fallback));
    let reason = match problem {
        Problem::Unknown(known) => {
            let table = match path {
                [] | [_] => kind.name.to_owned(),
                [table @ .., _] => format!("[{}]", dotted(table)),
            };
            return KeyTrouble::Unknown { suggestion: keys::suggest(kind.words, path, known), table, known };
        }
        Problem::Missing => return KeyTrouble::Missing { allowed: allowed.unwrap_or("given").to_owned() },
        Problem::NotTable(fields) => must_be(format!("a table with keys among {}", fields.join(", "))),
        Problem::Kind(expected) => must_be(expected),
        Problem::Word(given, known) => {
            let meant = keys::closest(&given, known).map(|word| format!(" (did you mean {word}?)"));
            must_be(format!("one of {}", known.join(", "))) + &meant.unwrap_or_default()
        }
        Problem::NotFinite => must_be("a number".to_owned()) + "; it is not finite",
        Problem::Range => must_be("in range".to_owned()),
        Problem::Reason(reason) => reason,
    };
    KeyTrouble::Value { value: value.map(shown), reason }
}

/// A value on one line, cut where it is long.
pub(crate) fn shown(value: &Value) -> String {
    let text = match value {
        Value::String(text) => format!("{text:?}"),
        // Debug writes 1e300 as such.
        Value::Float(number) => format!("{number:?}"),
        other => other.to_string().lines().collect::<Vec<_>>().join(" "),
    };
    match text.char_indices().nth(SHOWN) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text,
    }
}
