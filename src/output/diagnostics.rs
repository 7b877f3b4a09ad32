//! diagnostics.csv: one row a report, on disk before the next step begins.

use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};

use super::OutputError;
use super::file::finite;
use crate::simulation::Diagnostics;

const HEADER: &str = "step,time,dt,kinetic_energy,max_speed,divergence,pressure_iterations,residual,change";

/// Appends rows to a new file.
#[derive(Debug)]
pub struct DiagnosticsWriter {
    path: PathBuf,
    file: File,
}

impl DiagnosticsWriter {
    /// Starts the file with its header.
    ///
    /// # Errors
    /// Errors of the file system.
    pub fn create(path: &Path) -> Result<Self, OutputError> {
        let mut file = File::create(path).map_err(OutputError::io(path))?;
        writeln!(file, "{HEADER}").map_err(OutputError::io(path))?;
        Ok(Self { path: path.to_owned(), file })
    }

    /// Appends one row and flushes it.
    ///
    /// # Errors
    /// A value that is not finite (the row is not written then), errors of the file system.
    pub fn append(&mut self, row: &Diagnostics) -> Result<(), OutputError> {
        let Diagnostics {
            step,
            time,
            dt,
            kinetic_energy,
            max_speed,
            divergence,
            pressure_iterations,
            residual,
            change,
        } = row;
        for (field, value) in [
            ("time", time),
            ("dt", dt),
            ("kinetic_energy", kinetic_energy),
            ("max_speed", max_speed),
            ("divergence", divergence),
            ("residual", residual),
            ("change", change),
        ] {
            finite(&format!("{field} of step {step}"), *value)?;
        }
        // One write a row: a reader never sees half of one.
        let line = format!(
            "{step},{time:?},{dt:?},{kinetic_energy:?},{max_speed:?},{divergence:?},{pressure_iterations},{residual:?},\
             {change:?}\n"
        );
        self.file.write_all(line.as_bytes()).and_then(|()| self.file.flush()).map_err(OutputError::io(&self.path))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_on_disk_as_soon_as_they_are_appended() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("diagnostics.csv");
        let mut writer = DiagnosticsWriter::create(&path).unwrap();
        let row = Diagnostics { step: 50, time: 0.1, max_speed: 1.0, pressure_iterations: 12, ..Default::default() };
        writer.append(&row).unwrap();
        let broken = Diagnostics { change: f64::INFINITY, ..row };
        let error = writer.append(&broken).unwrap_err().to_string();
        assert!(error.starts_with("change of step 50 is inf"), "{error}");
        writer.append(&Diagnostics { step: 100, residual: 1e-7, ..row }).unwrap();
        let rows = "50,0.1,0.0,0.0,1.0,0.0,12,0.0,0.0\n100,0.1,0.0,0.0,1.0,0.0,12,1e-7,0.0\n";
        assert_eq!(std::fs::read_to_string(&path).unwrap(), format!("{HEADER}\n{rows}"));
    }

    #[test]
    fn the_header_names_every_field_of_a_row_in_order() {
        let row = serde_json::to_string(&Diagnostics::default()).unwrap();
        let at: Vec<Option<usize>> = HEADER.split(',').map(|name| row.find(&format!("\"{name}\":"))).collect();
        assert!(at.iter().all(Option::is_some) && at.is_sorted(), "{row}");
        assert_eq!(HEADER.split(',').count(), row.matches(':').count());
    }
}
