//! diagnostics.csv: one row a report, on disk before the next step begins; a column for each probe behind the others.

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
    /// Names of the probes.
    probes: Vec<String>,
}

impl DiagnosticsWriter {
    /// Starts the file with its header.
    ///
    /// # Errors
    /// Errors of the file system.
    pub fn create(path: &Path, probes: Vec<String>) -> Result<Self, OutputError> {
        let mut file = File::create(path).map_err(OutputError::io(path))?;
        let header = [HEADER].into_iter().chain(probes.iter().map(String::as_str)).collect::<Vec<_>>().join(",");
        writeln!(file, "{header}").map_err(OutputError::io(path))?;
        Ok(Self { path: path.to_owned(), file, probes })
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
            probes,
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
        for (name, value) in self.probes.iter().zip(probes) {
            finite(&format!("{name} of step {step}"), *value)?;
        }
        // One write a row: a reader never sees half of one.
        let line = format!(
            "{step},{time:?},{dt:?},{kinetic_energy:?},{max_speed:?},{divergence:?},{pressure_iterations},{residual:?},\
             {change:?}"
        );
        let line = probes.iter().fold(line, |line, value| format!("{line},{value:?}")) + "\n";
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
        let mut writer = DiagnosticsWriter::create(&path, vec![]).unwrap();
        let row = Diagnostics { step: 50, time: 0.1, max_speed: 1.0, pressure_iterations: 12, ..Default::default() };
        writer.append(&row).unwrap();
        let broken = Diagnostics { change: f64::INFINITY, ..row.clone() };
        let error = writer.append(&broken).unwrap_err().to_string();
        assert!(error.starts_with("change of step 50 is inf"), "{error}");
        writer.append(&Diagnostics { step: 100, residual: 1e-7, ..row }).unwrap();
        let rows = "50,0.1,0.0,0.0,1.0,0.0,12,0.0,0.0\n100,0.1,0.0,0.0,1.0,0.0,12,1e-7,0.0\n";
        assert_eq!(std::fs::read_to_string(&path).unwrap(), format!("{HEADER}\n{rows}"));
    }

    #[test]
    fn probes_have_columns_of_their_own() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("diagnostics.csv");
        let mut writer = DiagnosticsWriter::create(&path, vec!["drag".to_owned(), "drop".to_owned()]).unwrap();
        let row = Diagnostics { probes: vec![0.25, -2.0], ..Default::default() };
        writer.append(&row).unwrap();
        assert_eq!(
            std::fs::read_to_string(&path).unwrap(),
            format!("{HEADER},drag,drop\n0,0.0,0.0,0.0,0.0,0.0,0,0.0,0.0,0.25,-2.0\n")
        );
        let broken = Diagnostics { probes: vec![0.25, f64::NAN], ..row };
        assert!(writer.append(&broken).unwrap_err().to_string().starts_with("drop of step 0 is NaN"));
    }

    #[test]
    fn the_header_names_every_field_of_a_row_in_order() {
        let row = serde_json::to_string(&Diagnostics::default()).unwrap();
        let at: Vec<Option<usize>> = HEADER.split(',').map(|name| row.find(&format!("\"{name}\":"))).collect();
        assert!(at.iter().all(Option::is_some) && at.is_sorted(), "{row}");
        assert_eq!(HEADER.split(',').count(), row.matches(':').count());
    }
}
