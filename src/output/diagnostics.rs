//! diagnostics.csv: one row a report, on disk before the next step begins; behind the others a column for the iterations of implicit
//! viscosity, where there is such a solve, and one for each probe.

use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use super::file::finite;
use super::{OutputError, rows};
use crate::simulation::Diagnostics;

const HEADER: &str = "step,time,dt,kinetic_energy,max_speed,divergence,pressure_iterations,residual,change,limit";

/// Appends rows to a new file.
#[derive(Debug)]
pub struct DiagnosticsWriter {
    path: PathBuf,
    file: File,
    /// Names of the columns behind the others: the iterations of implicit viscosity, if there are any, and the probes.
    more: Vec<String>,
}

impl DiagnosticsWriter {
    /// Starts the file with its header.
    ///
    /// # Errors
    /// Errors of the file system.
    pub fn create(path: &Path, more: Vec<String>) -> Result<Self, OutputError> {
        let mut file = File::create(path).map_err(OutputError::io(path))?;
        hold(&file);
        writeln!(file, "{}", header(&more)).map_err(OutputError::io(path))?;
        Ok(Self { path: path.to_owned(), file, more })
    }

    /// Goes on with the file of a run from its state after `step`: rows behind that one, and one that a kill cut off, are
    /// dropped, to be made again.
    ///
    /// # Errors
    /// A file that is not of this kind, or lacks the row of that step; errors of the file system.
    pub fn resume(path: &Path, step: u64, more: Vec<String>) -> Result<Self, OutputError> {
        rows::cut(path, &header(&more), "diagnostics", step)?;
        let file = OpenOptions::new().append(true).open(path).map_err(OutputError::io(path))?;
        hold(&file);
        Ok(Self { path: path.to_owned(), file, more })
    }

    /// Has the rows on the disk itself: they are to be there before a checkpoint that counts on them.
    pub fn sync(&mut self) -> Result<(), OutputError> {
        self.file.sync_data().map_err(OutputError::io(&self.path))
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
            limit,
            viscous_iterations,
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
        let names = &self.more[usize::from(viscous_iterations.is_some())..];
        for (name, value) in names.iter().zip(probes) {
            finite(&format!("{name} of step {step}"), *value)?;
        }
        // One write a row: a reader never sees half of one.
        let line = format!(
            "{step},{time:?},{dt:?},{kinetic_energy:?},{max_speed:?},{divergence:?},{pressure_iterations},{residual:?},\
             {change:?},{limit}"
        );
        let line = viscous_iterations.iter().fold(line, |line, iterations| format!("{line},{iterations}"));
        let line = probes.iter().fold(line, |line, value| format!("{line},{value:?}")) + "\n";
        self.file.write_all(line.as_bytes()).and_then(|()| self.file.flush()).map_err(OutputError::io(&self.path))
    }
}

/// The columns, those that not every run has last.
fn header(more: &[String]) -> String {
    [HEADER].into_iter().chain(more.iter().map(String::as_str)).collect::<Vec<_>>().join(",")
}

/// Others are to see that a run goes on here. Not every file system can tell them: then there is no more to do.
fn hold(file: &File) {
    let _ = file.try_lock();
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
        let rows = "50,0.1,0.0,0.0,1.0,0.0,12,0.0,0.0,end\n100,0.1,0.0,0.0,1.0,0.0,12,1e-7,0.0,end\n";
        assert_eq!(std::fs::read_to_string(&path).unwrap(), format!("{HEADER}\n{rows}"));
    }

    #[test]
    fn a_file_is_gone_on_with_after_the_row_asked_for() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("diagnostics.csv");
        let whole = format!("{HEADER}\n5,0.1\n10,0.2\n15,0.3\n");
        let resumed = |text: &str, step: u64| {
            std::fs::write(&path, text).unwrap();
            let resumed = DiagnosticsWriter::resume(&path, step, vec![]).map(|_| ()).map_err(|error| error.to_string());
            resumed.map(|()| std::fs::read_to_string(&path).unwrap())
        };
        assert_eq!(resumed(&whole, 10), Ok(format!("{HEADER}\n5,0.1\n10,0.2\n")));
        assert_eq!(resumed(&whole, 15), Ok(whole.clone()));
        assert_eq!(resumed(&whole, 0), Ok(format!("{HEADER}\n")));
        assert_eq!(resumed(&format!("{whole}1"), 15), Ok(whole.clone()), "half a row, whose number is a small one");
        let lacks = resumed(&whole, 20).unwrap_err();
        assert!(
            lacks.ends_with("diagnostics.csv, line 4: the row of step 20, which the checkpoint is of, is not there")
        );
        assert!(resumed("step\n5\n", 5).unwrap_err().contains("line 1: not the header"));
        assert!(resumed(&format!("{HEADER}\n5,0\nx\n"), 5).unwrap_err().contains("line 3: does not begin with"));
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
            format!("{HEADER},drag,drop\n0,0.0,0.0,0.0,0.0,0.0,0,0.0,0.0,end,0.25,-2.0\n")
        );
        let broken = Diagnostics { probes: vec![0.25, f64::NAN], ..row };
        assert!(writer.append(&broken).unwrap_err().to_string().starts_with("drop of step 0 is NaN"));
    }

    #[test]
    fn the_iterations_of_implicit_viscosity_stand_before_the_probes() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("diagnostics.csv");
        let columns = vec!["viscous_iterations".to_owned(), "drag".to_owned()];
        let mut writer = DiagnosticsWriter::create(&path, columns).unwrap();
        let row = Diagnostics { viscous_iterations: Some(9), probes: vec![0.25], ..Default::default() };
        writer.append(&row).unwrap();
        let text = std::fs::read_to_string(&path).unwrap();
        assert_eq!(text, format!("{HEADER},viscous_iterations,drag\n0,0.0,0.0,0.0,0.0,0.0,0,0.0,0.0,end,9,0.25\n"));
        let broken = Diagnostics { probes: vec![f64::NAN], ..row };
        assert!(writer.append(&broken).unwrap_err().to_string().starts_with("drag of step 0 is NaN"));
    }

    #[test]
    fn the_header_names_every_field_of_a_row_in_order() {
        let row = serde_json::to_string(&Diagnostics::default()).unwrap();
        let at: Vec<Option<usize>> = HEADER.split(',').map(|name| row.find(&format!("\"{name}\":"))).collect();
        assert!(at.iter().all(Option::is_some) && at.is_sorted(), "{row}");
        assert_eq!(HEADER.split(',').count(), row.matches(':').count());
    }
}
