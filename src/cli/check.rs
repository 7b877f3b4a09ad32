//! `check`: is this case file right, and how large is it?

use super::args::CaseArguments;
use super::{CliError, load, print};
use crate::cloud::Cloud;

pub(super) fn check(arguments: &CaseArguments) -> Result<(), CliError> {
    let case = load(arguments)?;
    print(format_args!("ok: {}, about {} points", case.title, Cloud::estimate(&case).round()))
}
