//! `adapters`: the GPUs that runs can use.

use super::{CliError, print};

pub(super) fn adapters() -> Result<(), CliError> {
    print("none")
}
