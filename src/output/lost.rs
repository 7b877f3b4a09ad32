//! lost.csv: the points that left the domain, a row each; absent where none did.

use std::collections::BTreeSet;
use std::fs::{self, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use super::OutputError;
use super::file::finite;
use crate::motion::Row;

const HEADER: &str = "point,step,time,x,y";

/// Appends to lost.csv each point when it is first seen outside.
#[derive(Debug)]
pub struct LostWriter {
    path: PathBuf,
    /// Those that it has.
    known: BTreeSet<usize>,
}

impl LostWriter {
    /// Goes on with the file where there is one.
    ///
    /// # Errors
    /// A file that is no such table, errors of the file system.
    pub fn open(path: PathBuf) -> Result<Self, OutputError> {
        let known = if path.is_file() { read(&path)? } else { BTreeSet::new() };
        Ok(Self { path, known })
    }

    /// # Errors
    /// A place that is not finite, errors of the file system.
    pub fn append(&mut self, row: &Row) -> Result<(), OutputError> {
        for lost in row.outside.iter().filter(|lost| !self.known.contains(&lost.point)) {
            let [x, y] = lost.place;
            for value in [x, y] {
                finite(&format!("place of point {} in step {}", lost.point, row.step), value)?;
            }
            let head = if self.path.is_file() { String::new() } else { format!("{HEADER}\n") };
            let line = format!("{head}{},{},{:?},{x:?},{y:?}\n", lost.point, row.step, row.time);
            let file = OpenOptions::new().create(true).append(true).open(&self.path);
            file.and_then(|mut file| file.write_all(line.as_bytes())).map_err(OutputError::io(&self.path))?;
        }
        self.known.extend(row.outside.iter().map(|lost| lost.point));
        Ok(())
    }
}

/// The points that the file has.
fn read(path: &Path) -> Result<BTreeSet<usize>, OutputError> {
    let text = fs::read_to_string(path).map_err(OutputError::io(path))?;
    let point = |(line, row): (usize, &str)| {
        let point = row.split(',').next().and_then(|cell| cell.parse().ok());
        let what = "not a lost point".to_owned();
        point.ok_or_else(|| OutputError::Csv { path: path.to_owned(), line: line + 1, what })
    };
    text.lines().enumerate().skip(1).map(point).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::Lost;

    fn row(step: u64, points: &[usize]) -> Row {
        let outside = points.iter().map(|&point| Lost { point, place: [-0.25, point as f64] }).collect();
        Row { step, time: 0.5 * step as f64, outside, ..Row::default() }
    }

    #[test]
    fn each_lost_point_has_one_row_over_an_interruption_too() {
        let root = tempfile::tempdir().unwrap();
        let path = root.path().join("lost.csv");
        let mut writer = LostWriter::open(path.clone()).unwrap();
        writer.append(&row(1, &[])).unwrap();
        assert!(!path.exists());
        writer.append(&row(2, &[7])).unwrap();
        let mut writer = LostWriter::open(path.clone()).unwrap();
        writer.append(&row(3, &[2, 7])).unwrap();
        writer.append(&row(4, &[2])).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "point,step,time,x,y\n7,2,1.0,-0.25,7.0\n2,3,1.5,-0.25,2.0\n");
        let nowhere = Row { outside: vec![Lost { point: 1, place: [0.0, f64::NAN] }], ..row(5, &[]) };
        assert!(writer.append(&nowhere).is_err());
        fs::write(&path, "point,step,time,x,y\nx\n").unwrap();
        assert!(LostWriter::open(path).unwrap_err().to_string().ends_with("line 2: not a lost point"));
    }
}
