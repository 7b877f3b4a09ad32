//! A run's folder: what each file in it is called, how it is written and how it is read back.

pub mod checkpoint;
mod diagnostics;
mod error;
pub(crate) mod file;
mod folder;
mod lost;
pub mod motion;
pub mod picture;
pub mod points;
mod rows;
mod summary;
pub mod vtu;

pub use diagnostics::DiagnosticsWriter;
pub use error::OutputError;
pub use folder::RunFolder;
pub use motion::MotionWriter;
pub use summary::{Adapter, Fallbacks, Seconds, StopReason, Summary};
