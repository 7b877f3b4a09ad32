//! `adapters`: the GPUs that runs can use.

use super::CliError;

pub(super) fn adapters() -> Result<(), CliError> {
    Err(CliError::NotBuilt("adapters"))
}
