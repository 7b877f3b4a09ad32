//! lost.csv: the points that left the domain, a row each; absent where none did.

use std::collections::BTreeSet;
use std::fs::{self, OpenOptions};
use std::io::Write;
use std::path::PathBuf;

use super::OutputError;
use super::file::{finite, sync, write_whole};
use super::folder::remove;
use crate::motion::{Lost, Row};

const HEADER: &str = "point,step,time,x,y";

/// Appends to lost.csv each point when it is first seen outside.
#[derive(Debug)]
pub struct LostWriter {
    path: PathBuf,
    /// Those that it has.
    known: BTreeSet<usize>,
}

impl LostWriter {
    pub fn new(path: PathBuf) -> Self {
        Self { path, known: BTreeSet::new() }
    }

    /// Goes on with the file where there is one, after the last of `rows`: points that were lost later, and a line that a kill cut
    /// off, are dropped from it, the others come with the row that first saw them.
    ///
    /// # Errors
    /// A file that is no such table, errors of the file system.
    pub fn resume(path: PathBuf, rows: &mut [Row]) -> Result<Self, OutputError> {
        let mut known = BTreeSet::new();
        if path.is_file() {
            let text = fs::read_to_string(&path).map_err(OutputError::io(&path))?;
            let whole = text.rfind('\n').map_or("", |end| &text[..end]);
            let mut kept = format!("{HEADER}\n");
            for (line, text) in whole.lines().enumerate().skip(1) {
                let (step, lost) = parse(text).ok_or_else(|| {
                    let what = "not a lost point".to_owned();
                    OutputError::Csv { path: path.clone(), line: line + 1, what }
                })?;
                if let Some(row) = rows.iter_mut().find(|row| row.step == step) {
                    row.outside.push(lost);
                    known.insert(lost.point);
                    kept.push_str(text);
                    kept.push('\n');
                }
            }
            match known.is_empty() {
                true => remove(&path)?,
                false => write_whole(&path, |file| file.write_all(kept.as_bytes()).map_err(OutputError::io(&path)))?,
            }
        }
        Ok(Self { path, known })
    }

    /// Has the file on the disk itself.
    ///
    /// # Errors
    /// Errors of the file system.
    pub fn sync(&self) -> Result<(), OutputError> {
        if self.known.is_empty() { Ok(()) } else { sync(&self.path) }
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

/// The step that first saw a point outside, and the point.
fn parse(line: &str) -> Option<(u64, Lost)> {
    let cells: Vec<&str> = line.split(',').collect();
    let [point, step, _, x, y] = cells[..] else { return None };
    let place = [x.parse().ok()?, y.parse().ok()?];
    Some((step.parse().ok()?, Lost { point: point.parse().ok()?, place }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(step: u64, points: &[usize]) -> Row {
        let outside = points.iter().map(|&point| Lost { point, place: [-0.25, point as f64] }).collect();
        Row { step, time: 0.5 * step as f64, outside, ..Row::default() }
    }

    #[test]
    fn each_lost_point_has_one_row_over_an_interruption_too() {
        let root = tempfile::tempdir().unwrap();
        let path = root.path().join("lost.csv");
        let mut writer = LostWriter::new(path.clone());
        writer.append(&row(1, &[])).unwrap();
        assert!(!path.exists());
        writer.append(&row(2, &[7])).unwrap();
        writer.append(&row(3, &[4, 7])).unwrap();
        // The state gone on from is that of step 2, and a kill cut a line off.
        let text = fs::read_to_string(&path).unwrap();
        fs::write(&path, format!("{text}9,4,2")).unwrap();
        let mut rows = [row(1, &[]), row(2, &[])];
        let mut writer = LostWriter::resume(path.clone(), &mut rows).unwrap();
        assert_eq!(rows, [row(1, &[]), row(2, &[7])]);
        writer.append(&row(3, &[2, 7])).unwrap();
        writer.append(&row(4, &[2])).unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "point,step,time,x,y\n7,2,1.0,-0.25,7.0\n2,3,1.5,-0.25,2.0\n");
        let nowhere = Row { outside: vec![Lost { point: 1, place: [0.0, f64::NAN] }], ..row(5, &[]) };
        assert!(writer.append(&nowhere).is_err());
        fs::write(&path, "point,step,time,x,y\nx\n").unwrap();
        assert!(LostWriter::resume(path, &mut []).unwrap_err().to_string().ends_with("line 2: not a lost point"));
    }
}
