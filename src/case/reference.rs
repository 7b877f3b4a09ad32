//! A published profile: a CSV file of figures along a line, `#` comments, a header of column names, then rows.

use std::path::{Path, PathBuf};

use thiserror::Error;

use super::error::one_line;
use super::text::{self, TextError};

/// Values at places along a line, in ascending order of the coordinate.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Profile {
    /// m, strictly ascending.
    pub coordinate: Vec<f64>,
    /// m/s or Pa, one for each coordinate.
    pub value: Vec<f64>,
}

/// Why a profile could not be read. Each prints as one line.
#[derive(Debug, Error)]
pub enum ReferenceError {
    #[error(transparent)]
    Text(#[from] TextError),
    #[error("{}: no column {}; it has {}", path.display(), one_line(column), known.join(", "))]
    NoColumn { path: PathBuf, column: String, known: Vec<String> },
    #[error("{}:{line}: {count} cells where the header names {expected}", path.display())]
    Cells { path: PathBuf, line: usize, count: usize, expected: usize },
    #[error("{}:{line}: {cell:?} in column {column} is not a finite number", path.display())]
    NotNumber { path: PathBuf, line: usize, column: String, cell: String },
    #[error("{}: coordinate {coordinate} is given twice", path.display())]
    Twice { path: PathBuf, coordinate: f64 },
    #[error("{}: {reason}", path.display())]
    Useless { path: PathBuf, reason: &'static str },
}

impl Profile {
    /// Reads the first column as the coordinate and `column`, the second where `None`, as the value.
    /// An empty cell of that column leaves its row out.
    ///
    /// # Errors
    /// A file that is no such table, or has fewer than two rows or no value other than 0 in the column.
    pub fn read(path: &Path, column: Option<&str>) -> Result<Profile, ReferenceError> {
        Profile::parse(&text::read(path)?, path, column)
    }

    fn parse(text: &str, path: &Path, column: Option<&str>) -> Result<Profile, ReferenceError> {
        let useless = |reason| ReferenceError::Useless { path: path.into(), reason };
        let lines = text.lines().enumerate().map(|(index, line)| (index + 1, line.trim()));
        let mut rows = lines.filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
        let (_, header) = rows.next().ok_or_else(|| useless("no header row"))?;
        let names: Vec<&str> = header.split(',').map(str::trim).collect();
        let index = match column {
            Some(column) => names.iter().skip(1).position(|name| *name == column).map(|position| position + 1),
            None => Some(1).filter(|index| *index < names.len()),
        };
        let index = index.ok_or_else(|| ReferenceError::NoColumn {
            path: path.into(),
            column: column.unwrap_or("of values").to_owned(),
            known: names.iter().map(|name| (*name).to_owned()).collect(),
        })?;
        let mut points = Vec::new();
        for (line, row) in rows {
            let cells: Vec<&str> = row.split(',').map(str::trim).collect();
            if cells.len() != names.len() {
                let (count, expected) = (cells.len(), names.len());
                return Err(ReferenceError::Cells { path: path.into(), line, count, expected });
            }
            let number = |column: usize| {
                let finite = cells[column].parse().ok().filter(|number: &f64| number.is_finite());
                finite.ok_or_else(|| ReferenceError::NotNumber {
                    path: path.into(),
                    line,
                    column: names[column].to_owned(),
                    cell: cells[column].to_owned(),
                })
            };
            let coordinate = number(0)?;
            if !cells[index].is_empty() {
                points.push((coordinate, number(index)?));
            }
        }
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        if let Some(pair) = points.windows(2).find(|pair| pair[0].0 == pair[1].0) {
            return Err(ReferenceError::Twice { path: path.into(), coordinate: pair[0].0 });
        }
        if points.len() < 2 {
            return Err(useless("fewer than two rows"));
        }
        if points.iter().all(|(_, value)| *value == 0.0) {
            return Err(useless("every value is 0, and errors are relative to the largest"));
        }
        let (coordinate, value) = points.into_iter().unzip();
        Ok(Profile { coordinate, value })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str, column: Option<&str>) -> Result<Profile, String> {
        Profile::parse(text, Path::new("p.csv"), column).map_err(|error| error.to_string())
    }

    #[test]
    fn columns_are_chosen_by_name_and_rows_sorted() {
        let text = "# where from\ny, a, b\n1.0, 5, 6\n\n# between\n0.0, 7, 8\n";
        let first = Profile { coordinate: vec![0.0, 1.0], value: vec![7.0, 5.0] };
        assert_eq!(parse(text, None), Ok(first.clone()));
        assert_eq!(parse(text, Some("a")), Ok(first));
        assert_eq!(parse(text, Some("b")), Ok(Profile { coordinate: vec![0.0, 1.0], value: vec![8.0, 6.0] }));
    }

    #[test]
    fn an_empty_cell_leaves_its_row_out_of_that_column_alone() {
        let text = "y,a,b\n0,1,1\n0.5,,2\n1,3,3\n";
        assert_eq!(parse(text, Some("a")).map(|profile| profile.value), Ok(vec![1.0, 3.0]));
        assert_eq!(parse(text, Some("b")).map(|profile| profile.value), Ok(vec![1.0, 2.0, 3.0]));
    }

    #[test]
    fn what_is_wrong_is_said_with_its_line() {
        for (text, column, fragment) in [
            ("", None, "no header row"),
            ("y\n0\n1\n", None, "no column of values; it has y"),
            ("y,a\n0,1\n1,2\n", Some("b"), "no column b; it has y, a"),
            ("y,a\n0,1\n1,2\n", Some("b\nc"), "no column b\\nc; it has y, a"),
            ("y,a\n0,1\n1,2\n", Some("y"), "no column y"),
            ("y,a\n0,1\n1\n", None, "p.csv:3: 1 cells where the header names 2"),
            ("#\ny,a\n0,x\n", None, "p.csv:3: \"x\" in column a is not a finite number"),
            ("y,a\n0,nan\n", None, "is not a finite number"),
            ("y,a\n,1\n", None, "\"\" in column y"),
            ("y,a\n0.5,1\n0.5,2\n", None, "coordinate 0.5 is given twice"),
            ("y,a\n0.5,1\n", None, "fewer than two rows"),
            ("y,a\n0,0\n1,0\n", None, "every value is 0"),
        ] {
            let message = parse(text, column).expect_err(text);
            assert!(message.contains(fragment), "{message:?} lacks {fragment:?}");
        }
    }
}
