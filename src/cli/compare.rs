//! `compare`: finished runs of points that move, side by side.

use super::args::CompareArguments;
use super::{CliError, print};
use crate::compare::compare as draw;

pub(super) fn compare(arguments: &CompareArguments) -> Result<(), CliError> {
    for picture in draw(&arguments.runs, &arguments.out)? {
        print(picture.display())?;
    }
    Ok(())
}
