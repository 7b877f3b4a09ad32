//! What ends a command early, and the exit code it ends with.

use std::io;
use std::path::PathBuf;

use thiserror::Error;

use crate::case::CaseError;

/// Each prints as one line after `error: `.
#[derive(Debug, Error)]
pub enum CliError {
    #[error(transparent)]
    Case(#[from] CaseError),
    #[error("{}: has something in it already; give another --out, or --force to write over it", path.display())]
    FolderTaken { path: PathBuf },
    #[error("{}: not a folder, so no run can be written there", path.display())]
    NotFolder { path: PathBuf },
    #[error("{}: cannot be looked into: {source}", path.display())]
    FolderUnreadable { path: PathBuf, source: io::Error },
    #[error("{}: has no file name to call the run by; give --out", path.display())]
    NoName { path: PathBuf },
    #[error("cannot write to standard output: {0}")]
    Print(#[source] io::Error),
    #[error("cannot listen for Ctrl-C: {0}")]
    Interrupt(#[from] ctrlc::Error),
    #[error("{0} is not built yet")]
    NotBuilt(&'static str),
}

impl CliError {
    /// 2 where the input is at fault, 1 where the run is.
    pub fn exit_code(&self) -> u8 {
        match self {
            CliError::Case(_)
            | CliError::FolderTaken { .. }
            | CliError::NotFolder { .. }
            | CliError::FolderUnreadable { .. }
            | CliError::NoName { .. } => 2,
            CliError::Print(_) | CliError::Interrupt(_) | CliError::NotBuilt(_) => 1,
        }
    }
}
