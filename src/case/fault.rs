//! One thing wrong with one key, found while a case is decoded or checked, before it is known where the key stands.

use std::fmt::{self, Display, Formatter};

use serde::de;

/// A key as the names of its tables and its own; an item of an array is `[0]`, `[1]`...
pub(crate) type KeyPath = Vec<String>;

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Fault {
    pub path: KeyPath,
    pub problem: Problem,
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Problem {
    /// No such key; the keys that its table has.
    Unknown(&'static [&'static str]),
    Missing,
    /// A value of the wrong kind; what serde expected in its place.
    Kind(String),
    /// No table where one with these keys belongs.
    NotTable(&'static [&'static str]),
    /// A word that is none of these.
    Word(String, &'static [&'static str]),
    NotFinite,
    /// A value outside the range that `keys::allowed` states.
    Range,
    /// A value that is fine alone and not beside the others.
    Reason(String),
}

impl Fault {
    fn here(problem: Problem) -> Self {
        Fault { path: KeyPath::new(), problem }
    }

    /// `key` is dotted.
    pub fn range(key: &str) -> Self {
        Fault { path: split(key), problem: Problem::Range }
    }

    /// `key` is dotted.
    pub fn reason(key: &str, reason: impl Into<String>) -> Self {
        Fault { path: split(key), problem: Problem::Reason(reason.into()) }
    }

    pub fn at(path: &[String], reason: impl Into<String>) -> Self {
        Fault { path: path.to_vec(), problem: Problem::Reason(reason.into()) }
    }

    /// `key` is dotted.
    pub fn missing(key: &str) -> Self {
        Fault { path: split(key), problem: Problem::Missing }
    }

    pub fn not_finite() -> Self {
        Self::here(Problem::NotFinite)
    }

    pub fn not_table(fields: &'static [&'static str]) -> Self {
        Self::here(Problem::NotTable(fields))
    }

    /// The same fault, seen from the table or array that holds it.
    pub fn within(mut self, key: &str) -> Self {
        self.path.insert(0, key.to_owned());
        self
    }
}

fn split(key: &str) -> KeyPath {
    key.split('.').map(str::to_owned).collect()
}

/// The dotted form that a user writes: `boundaries.top.velocity[0]`.
pub(crate) fn dotted(path: &[String]) -> String {
    let mut key = String::new();
    for name in path {
        let bare = name.chars().all(|c| c.is_ascii_alphanumeric() || "_-[]".contains(c)) && !name.is_empty();
        if !key.is_empty() && !name.starts_with('[') {
            key.push('.');
        }
        key += &if bare { name.clone() } else { format!("{name:?}") };
    }
    key
}

impl Display for Fault {
    fn fmt(&self, out: &mut Formatter<'_>) -> fmt::Result {
        write!(out, "{}: {:?}", dotted(&self.path), self.problem)
    }
}

impl std::error::Error for Fault {}

impl de::Error for Fault {
    fn custom<T: Display>(message: T) -> Self {
        Self::here(Problem::Reason(message.to_string()))
    }

    fn invalid_type(_: de::Unexpected<'_>, expected: &dyn de::Expected) -> Self {
        Self::here(Problem::Kind(expected.to_string()))
    }

    fn invalid_value(_: de::Unexpected<'_>, expected: &dyn de::Expected) -> Self {
        Self::here(Problem::Kind(expected.to_string()))
    }

    fn invalid_length(_: usize, expected: &dyn de::Expected) -> Self {
        Self::here(Problem::Kind(expected.to_string()))
    }

    fn unknown_variant(given: &str, known: &'static [&'static str]) -> Self {
        Self::here(Problem::Word(given.to_owned(), known))
    }

    fn unknown_field(given: &str, known: &'static [&'static str]) -> Self {
        Self::here(Problem::Unknown(known)).within(given)
    }

    fn missing_field(name: &'static str) -> Self {
        Self::here(Problem::Missing).within(name)
    }
}
