//! `run`: runs a case and writes what it gave.

use std::sync::Arc;

use super::args::RunArguments;
use super::engine::open;
use super::folder::output_folder;
use super::interrupt::StopFlag;
use super::progress::Progress;
use super::{CliError, load, print};
use crate::case::Problem;
use crate::measure::ExpectationResult;
use crate::output::{RunFolder, StopReason, Summary};
use crate::run::{self, Job, Report};
use crate::scene::Scene;

pub(super) fn run(arguments: &RunArguments) -> Result<(), CliError> {
    let case = load(&arguments.case)?;
    let path = output_folder(arguments)?;
    let scene = |source| CliError::Scene { path: arguments.case.case.clone(), source };
    let scene = Arc::new(Scene::build(&case).map_err(scene)?);
    let mut engine = open(&scene, arguments)?;
    let mut progress = Progress::new(case.time.end, arguments.quiet, StopFlag::on_interrupt()?);
    let folder = RunFolder::create(&path, arguments.force)?;
    let case_path = &arguments.case.case;
    let job = Job { case_path, scene: &scene, folder: &folder, checkpoint_every: arguments.checkpoint_every };
    let report = run::run(job, engine.as_mut(), &mut progress)?;
    progress.finish();
    conclude(report, &folder)
}

/// Tells of a run that is over, and ends with its exit code.
pub(super) fn conclude(report: Report, folder: &RunFolder) -> Result<(), CliError> {
    tell(&report.summary, folder)?;
    if let Some(trouble) = report.trouble {
        return Err(CliError::Diverged(trouble));
    }
    let missed: Vec<&ExpectationResult> = report.summary.expect.iter().filter(|row| !row.pass).collect();
    if missed.is_empty() || report.summary.stop == StopReason::Interrupted {
        return Ok(());
    }
    let names = missed.iter().map(|row| row.name.as_str()).collect::<Vec<_>>().join(", ");
    Err(CliError::Missed { failed: missed.len(), rows: report.summary.expect.len(), names })
}

fn tell(summary: &Summary, folder: &RunFolder) -> Result<(), CliError> {
    let Summary { points, steps, time, seconds, .. } = summary;
    let why = match summary.stop {
        StopReason::Steady => "steady",
        StopReason::End => "end of time",
        StopReason::Interrupted => "interrupted",
        StopReason::Failed => "failed",
    };
    let adapter = summary.adapter.as_ref().map_or(String::new(), |adapter| format!(" on {}", adapter.name));
    print(format_args!("{}", summary.case.title))?;
    let course = match summary.case.problem() {
        Problem::Flow => format!(", {steps} steps to t = {time:.3} s ({why})"),
        Problem::Derivatives(_) | Problem::Poisson(_) => String::new(),
    };
    print(format_args!(
        "{points} points{course}, {}{adapter} {}, {:.2} s stepping",
        summary.engine, summary.precision, seconds.stepping,
    ))?;
    for row in &summary.expect {
        let value = row.value.map_or("none".to_owned(), |value| format!("{value:.6}"));
        let error = row.error.map_or("-".to_owned(), |error| format!("{:.3}%", 100.0 * error));
        let verdict = if row.pass { "ok" } else { "MISSED" };
        print(format_args!(
            "  {:<10} {value:>12}  published {:>12.6}  error {error:>8} of {:.2}% allowed  {verdict}",
            row.name,
            row.reference,
            100.0 * row.tolerance,
        ))?;
    }
    for warning in &summary.warnings {
        print(format_args!("  warning: {warning}"))?;
    }
    print(format_args!("written to {}", folder.path().display()))?;
    match folder.checkpoint().exists() {
        true => print(format_args!("to go on: stillpoint resume {}", folder.path().display())),
        false => Ok(()),
    }
}
