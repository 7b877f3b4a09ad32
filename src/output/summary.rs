//! summary.json: what was run, on what, how far it came, how long it took, and how it compares.

use std::fs::File;
use std::io::{BufReader, Write};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::OutputError;
use super::file::{finite, write_whole};
use crate::case::Case;
use crate::measure::ExpectationResult;

/// All of summary.json.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// The case file as it was named on the command line.
    pub case_path: PathBuf,
    pub case: Case,
    /// Version of Stillpoint.
    pub version: String,
    /// `gpu` or `cpu`.
    pub engine: String,
    /// The GPU; `None` on the CPU engine.
    pub adapter: Option<Adapter>,
    /// `f32` or `f64`.
    pub precision: String,
    pub points: usize,
    pub steps: u64,
    /// Time reached, s.
    pub time: f64,
    pub stop: StopReason,
    /// Of this process: of a run that was gone on with, since then.
    pub seconds: Seconds,
    pub fallbacks: Fallbacks,
    /// Pressure iterations of all steps.
    pub iterations: u64,
    pub warnings: Vec<String>,
    /// Memory of the engine's buffers over the number of points.
    pub bytes_per_point: f64,
    pub expect: Vec<ExpectationResult>,
}

/// The GPU that ran, as its driver names it.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Adapter {
    pub name: String,
    pub driver: String,
    pub driver_info: String,
    pub backend: String,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum StopReason {
    /// No velocity changed faster than `time.steady`.
    Steady,
    /// `time.end` was reached.
    End,
    /// Someone asked it to stop.
    Interrupted,
    /// An error ended it.
    Failed,
}

/// Wall-clock time, s.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Seconds {
    pub setup: f64,
    pub stepping: f64,
    pub output: f64,
}

/// How often the method took a second choice.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Fallbacks {
    /// Pressure solves that stalled and were handed to the direct solver.
    pub direct_solves: u64,
    /// Points whose fit needed a wider radius.
    pub widened: u64,
    /// Points whose fit is of a lower order.
    pub lowered: u64,
    /// Points that take their nearest neighbour's value.
    pub nearest: u64,
}

impl Summary {
    /// Writes the summary as indented JSON.
    ///
    /// # Errors
    /// A number that is not finite, errors of the file system.
    pub fn write(&self, path: &Path) -> Result<(), OutputError> {
        self.check()?;
        write_whole(path, |file| {
            serde_json::to_writer_pretty(&mut *file, self)
                .map_err(|source| OutputError::Json { path: path.to_owned(), source })?;
            file.write_all(b"\n").map_err(OutputError::io(path))
        })
    }

    /// Reads what [`Summary::write`] wrote.
    ///
    /// # Errors
    /// A file that is not such a summary, errors of the file system.
    pub fn read(path: &Path) -> Result<Self, OutputError> {
        let file = BufReader::new(File::open(path).map_err(OutputError::io(path))?);
        serde_json::from_reader(file).map_err(|source| OutputError::Json { path: path.to_owned(), source })
    }

    fn check(&self) -> Result<(), OutputError> {
        finite("time", self.time)?;
        finite("seconds.setup", self.seconds.setup)?;
        finite("seconds.stepping", self.seconds.stepping)?;
        finite("seconds.output", self.seconds.output)?;
        finite("bytes_per_point", self.bytes_per_point)?;
        for row in &self.expect {
            let numbers = [("position", row.position), ("value", row.value), ("error", row.error)];
            let known = [("reference", Some(row.reference)), ("tolerance", Some(row.tolerance))];
            for (field, value) in numbers.into_iter().chain(known) {
                finite(&format!("expect.{}.{field}", row.name), value.unwrap_or(0.0))?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn summary() -> Summary {
        let case = "title = 't'\n[domain]\nwidth = 1.0\nheight = 0.1\n[cloud]\narrangement = 'jittered'\nspacing = 0.05\n\
                    jitter = 0.3\n[fluid]\ndensity = 1.0\n[effects.viscosity]\nkinematic = 0.01\n[time]\nend = 1.0\n\
                    [expect.u]\ncomponent = 'u'\nline = { x = 0.5 }\nmeasure = 'minimum'\nvalue = -0.2\n\
                    tolerance = 0.01\nsource = 'a paper'\n";
        Summary {
            case_path: "cases/t.toml".into(),
            case: toml::from_str(case).unwrap(),
            version: "0.1.0".into(),
            engine: "gpu".into(),
            adapter: Some(Adapter { name: "a card".into(), backend: "vulkan".into(), ..Adapter::default() }),
            precision: "f32".into(),
            points: 441,
            iterations: 7,
            steps: 1200,
            time: 0.1 + 0.2,
            stop: StopReason::Steady,
            seconds: Seconds { setup: 0.5, stepping: 1.0 / 3.0, output: 0.0 },
            fallbacks: Fallbacks { widened: 3, ..Fallbacks::default() },
            warnings: vec!["one".into()],
            bytes_per_point: 412.5,
            expect: vec![ExpectationResult {
                name: "u".into(),
                quantity: "minimum of u along x = 0.5".into(),
                position: Some(0.45),
                value: None,
                reference: -0.2,
                error: None,
                tolerance: 0.01,
                pass: false,
                source: "a paper".into(),
            }],
        }
    }

    #[test]
    fn reads_back_what_was_written() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("summary.json");
        summary().write(&path).unwrap();
        assert_eq!(Summary::read(&path).unwrap(), summary());
        let on_the_cpu = Summary { adapter: None, ..summary() };
        on_the_cpu.write(&path).unwrap();
        assert_eq!(Summary::read(&path).unwrap(), on_the_cpu);
        let text = std::fs::read_to_string(&path).unwrap();
        assert!(text.contains("\"adapter\": null") && text.contains("\"stop\": \"steady\""), "{text}");
    }

    #[test]
    fn numbers_read_back_to_the_same_bits() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("summary.json");
        for k in 1..300 {
            let time = f64::from(k).sqrt() * 10f64.powi(k % 40 - 20) / 3.0;
            Summary { time, ..summary() }.write(&path).unwrap();
            assert_eq!(Summary::read(&path).unwrap().time, time);
        }
    }

    #[test]
    fn not_a_number_is_refused_by_name() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("summary.json");
        let mut broken = summary();
        broken.expect[0].value = Some(f64::NAN);
        let error = broken.write(&path).unwrap_err().to_string();
        assert!(error.starts_with("expect.u.value is NaN") && !path.exists(), "{error}");
        let broken = Summary { bytes_per_point: f64::INFINITY, ..summary() };
        assert!(broken.write(&path).unwrap_err().to_string().starts_with("bytes_per_point is inf"));
    }

    #[test]
    fn a_broken_file_is_an_error_with_its_place() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("summary.json");
        std::fs::write(&path, "{\n  \"case_path\": 3\n}").unwrap();
        let error = Summary::read(&path).unwrap_err().to_string();
        assert!(error.contains("summary.json") && error.contains("expected path string at line"), "{error}");
    }
}
