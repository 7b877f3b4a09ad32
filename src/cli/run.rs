//! `run`: runs a case and writes what it gave.

use super::args::RunArguments;
use super::folder::output_folder;
use super::interrupt::StopFlag;
use super::progress::Progress;
use super::{CliError, load};

pub(super) fn run(arguments: &RunArguments) -> Result<(), CliError> {
    let case = load(&arguments.case)?;
    let _folder = output_folder(arguments)?;
    let progress = Progress::new(case.time.end, arguments.quiet, StopFlag::on_interrupt()?);
    progress.finish();
    Err(CliError::NotBuilt("run"))
}
