//! What ends a command early, and the exit code it ends with.

use std::io;
use std::path::PathBuf;

use thiserror::Error;

use crate::case::{CaseError, ReferenceError};
use crate::compare::CompareError;
use crate::comparison::ComparisonError;
use crate::engine::EngineError;
use crate::output::OutputError;
use crate::run::RunError;
use crate::scene::SceneError;
use crate::simulation::SimulationError;
use crate::study::StudyError;

/// Each prints as one line after `error: `.
#[derive(Debug, Error)]
pub enum CliError {
    #[error(transparent)]
    Case(#[from] CaseError),
    #[error(transparent)]
    Study(#[from] StudyError),
    #[error("{}: has something in it already; give another --out, or --force to write over it", path.display())]
    FolderTaken { path: PathBuf },
    #[error("{}: has something in it already and no study; give another --out", path.display())]
    NoStudy { path: PathBuf },
    #[error("{}: not a folder, so no run can be written there", path.display())]
    NotFolder { path: PathBuf },
    #[error("{}: cannot be looked into: {source}", path.display())]
    FolderUnreadable { path: PathBuf, source: io::Error },
    #[error("{}: has no file name to call the run by; give --out", path.display())]
    NoName { path: PathBuf },
    #[error("--adapter names a GPU, and --engine cpu asks for none; leave out one of them")]
    AdapterOnCpu,
    #[error("cannot write to standard output: {0}")]
    Print(#[source] io::Error),
    #[error("cannot listen for Ctrl-C: {0}")]
    Interrupt(#[from] ctrlc::Error),
    #[error("{}: {source}", path.display())]
    Scene { path: PathBuf, source: SceneError },
    #[error("{}: cannot go on where it began: {error}", path.display())]
    Reopen { path: PathBuf, error: Box<CliError> },
    #[error("no engine computes {0}")]
    UnknownEngine(String),
    #[error("{}: the run came to its end; there is nothing to go on with", path.display())]
    Over { path: PathBuf },
    #[error(transparent)]
    Simulation(#[from] SimulationError),
    #[error(transparent)]
    Engine(#[from] EngineError),
    #[error(transparent)]
    Output(#[from] OutputError),
    #[error("{0}")]
    Diverged(String),
    #[error(transparent)]
    Compare(#[from] CompareError),
    #[error(transparent)]
    Comparison(#[from] ComparisonError),
    #[error(transparent)]
    Reference(#[from] ReferenceError),
    #[error("{failed} of {rows} expected values missed: {names}")]
    Missed { failed: usize, rows: usize, names: String },
}

impl CliError {
    /// 2 where the input is at fault, 1 where the run is.
    pub fn exit_code(&self) -> u8 {
        match self {
            CliError::Case(_)
            | CliError::Study(_)
            | CliError::NoStudy { .. }
            | CliError::FolderTaken { .. }
            | CliError::NotFolder { .. }
            | CliError::FolderUnreadable { .. }
            | CliError::NoName { .. }
            | CliError::AdapterOnCpu
            | CliError::Scene { .. }
            | CliError::Reference(_)
            | CliError::Compare(
                CompareError::NotARun { .. }
                | CompareError::NoFrames { .. }
                | CompareError::Domains { .. }
                | CompareError::Reference(_),
            )
            | CliError::Engine(
                EngineError::TooLarge { .. } | EngineError::OutOfMemory { .. } | EngineError::Adapter(_),
            )
            | CliError::Simulation(SimulationError::TooFastForForward { .. })
            | CliError::UnknownEngine(_)
            | CliError::Over { .. }
            | CliError::Simulation(SimulationError::TooManySteps { .. })
            | CliError::Output(
                OutputError::NotEmpty(_)
                | OutputError::NotAFolder(_)
                | OutputError::Busy(_)
                | OutputError::Checkpoint { .. }
                | OutputError::Csv { .. },
            ) => 2,
            CliError::Output(OutputError::Io { source, .. }) if source.kind() == io::ErrorKind::NotFound => 2,
            CliError::Reopen { error, .. } => error.exit_code(),
            CliError::Print(_)
            | CliError::Interrupt(_)
            | CliError::Simulation(_)
            | CliError::Engine(_)
            | CliError::Output(_)
            | CliError::Compare(CompareError::Output(_))
            | CliError::Comparison(_)
            | CliError::Diverged(_)
            | CliError::Missed { .. } => 1,
        }
    }
}

impl From<RunError> for CliError {
    fn from(error: RunError) -> Self {
        match error {
            RunError::Simulation(error) => error.into(),
            RunError::Output(error) => error.into(),
            RunError::Reference(error) => error.into(),
            RunError::Comparison(error) => error.into(),
        }
    }
}
