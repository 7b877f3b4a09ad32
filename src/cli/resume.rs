//! `resume`: goes on with a run from its checkpoint.

use std::sync::Arc;

use super::CliError;
use super::args::ResumeArguments;
use super::engine::reopen;
use super::interrupt::StopFlag;
use super::progress::Progress;
use super::run::conclude;
use crate::output::checkpoint::{Checkpoint, CheckpointTrouble};
use crate::output::{OutputError, RunFolder, StopReason, Summary};
use crate::run::{self, Job};
use crate::scene::Scene;

pub(super) fn resume(arguments: &ResumeArguments) -> Result<(), CliError> {
    let folder = RunFolder::resume(&arguments.run)?;
    let path = folder.checkpoint();
    let checkpoint = Checkpoint::read(&path).map_err(|error| over(error, &folder))?;
    let scene = Scene::build(&checkpoint.case).map_err(|source| CliError::Scene { path: path.clone(), source })?;
    let scene = Arc::new(scene);
    let head = checkpoint.head.clone();
    let state = checkpoint.state(&scene, &path)?;
    let mut engine = reopen(&scene, &head).map_err(|error| CliError::Reopen { path, error: Box::new(error) })?;
    let mut progress = Progress::new(scene.case.time.end, arguments.quiet, StopFlag::on_interrupt()?);
    let checkpoint_every = arguments.checkpoint_every.or(head.every);
    let job = Job { case_path: &head.case_path, scene: &scene, folder: &folder, checkpoint_every };
    let report = run::resume(job, state, engine.as_mut(), &mut progress)?;
    progress.finish();
    conclude(report, &folder)
}

/// A run that came to its end has no checkpoint left, and says so.
fn over(error: OutputError, folder: &RunFolder) -> CliError {
    let missing = matches!(error, OutputError::Checkpoint { trouble: CheckpointTrouble::Missing, .. });
    match Summary::read(&folder.summary()) {
        Ok(summary) if missing && matches!(summary.stop, StopReason::End | StopReason::Steady) => {
            CliError::Over { path: folder.path().to_owned() }
        }
        _ => error.into(),
    }
}
