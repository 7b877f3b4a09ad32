//! A study: a case in many settings, the error of each against the time that it takes.

mod choice;
mod csv;
mod expand;
mod file;
mod folder;
mod gpus;
mod journal;
mod keys;
mod load;
mod machine;
mod markdown;
mod planned;
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
pub(crate) use markdown::plain;
pub use run::{End, Run, RunSeconds};
pub use session::{Completion, Turn};
pub use setting::{EngineKind, Precision, Setting, Trial};
#[cfg(test)]
pub(crate) use table::tests::table as table_of;
pub use table::{Row, Spread, Table};

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    /// A study of so many trials, which differ in their courant number.
    pub(super) fn study(trials: usize) -> Study {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/studies/smoke.toml");
        let values: Vec<String> = (1..=trials).map(|k| format!("{:?}", 0.1 * k as f64)).collect();
        let vary = format!("vary={{ time.courant = [{}] }}", values.join(", "));
        Study::load(&path, &[vary, "set.cloud.spacing=0.125".to_owned()]).expect("a study")
    }

    pub(super) fn good_run(seconds: f64) -> Run {
        let seconds = RunSeconds { wall: seconds, cpu: 0.9 * seconds, ..RunSeconds::default() };
        let quantity = Some("a measure".to_owned());
        Run { end: End::Steady, points: 81, steps: 100, iterations: 900, error: Some(0.02), quantity, seconds }
    }
}
