//! A study file as it is written: which case, what is varied, how often each setting is run.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};
use toml::Table;

#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct StudyFile {
    /// One line that names the study in its picture.
    pub title: String,
    /// The case that is varied, from the study file's folder; a grid may name its own.
    pub case: Option<PathBuf>,
    /// The `[expect.NAME]` of the case whose relative error is measured; a grid may name its own.
    pub error: Option<String>,
    /// What the error is drawn against; where absent, wall-clock time if a setting runs on a GPU, else CPU time.
    pub seconds: Option<Clock>,
    /// Relative errors for which the cheapest setting is named.
    #[serde(default = "default_targets")]
    pub targets: Vec<f64>,
    /// The varied key that the lines of the picture run along.
    pub along: Option<String>,
    /// Timed runs of each setting.
    #[serde(default = "default_repeats")]
    pub repeats: u32,
    /// A setting that takes longer is run once, s.
    #[serde(default = "default_repeat_below")]
    pub repeat_below: f64,
    /// A study that asks for more is refused.
    #[serde(default = "default_most_runs")]
    pub most_runs: u32,
    /// Changes of the case that hold for every setting.
    #[serde(default)]
    pub set: Table,
    /// Keys with lists of values, of which every combination is run.
    #[serde(default)]
    pub vary: Table,
    /// Grids of settings; without any, `vary` is the one grid.
    #[serde(default)]
    pub grid: Vec<Grid>,
}

/// One grid of settings: what it says goes before what stands at the top of the file.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(super) struct Grid {
    pub label: Option<String>,
    pub case: Option<PathBuf>,
    pub error: Option<String>,
    pub along: Option<String>,
    pub set: Table,
    pub vary: Table,
}

/// Which seconds count.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Clock {
    /// User and system time of the process.
    Cpu,
    Wall,
    /// Of the engine's operations alone, those of the setup among them: what points that move would pay in every step.
    Engine,
}

fn default_targets() -> Vec<f64> {
    vec![0.05, 0.01, 0.002]
}

fn default_repeats() -> u32 {
    3
}

fn default_repeat_below() -> f64 {
    10.0
}

fn default_most_runs() -> u32 {
    500
}
