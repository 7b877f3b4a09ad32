//! `render`: draws the pictures of a finished run again.

use super::CliError;
use super::args::RenderArguments;

pub(super) fn render(_arguments: &RenderArguments) -> Result<(), CliError> {
    Err(CliError::NotBuilt("render"))
}
