//! Measuring a scattered field: its value anywhere, its course and extremes along a line, and what a case expects of it.

mod cells;
mod error;
mod expect;
mod field;
mod fit;
mod history;
mod images;
mod line;
mod loss;
mod probe;
mod sampler;
mod slope;

pub use crate::case::Profile;
pub use cells::CellList;
pub use error::MeasureError;
pub use expect::{ExpectationResult, evaluate, evaluate_run};
pub use field::FieldError;
pub use fit::{Degree, Fit};
pub use images::Images;
pub use line::{Extreme, LineMeasure};
pub use probe::Probe;
pub use sampler::{Sampler, Stencil};

#[cfg(test)]
pub(crate) use sampler::tests;
