//! `plan`: the operations of one time step, as both engines run them.

use super::args::PlanArguments;
use super::{CliError, load};

pub(super) fn plan(arguments: &PlanArguments) -> Result<(), CliError> {
    load(&arguments.case)?;
    Err(CliError::NotBuilt("plan"))
}
