//! Why a field could not be measured.

use thiserror::Error;

use crate::cloud::CloudError;

#[derive(Debug, Clone, PartialEq, Error)]
pub enum MeasureError {
    #[error("there are no points to measure")]
    Empty,
    #[error("the spacing is {0}, and it must be a finite number above zero")]
    Spacing(f64),
    #[error("position of point {0} is not finite")]
    Position(usize),
    #[error("{field} has {found} values for {points} points")]
    Length { field: &'static str, found: usize, points: usize },
    #[error("expect.{name}: {what}")]
    Expectation { name: String, what: String },
    #[error(transparent)]
    Cloud(#[from] CloudError),
}
