//! Files that are there whole or not at all, and the check that numbers are finite.

use std::fs::{self, File};
use std::io::{BufWriter, Write};
use std::path::Path;

use super::OutputError;
use crate::snapshot::Snapshot;

/// How the name of a file ends that is not whole yet.
pub(super) const PART: &str = ".part";

/// Writes a file under a temporary name beside it and renames it once it is whole.
///
/// # Errors
/// Whatever `write` returns, and every error of the file system; the temporary file is removed then.
pub(crate) fn write_whole(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<File>) -> Result<(), OutputError>,
) -> Result<(), OutputError> {
    write_and(path, write, |_| Ok(()))
}

/// The same, and the disk has it before it takes the place of what was there: it outlives the machine's sudden end too.
///
/// # Errors
/// As [`write_whole`].
pub(crate) fn write_durable(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<File>) -> Result<(), OutputError>,
) -> Result<(), OutputError> {
    write_and(path, write, |file| file.sync_all().map_err(OutputError::io(path)))?;
    // The new name is in the folder, and so is to be on the disk too; not every system opens folders.
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if cfg!(unix) { sync(folder) } else { Ok(()) }
}

/// Has a file, or the names in a folder, on the disk itself.
pub(super) fn sync(path: &Path) -> Result<(), OutputError> {
    File::open(path).and_then(|file| file.sync_all()).map_err(OutputError::io(path))
}

fn write_and(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<File>) -> Result<(), OutputError>,
    settle: impl FnOnce(&File) -> Result<(), OutputError>,
) -> Result<(), OutputError> {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(format!(".{}{PART}", std::process::id()));
    let temporary = path.with_file_name(name);
    let written = (|| {
        let mut file = BufWriter::new(File::create(&temporary).map_err(OutputError::io(&temporary))?);
        write(&mut file)?;
        file.flush().map_err(OutputError::io(path))?;
        settle(file.get_ref())?;
        fs::rename(&temporary, path).map_err(OutputError::io(path))
    })();
    if written.is_err() {
        // The first error is the one to report.
        let _ = fs::remove_file(&temporary);
    }
    written
}

/// Every field has a value for each point, and every value is a finite number.
pub(super) fn check(snapshot: &Snapshot) -> Result<(), OutputError> {
    let points = snapshot.position.len();
    let columns = snapshot.columns();
    for column in &columns {
        let (field, found) = (column.name(), column.len());
        if found != points {
            return Err(OutputError::Length { field: field.to_owned(), found, points });
        }
    }
    finite("time", snapshot.time)?;
    for (point, place) in snapshot.position.iter().enumerate() {
        let fields = columns.iter().flat_map(|column| column.at(point));
        if let Some((field, value)) =
            [("x", place.x), ("y", place.y)].into_iter().chain(fields).find(|(_, value)| !value.is_finite())
        {
            let field = field.to_owned();
            return Err(OutputError::PointNotFinite { field, point, value });
        }
    }
    Ok(())
}

pub(super) fn finite(field: &str, value: f64) -> Result<(), OutputError> {
    if value.is_finite() { Ok(()) } else { Err(OutputError::NotFinite { field: field.to_owned(), value }) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failed_write_leaves_the_old_file_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        write_whole(&path, |file| file.write_all(b"old").map_err(OutputError::io(&path))).unwrap();
        let error = write_whole(&path, |file| {
            file.write_all(b"half of the new").map_err(OutputError::io(&path))?;
            finite("time", f64::NAN)
        });
        assert_eq!(error.unwrap_err().to_string(), "time is NaN: nothing is written that is not a finite number");
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn an_infinity_is_named_with_its_field_and_point() {
        let mut snapshot = Snapshot {
            time: 0.0,
            position: vec![glam::DVec2::ZERO; 3],
            velocity: vec![glam::DVec2::ZERO; 3],
            pressure: vec![0.0; 3],
            ..Snapshot::default()
        };
        check(&snapshot).unwrap();
        snapshot.velocity[2].y = f64::INFINITY;
        assert!(check(&snapshot).unwrap_err().to_string().starts_with("v of point 2 is inf"));
        snapshot.velocity.pop();
        assert!(
            matches!(check(&snapshot), Err(OutputError::Length { field, found: 2, points: 3 }) if field == "velocity")
        );
    }
}
