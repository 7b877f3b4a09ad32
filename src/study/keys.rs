//! What each key of a study file may hold, in the words that its errors use.

use crate::case::keys::{self, Words};
use crate::case::load::Kind;

pub(super) const STUDY_FILE: Kind = Kind { name: "a study file", words: ALLOWED };

/// Keys of a setting that are no keys of its case.
pub(super) const KNOBS: [&str; 4] = ["engine", "precision", "adapter", "threads"];

const ALLOWED: &Words = &[
    ("title", "one line of text that names the study"),
    ("case", "the path of a case file, from the study file's folder"),
    ("error", "the NAME of an [expect.NAME] of the case"),
    ("seconds", r#""cpu", "wall" or "engine""#),
    ("targets", "a list of numbers above 0, relative errors"),
    ("along", "a key that is varied"),
    ("repeats", "a whole number from 1 to 1000"),
    ("repeat_below", "a time from 0, s"),
    ("most_runs", "a whole number from 1 to 10000"),
    ("set", "a table of keys of the case, and of engine, precision, adapter, threads"),
    ("set.engine", r#""cpu" or "gpu""#),
    ("set.precision", r#""f32" or "f64""#),
    ("set.adapter", "part of the name of a GPU"),
    ("set.threads", "a whole number from 1 to 1024"),
    ("vary", "a table of keys as in [set], each with a list of values"),
    ("vary.*", "a list of values, or of tables { label = TEXT, KEY = VALUE, ... }"),
    ("vary.*.label", "one line of text that names the choice"),
    ("grid", "tables [[grid]]"),
    ("grid.label", "one line of text that names the grid"),
    ("grid.case", "the path of a case file, from the study file's folder"),
    ("grid.error", "the NAME of an [expect.NAME] of the case"),
    ("grid.along", "a key that the grid varies"),
    ("grid.set", "a table as [set], for this grid"),
    ("grid.vary", "a table as [vary], for this grid"),
];

/// What a key may hold, by the name that the table gives it.
pub(super) fn must_be(key: &str) -> String {
    let path: Vec<String> = key.split('.').map(str::to_owned).collect();
    format!("must be {}", keys::allowed(ALLOWED, &path).unwrap_or("given otherwise"))
}

#[cfg(test)]
mod tests {
    use serde::de::DeserializeOwned;
    use toml::Value;

    use super::super::file::{Grid, StudyFile};
    use super::*;
    use crate::case::decode::decode;
    use crate::case::fault::Problem;

    fn fields<T: DeserializeOwned>() -> &'static [&'static str] {
        let unknown = Value::Table([("?".to_owned(), Value::Integer(0))].into_iter().collect());
        match decode::<T>(&unknown).map(|_| ()).expect_err("an unknown key").problem {
            Problem::Unknown(known) => known,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn the_table_holds_the_keys_of_the_types_and_no_others() {
        let mut held: Vec<String> = fields::<StudyFile>().iter().map(|key| (*key).to_owned()).collect();
        held.extend(fields::<Grid>().iter().map(|key| format!("grid.{key}")));
        held.extend(KNOBS.map(|key| format!("set.{key}")));
        held.extend(["vary.*", "vary.*.label"].map(str::to_owned));
        let mut words: Vec<String> = ALLOWED.iter().map(|(key, _)| (*key).to_owned()).collect();
        held.sort();
        words.sort();
        assert_eq!(held, words);
    }
}
