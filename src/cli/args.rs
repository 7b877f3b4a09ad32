//! The command line: what can be asked for, and how.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};

/// Meshfree simulation of 2D incompressible flow on points that stand still.
#[derive(Debug, Parser)]
#[command(name = "stillpoint", version, propagate_version = true, after_help = EXIT_CODES)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Command,
}

const EXIT_CODES: &str = "Exit codes: 0 done, 1 the run failed or missed what its case expects, 2 bad input.";

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Run a case and write its fields, diagnostics and pictures to a folder.
    Run(RunArguments),
    /// Check a case file without running it.
    Check(CaseArguments),
    /// Print the operations of one time step and the memory they take.
    Plan(PlanArguments),
    /// Run a case in many settings and show the error of each against the time it takes.
    Cost(CostArguments),
    /// Draw the pictures of a finished run or study again.
    Render(RenderArguments),
    /// List the GPUs that runs can use.
    Adapters,
}

/// A case file and what the command line changes in it.
#[derive(Debug, Args)]
pub struct CaseArguments {
    /// The case file, TOML.
    #[arg(value_name = "CASE")]
    pub case: PathBuf,
    /// Set one key of the case, as in --set cloud.spacing=0.02; may be repeated.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub overrides: Vec<String>,
}

#[derive(Debug, Args)]
pub struct RunArguments {
    #[command(flatten)]
    pub case: CaseArguments,
    /// The folder to write to [default: runs/, then the case file's name].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Write to a folder that already has something in it.
    #[arg(long)]
    pub force: bool,
    /// What computes: auto takes a GPU where there is one.
    #[arg(long, value_enum, default_value_t)]
    pub engine: EngineChoice,
    /// The GPU to use: part of its name, as `adapters` lists it.
    #[arg(long, value_name = "NAME")]
    pub adapter: Option<String>,
    /// Floating-point numbers of the fields [default: what the engine does best].
    #[arg(long, value_enum)]
    pub precision: Option<Precision>,
    /// Draw no progress bar.
    #[arg(long)]
    pub quiet: bool,
}

#[derive(Debug, Args)]
pub struct PlanArguments {
    #[command(flatten)]
    pub case: CaseArguments,
    /// Floating-point numbers of the fields.
    #[arg(long, value_enum)]
    pub precision: Option<Precision>,
    /// Take steps on the CPU and show what each operation and each effect costs.
    #[arg(long)]
    pub measure: bool,
}

#[derive(Debug, Args)]
pub struct CostArguments {
    /// The study file, TOML.
    #[arg(value_name = "STUDY")]
    pub study: PathBuf,
    /// Set one key of the study, as in --set repeats=1 or --set set.time.end=5; may be repeated.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub overrides: Vec<String>,
    /// The folder to write to [default: runs/, then the study file's name].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Forget the runs that are in the folder and start over.
    #[arg(long)]
    pub fresh: bool,
    /// Draw no progress bar.
    #[arg(long)]
    pub quiet: bool,
}

#[derive(Debug, Args)]
pub struct RenderArguments {
    /// The folder of a finished run or study.
    #[arg(value_name = "RUN")]
    pub run: PathBuf,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub enum EngineChoice {
    #[default]
    Auto,
    Cpu,
    Gpu,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Precision {
    F32,
    F64,
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn every_option_of_run_reaches_its_field() {
        let line = "stillpoint run c.toml --out d --force --engine cpu --adapter x --precision f32 --set a=1 --set b=2 --quiet";
        let parsed = Arguments::try_parse_from(line.split(' ')).expect("a complete command line");
        let Command::Run(run) = parsed.command else { panic!("not a run: {parsed:?}") };
        assert_eq!(run.case.case, PathBuf::from("c.toml"));
        assert_eq!(run.case.overrides, ["a=1", "b=2"]);
        assert_eq!(run.out, Some(PathBuf::from("d")));
        assert_eq!((run.force, run.quiet), (true, true));
        assert_eq!((run.engine, run.precision), (EngineChoice::Cpu, Some(Precision::F32)));
        assert_eq!(run.adapter.as_deref(), Some("x"));
    }
}
