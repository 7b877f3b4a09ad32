//! The command line: parses it, runs one command, and turns its outcome into an exit code.

mod adapters;
mod args;
mod check;
mod compare;
mod cost;
mod engine;
mod error;
mod folder;
mod interrupt;
mod plan;
mod progress;
mod render;
mod resume;
mod run;
mod turns;

use std::fmt::Display;
use std::io::{self, ErrorKind, Write};
use std::process::ExitCode;

use clap::Parser;

use crate::case::Case;
use args::{Arguments, CaseArguments, Command};
pub use error::CliError;

/// Runs the command that the process was started with. 0 done, 1 the run or a check failed, 2 bad input.
pub fn main() -> ExitCode {
    match execute(&Arguments::parse().command) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            // A closed standard error leaves the exit code alone to tell.
            let _ = writeln!(io::stderr(), "error: {error}");
            ExitCode::from(error.exit_code())
        }
    }
}

fn execute(command: &Command) -> Result<(), CliError> {
    match command {
        Command::Run(arguments) => run::run(arguments),
        Command::Resume(arguments) => resume::resume(arguments),
        Command::Check(arguments) => check::check(arguments),
        Command::Plan(arguments) => plan::plan(arguments),
        Command::Cost(arguments) => cost::cost(arguments),
        Command::Render(arguments) => render::render(arguments),
        Command::Compare(arguments) => compare::compare(arguments),
        Command::Adapters => adapters::adapters(),
    }
}

fn load(arguments: &CaseArguments) -> Result<Case, CliError> {
    Ok(Case::load(&arguments.case, &arguments.overrides)?)
}

/// Prints one line; a reader that has seen enough and closed the pipe is no error.
fn print(line: impl Display) -> Result<(), CliError> {
    match writeln!(io::stdout(), "{line}") {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(CliError::Print(error)),
        _ => Ok(()),
    }
}
