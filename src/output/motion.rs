//! What points that move leave behind: motion.csv, one row a report, and frames/, the whole state at regular times.

use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};

use super::file::finite;
use super::{OutputError, RunFolder, points};
use crate::case::Case;
use crate::motion::Row;
use crate::snapshot::Snapshot;

const HEADER: &str = "step,time,kinetic_energy,potential_energy,nearest_least,nearest_mean,nearest_most,front,column,area,surface,lowered,lost";

/// Appends rows to motion.csv and numbers the frames.
#[derive(Debug)]
pub struct MotionWriter {
    path: PathBuf,
    file: File,
    frames: PathBuf,
    kept: Vec<f64>,
}

impl MotionWriter {
    /// Starts the file with its header; the columns of sensors are called `p_NAME`.
    ///
    /// # Errors
    /// Errors of the file system.
    pub fn create(folder: &RunFolder, case: &Case) -> Result<Self, OutputError> {
        let (path, frames) = (folder.motion(), folder.frames());
        let mut file = File::create(&path).map_err(OutputError::io(&path))?;
        let sensors: String = case.output.sensors.keys().map(|name| format!(",p_{name}")).collect();
        writeln!(file, "{HEADER}{sensors}").map_err(OutputError::io(&path))?;
        if case.output.frame_every.is_some() {
            fs::create_dir_all(&frames).map_err(OutputError::io(&frames))?;
        }
        Ok(Self { path, file, frames, kept: Vec::new() })
    }

    /// Appends one row and flushes it.
    ///
    /// # Errors
    /// A value that is not finite (the row is not written then), errors of the file system.
    pub fn append(&mut self, row: &Row) -> Result<(), OutputError> {
        let [least, mean, most] = row.nearest;
        let reals = [row.kinetic_energy, row.potential_energy, least, mean, most, row.front, row.column, row.area];
        for &value in reals.iter().chain(&row.sensors) {
            finite(&format!("motion of step {}", row.step), value)?;
        }
        let Row { step, time, surface, lowered, lost, .. } = row;
        let reals: String = reals.iter().map(|value| format!(",{value:?}")).collect();
        let sensors: String = row.sensors.iter().map(|value| format!(",{value:?}")).collect();
        let line = format!("{step},{time:?}{reals},{surface},{lowered},{lost}{sensors}\n");
        self.file.write_all(line.as_bytes()).and_then(|()| self.file.flush()).map_err(OutputError::io(&self.path))
    }

    /// Writes a frame, `frames/0000.csv` the first, and its time into `frames/times.csv`.
    ///
    /// # Errors
    /// A value that is not finite, errors of the file system.
    pub fn keep(&mut self, snapshot: &Snapshot) -> Result<(), OutputError> {
        points::write(&frame(&self.frames, self.kept.len()), snapshot)?;
        self.kept.push(snapshot.time);
        let path = self.frames.join("times.csv");
        let rows: String = self.kept.iter().enumerate().map(|(k, time)| format!("{k},{time:?}\n")).collect();
        fs::write(&path, format!("frame,time\n{rows}")).map_err(OutputError::io(&path))
    }
}

/// The file of a frame.
pub fn frame(frames: &Path, number: usize) -> PathBuf {
    frames.join(format!("{number:04}.csv"))
}
