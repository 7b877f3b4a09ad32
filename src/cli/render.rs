//! `render`: draws the pictures of a finished run again.

use super::args::RenderArguments;
use super::{CliError, print};
use crate::output::RunFolder;
use crate::run;

pub(super) fn render(arguments: &RenderArguments) -> Result<(), CliError> {
    let folder = RunFolder::open(&arguments.run)?;
    for picture in run::render(&folder)? {
        print(picture.display())?;
    }
    Ok(())
}
