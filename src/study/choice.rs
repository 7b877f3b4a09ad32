//! What a study sets and varies: tables of keys, written as in a case file, made into lists of changes.

use toml::{Table, Value};

use super::keys::must_be;
use crate::case::document::Document;
use crate::case::fault::{Fault, KeyPath, dotted};
use crate::case::load::{Change, shown};

/// One thing that is varied: a key of the case, a key of the run, or a name under which several change together.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Varied {
    pub name: KeyPath,
    pub choices: Vec<Choice>,
}

/// One value of it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Choice {
    /// The label, or the value as a file writes it, without quotes.
    pub value: String,
    pub changes: Vec<Change>,
}

/// The changes of a `[set]` that stands at `at` in the study file.
pub(super) fn settings(table: &Table, at: &[String], document: &Document) -> Vec<Change> {
    let change = |Leaf { key, at, value }: Leaf| Change { key, value, place: document.place(&at) };
    leaves(table, &[], at).into_iter().map(change).collect()
}

/// What a `[vary]` that stands at `at` in the study file varies.
///
/// # Errors
/// A key without a list, an empty list, a choice without a label.
pub(super) fn varied(table: &Table, at: &[String], document: &Document) -> Result<Vec<Varied>, Fault> {
    let each = |Leaf { key: name, at, value }: Leaf| {
        let items = value.as_array().filter(|items| !items.is_empty());
        let items = items.ok_or_else(|| Fault::at(&at, must_be("vary.*")))?;
        let choices = items.iter().enumerate().map(|(index, item)| {
            let at = [&at[..], &[format!("[{index}]")]].concat();
            choice(&name, item, &at, document)
        });
        Ok(Varied { choices: choices.collect::<Result<_, _>>()?, name })
    };
    leaves(table, &[], at).into_iter().map(each).collect()
}

fn choice(name: &[String], item: &Value, at: &[String], document: &Document) -> Result<Choice, Fault> {
    let Value::Table(table) = item else {
        let value = item.as_str().map_or_else(|| shown(item), str::to_owned);
        let change = Change { key: name.to_vec(), value: item.clone(), place: document.place(at) };
        return Ok(Choice { value, changes: vec![change] });
    };
    let label = |label: &Value| label.as_str().filter(|label| is_line(label)).map(str::to_owned);
    let mut keys = table.clone();
    let value = match keys.remove("label") {
        Some(given) => {
            label(&given).ok_or_else(|| Fault::at(&[at, &["label".to_owned()]].concat(), must_be("vary.*.label")))?
        }
        None => return Err(Fault::at(at, "a table of keys needs a label, one line of text that names the choice")),
    };
    Ok(Choice { value, changes: settings(&keys, at, document) })
}

/// A key that holds no table of further keys.
struct Leaf {
    /// As the case has it.
    key: KeyPath,
    /// As the study file has it: there a name may be dotted, in quotes.
    at: KeyPath,
    value: Value,
}

fn leaves(table: &Table, key: &[String], at: &[String]) -> Vec<Leaf> {
    let inside = |(name, value): (&String, &Value)| {
        let key = [key, &name.split('.').map(str::to_owned).collect::<Vec<_>>()].concat();
        let at = [at, std::slice::from_ref(name)].concat();
        match value {
            Value::Table(inner) if !inner.is_empty() => leaves(inner, &key, &at),
            value => vec![Leaf { key, at, value: value.clone() }],
        }
    };
    table.iter().flat_map(inside).collect()
}

/// One line that says something.
pub(super) fn is_line(text: &str) -> bool {
    !text.trim().is_empty() && !text.contains(char::is_control)
}

impl Varied {
    /// As it is written: dotted.
    pub fn key(&self) -> String {
        dotted(&self.name)
    }
}
