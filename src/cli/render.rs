//! `render`: draws the pictures of a finished run or study again.

use super::args::RenderArguments;
use super::{CliError, print};
use crate::output::RunFolder;
use crate::run;
use crate::study::StudyFolder;

pub(super) fn render(arguments: &RenderArguments) -> Result<(), CliError> {
    let study = StudyFolder::at(&arguments.run);
    let pictures = match study.is_drawn() {
        true => study.render()?,
        false => run::render(&RunFolder::open(&arguments.run)?)?,
    };
    for picture in pictures {
        print(picture.display())?;
    }
    Ok(())
}
