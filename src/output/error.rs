//! Why a run's folder could not be written or read.

use std::path::{Path, PathBuf};

use thiserror::Error;

use crate::measure::MeasureError;

#[derive(Debug, Error)]
pub enum OutputError {
    #[error("{}: {source}", path.display())]
    Io { path: PathBuf, source: std::io::Error },
    #[error("{} is not empty; choose another folder or overwrite it with --force", .0.display())]
    NotEmpty(PathBuf),
    #[error("{} is not a folder", .0.display())]
    NotAFolder(PathBuf),
    #[error("{field} of point {point} is {value}: nothing is written that is not a finite number")]
    PointNotFinite { field: String, point: usize, value: f64 },
    #[error("{field} is {value}: nothing is written that is not a finite number")]
    NotFinite { field: String, value: f64 },
    #[error("{field} has {found} values for {points} points")]
    Length { field: String, found: usize, points: usize },
    #[error("{}, line {line}: {what}", path.display())]
    Csv { path: PathBuf, line: usize, what: String },
    #[error("{}: {source}", path.display())]
    Json { path: PathBuf, source: serde_json::Error },
    #[error("{}: {source}", path.display())]
    Image { path: PathBuf, source: image::ImageError },
    #[error("the built-in font could not be read")]
    Font,
    #[error(transparent)]
    Measure(#[from] MeasureError),
}

impl OutputError {
    /// For `map_err`: an input or output error with its path.
    pub(crate) fn io(path: &Path) -> impl FnOnce(std::io::Error) -> Self {
        move |source| Self::Io { path: path.to_owned(), source }
    }
}
