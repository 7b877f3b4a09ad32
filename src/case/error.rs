//! What is wrong with a case file, on one line: where, which key, the value given, and what is allowed.

use std::fmt::{self, Display, Formatter};
use std::path::{Path, PathBuf};

use thiserror::Error;

use super::text::TextError;

/// Why a case could not be loaded. Each prints as one line.
#[derive(Debug, Error)]
pub enum CaseError {
    #[error(transparent)]
    Text(#[from] TextError),
    #[error("{place}: not valid TOML: {message}")]
    Syntax { place: Place, message: String },
    #[error("--set {given}: {reason}")]
    Override { given: String, reason: String },
    #[error("{0}")]
    Key(Box<KeyError>),
}

impl CaseError {
    /// Whether it is about a place in this file.
    pub(crate) fn is_in(&self, file: &Path) -> bool {
        let place = match self {
            CaseError::Syntax { place, .. } => place,
            CaseError::Key(error) => &error.place,
            CaseError::Text(_) | CaseError::Override { .. } => return false,
        };
        matches!(place, Place::File { path, .. } if path == file)
    }
}

/// What is wrong with one key.
#[derive(Debug, Error)]
#[error("{place}: {key}{trouble}")]
pub struct KeyError {
    pub place: Place,
    /// Dotted: `cloud.spacing`.
    pub key: String,
    pub trouble: KeyTrouble,
}

/// The rest of the sentence that a [`KeyError`]'s key begins.
#[derive(Debug, Error)]
pub enum KeyTrouble {
    #[error(" is not a key{}; {table} has {}", suggested(suggestion), known.join(", "))]
    Unknown { suggestion: Option<String>, table: String, known: &'static [&'static str] },
    #[error(" is missing: it must be {allowed}")]
    Missing { allowed: String },
    /// `value` is as TOML writes it, cut where it is long; none where the key was not given.
    #[error("{}: {reason}", given(value))]
    Value { value: Option<String>, reason: String },
}

/// Where a key was given.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Place {
    /// A case file, and the line where it is known, counted from 1.
    File { path: PathBuf, line: Option<usize> },
    /// The command line: the text after `--set`.
    Override(String),
}

impl Display for Place {
    fn fmt(&self, out: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Place::File { path, line: Some(line) } => write!(out, "{}:{line}", path.display()),
            Place::File { path, line: None } => write!(out, "{}", path.display()),
            Place::Override(given) => write!(out, "--set {given}"),
        }
    }
}

fn suggested(suggestion: &Option<String>) -> String {
    suggestion.as_ref().map(|key| format!(" (did you mean {key}?)")).unwrap_or_default()
}

fn given(value: &Option<String>) -> String {
    value.as_ref().map(|value| format!(" = {value}")).unwrap_or_default()
}

/// The text with its line breaks and other control characters escaped.
pub(crate) fn one_line(text: &str) -> String {
    let escape = |c: char| if c.is_control() { c.escape_default().to_string() } else { c.to_string() };
    text.chars().map(escape).collect()
}
