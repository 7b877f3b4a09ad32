//! points.csv: every point of a snapshot, one a line, `x,y,u,v,p` in m, m/s and Pa, then what the flow carries (of derivatives of a known field
//! `x,y,value,gradient_x,gradient_y,laplacian`), each number in the shortest form that reads back to the same bits.

use std::fs::File;
use std::io::{BufRead, BufReader, BufWriter, Write};
use std::path::Path;

use glam::DVec2;

use super::OutputError;
use super::file::{check, write_whole};
use crate::snapshot::{Column, Snapshot};

const HEADER: &str = "x,y,u,v,p";

/// Writes all points.
///
/// # Errors
/// A value that is not finite, a field of the wrong length, errors of the file system.
pub fn write(path: &Path, snapshot: &Snapshot) -> Result<(), OutputError> {
    check(snapshot)?;
    write_whole(path, |file| {
        let columns = snapshot.columns();
        let row = |file: &mut BufWriter<File>, point: usize| {
            let place = snapshot.position[point];
            write!(file, "{:?},{:?}", place.x, place.y)?;
            columns.iter().flat_map(|column| column.at(point)).try_for_each(|(_, value)| write!(file, ",{value:?}"))?;
            writeln!(file)
        };
        let names = columns.iter().flat_map(Column::names);
        let header = ["x", "y"].into_iter().chain(names).collect::<Vec<_>>().join(",");
        writeln!(file, "{header}")
            .and_then(|()| (0..snapshot.position.len()).try_for_each(|point| row(file, point)))
            .map_err(OutputError::io(path))
    })
}

/// Reads what [`write`] wrote of a flow; the file does not hold the time, s.
///
/// # Errors
/// Another header, a row without a finite number for each column, errors of the file system.
pub fn read(path: &Path, time: f64) -> Result<Snapshot, OutputError> {
    let fail = |line: usize, what: String| OutputError::Csv { path: path.to_owned(), line, what };
    let mut lines = BufReader::new(File::open(path).map_err(OutputError::io(path))?).lines();
    let header = lines.next().transpose().map_err(OutputError::io(path))?.unwrap_or_default();
    let names: Vec<&str> = header.trim_end().split(',').collect();
    let carried = header.trim_end().strip_prefix(HEADER).filter(|rest| rest.is_empty() || rest.starts_with(','));
    let Some(carried) = carried.map(|rest| rest.split(',').skip(1)) else {
        return Err(fail(1, format!("the header is `{header}`, and must begin with `{HEADER}`")));
    };
    let mut snapshot = Snapshot { time, ..Snapshot::default() };
    snapshot.carried = carried.map(|name| (name.to_owned(), Vec::new())).collect();
    for (index, row) in lines.enumerate() {
        let row = row.map_err(OutputError::io(path))?;
        let numbers = numbers(&row, &names).map_err(|what| fail(index + 2, what))?;
        snapshot.position.push(DVec2::new(numbers[0], numbers[1]));
        snapshot.velocity.push(DVec2::new(numbers[2], numbers[3]));
        snapshot.pressure.push(numbers[4]);
        snapshot.carried.iter_mut().zip(&numbers[5..]).for_each(|((_, values), &value)| values.push(value));
    }
    Ok(snapshot)
}

fn numbers(row: &str, names: &[&str]) -> Result<Vec<f64>, String> {
    let mut numbers = Vec::with_capacity(names.len());
    let mut cells = row.trim_end().split(',');
    for name in names {
        let cell = cells.next().ok_or_else(|| format!("{name} is missing"))?;
        let number: f64 = cell.parse().map_err(|_| format!("{name} is `{cell}`, which is not a number"))?;
        if !number.is_finite() {
            return Err(format!("{name} is `{cell}`, which is not finite"));
        }
        numbers.push(number);
    }
    match cells.next() {
        None => Ok(numbers),
        Some(cell) => Err(format!("`{cell}` follows the {} columns", names.len())),
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    pub(crate) fn awkward() -> Snapshot {
        let numbers = [0.1 + 0.2, -0.0, 1e-310, 1.0 / 3.0, -f64::MAX, f64::MIN_POSITIVE, f64::from(0.3f32), 1e22];
        let pair = |k: usize| DVec2::new(numbers[k % 8], numbers[(k + 3) % 8]);
        Snapshot {
            time: 2.5,
            position: (0..20).map(pair).collect(),
            velocity: (3..23).map(pair).collect(),
            pressure: (5..25).map(|k| numbers[k % 8]).collect(),
            carried: vec![("temperature".to_owned(), (2..22).map(|k| numbers[k % 8]).collect())],
            ..Snapshot::default()
        }
    }

    #[test]
    fn reads_back_the_same_bits() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("points.csv");
        write(&path, &awkward()).unwrap();
        let back = read(&path, 2.5).unwrap();
        assert_eq!(back, awkward());
        assert!(back.position[1].x.is_sign_negative(), "-0.0 keeps its sign");
        assert!(std::fs::read_to_string(&path).unwrap().starts_with("x,y,u,v,p,temperature\n0.30000000000000004,"));
    }

    #[test]
    fn what_is_not_a_number_is_neither_written_nor_read() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("points.csv");
        let mut snapshot = awkward();
        snapshot.pressure[7] = f64::NAN;
        let error = write(&path, &snapshot).unwrap_err().to_string();
        assert!(error.starts_with("p of point 7 is NaN") && !path.exists(), "{error}");

        for (row, what) in [
            ("1,2,3,4,NaN", "p is `NaN`, which is not finite"),
            ("1,2,x,4,5", "u is `x`, which is not a number"),
            ("1,2,3", "v is missing"),
            ("1,2,3,4,5,6", "`6` follows the 5 columns"),
        ] {
            std::fs::write(&path, format!("x,y,u,v,p\n0,0,0,0,0\n{row}\n")).unwrap();
            let error = read(&path, 0.0).unwrap_err().to_string();
            assert!(error.ends_with(&format!("points.csv, line 3: {what}")), "{error}");
        }
        std::fs::write(&path, "x,y,p\n").unwrap();
        assert!(read(&path, 0.0).unwrap_err().to_string().contains("line 1: the header is `x,y,p`"));
    }
}
