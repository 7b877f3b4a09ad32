//! A case file as a tree of TOML values that remembers which line, or which `--set`, each key came from.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use toml::de::{DeTable, DeValue};
use toml::{Table, Value};

use super::error::{CaseError, Place, one_line};
use super::fault::{KeyPath, dotted};

/// Names in the longest dotted key that `--set` takes; the deepest key of a case has four.
const DEEPEST: usize = 8;

pub(crate) struct Document {
    file: PathBuf,
    root: Value,
    places: HashMap<KeyPath, Place>,
}

impl Document {
    /// `file` is named in errors; `text` is its content.
    pub fn parse(text: &str, file: &Path) -> Result<Self, CaseError> {
        let starts: Vec<usize> = text.match_indices('\n').map(|(end, _)| end + 1).collect();
        let line_at = |offset: usize| 1 + starts.partition_point(|start| *start <= offset);
        let syntax = |error: toml::de::Error| {
            let line = error.span().map(|span| line_at(span.start));
            CaseError::Syntax { place: Place::File { path: file.into(), line }, message: on_one_line(&error) }
        };
        let (spanned, errors) = DeTable::parse_recoverable(text);
        // One slip can upset all that follows: the first error is the one to mend.
        if let Some(first) = errors.into_iter().min_by_key(|error| error.span().map(|span| span.start)) {
            return Err(syntax(first));
        }
        let root = toml::from_str(text).map_err(syntax)?;
        let mut document = Document { file: file.into(), root: Value::Table(root), places: HashMap::new() };
        document.note_lines(spanned.get_ref(), &line_at, &mut KeyPath::new());
        Ok(document)
    }

    fn note_lines(&mut self, table: &DeTable<'_>, line_at: &dyn Fn(usize) -> usize, path: &mut KeyPath) {
        for (key, value) in table {
            let line = Some(line_at(key.span().start));
            path.push(key.get_ref().to_string());
            self.places.insert(path.clone(), Place::File { path: self.file.clone(), line });
            self.note_inner_lines(value.get_ref(), line_at, path);
            path.pop();
        }
    }

    fn note_inner_lines(&mut self, value: &DeValue<'_>, line_at: &dyn Fn(usize) -> usize, path: &mut KeyPath) {
        match value {
            DeValue::Table(inner) => self.note_lines(inner, line_at, path),
            DeValue::Array(items) => {
                for (index, item) in items.iter().enumerate() {
                    path.push(format!("[{index}]"));
                    let line = Some(line_at(item.span().start));
                    self.places.insert(path.clone(), Place::File { path: self.file.clone(), line });
                    self.note_inner_lines(item.get_ref(), line_at, path);
                    path.pop();
                }
            }
            _ => {}
        }
    }

    pub fn root(&self) -> &Value {
        &self.root
    }

    /// Where the key was given; where it was not, where the nearest table around it was.
    pub fn place(&self, path: &[String]) -> Place {
        let known = (1..=path.len()).rev().find_map(|length| self.places.get(&path[..length]));
        known.cloned().unwrap_or_else(|| Place::File { path: self.file.clone(), line: None })
    }

    pub fn value(&self, path: &[String]) -> Option<&Value> {
        path.iter().try_fold(&self.root, |value, name| match name.strip_prefix('[').and_then(|n| n.strip_suffix(']')) {
            Some(index) => value.get(index.parse::<usize>().ok()?),
            None => value.get(name.as_str()),
        })
    }

    /// Sets one key from `key=value` of the command line: a dotted key, and a TOML value or a bare word.
    /// Tables on the way that are absent are made.
    pub fn set(&mut self, given: &str) -> Result<(), CaseError> {
        let refuse = |reason: String| CaseError::Override { given: one_line(given), reason };
        let form = || refuse("expected key=value, as in --set cloud.spacing=0.02".to_owned());
        let (key, value) = given.split_once('=').ok_or_else(form)?;
        let path: KeyPath = key.split('.').map(|name| name.trim().to_owned()).collect();
        let value = value.trim();
        if value.is_empty() || path.iter().any(String::is_empty) {
            return Err(form());
        }
        let value = parse_value(value)
            .map_err(|message| refuse(format!("{} is not a TOML value: {message}", one_line(value))))?;
        self.put(&path, value, Place::Override(one_line(given))).map_err(refuse)
    }

    /// Sets one key, given at `place`. Tables on the way that are absent are made.
    ///
    /// # Errors
    /// The reason why there can be no such key.
    pub fn put(&mut self, path: &[String], value: Value, place: Place) -> Result<(), String> {
        if path.len() > DEEPEST {
            return Err(format!("no key is {} tables deep", path.len() - 1));
        }
        let Some((name, tables)) = path.split_last() else { return Ok(()) };
        let mut table = self.root.as_table_mut();
        for (depth, step) in tables.iter().enumerate() {
            let inner = table.and_then(|table| {
                table.entry(step.as_str()).or_insert_with(|| Value::Table(Table::new())).as_table_mut()
            });
            table = Some(inner.ok_or_else(|| format!("{} is not a table", dotted(&path[..=depth])))?);
        }
        if let Some(table) = table {
            table.insert(name.clone(), value);
        }
        self.note_place(path, place);
        Ok(())
    }

    fn note_place(&mut self, path: &[String], place: Place) {
        self.places.retain(|known, _| !known.starts_with(path));
        for length in 1..=path.len() {
            self.places.entry(path[..length].to_vec()).or_insert_with(|| place.clone());
        }
    }
}

/// A TOML value; what is none is taken as the text itself, so that words need no quotes on the command line.
/// What opens a string, an array or a table has to be one.
fn parse_value(text: &str) -> Result<Value, String> {
    let word = || Value::from(text);
    match toml::from_str::<Table>(&format!("value = {text}")) {
        Ok(mut table) if table.len() == 1 => Ok(table.remove("value").unwrap_or_else(word)),
        Err(error) if text.starts_with(['"', '\'', '[', '{']) => Err(on_one_line(&error)),
        _ => Ok(word()),
    }
}

fn on_one_line(error: &toml::de::Error) -> String {
    error.message().lines().collect::<Vec<_>>().join(", ")
}
