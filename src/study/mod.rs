//! A study: a case in many settings, the error of each against the time that it takes.

mod choice;
mod csv;
mod file;
mod folder;
mod journal;
mod keys;
mod load;
mod machine;
mod markdown;
mod run;
mod session;
mod setting;
mod table;
mod timed;

pub use file::Clock;
pub use folder::StudyFolder;
pub use journal::Journal;
pub use load::{Study, StudyError};
pub use machine::Machine;
pub use run::{End, Run, RunSeconds};
pub use session::{Completion, Turn};
pub use setting::{EngineKind, Precision, Setting, Trial};
pub use table::{Row, Spread, Table};
