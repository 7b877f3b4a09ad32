//! A case run into a folder: the engine chosen, the scene simulated, the files written, the expectations judged.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use crate::case::{Case, Measure, Motion, Problem, Profile, ReferenceError};
use crate::comparison::{self, ComparisonError};
use crate::engine::{Engine, EngineError, EngineInfo};
use crate::known::Known;
use crate::measure::{Probe, evaluate_run};
use crate::motion;
use crate::output::motion::Frames;
use crate::output::picture::Film;
use crate::output::{
    self, Adapter, DiagnosticsWriter, Fallbacks, MotionWriter, OutputError, RunFolder, Seconds, StopReason, Summary,
    checkpoint,
};
use crate::scene::Scene;
use crate::simulation::{self, Diagnostics, Observer, Outcome, SimulationError, State, Stop, Trouble};
use crate::snapshot::Snapshot;

/// Why a run could not be finished.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    #[error(transparent)]
    Simulation(#[from] SimulationError),
    #[error(transparent)]
    Output(#[from] OutputError),
    #[error(transparent)]
    Reference(#[from] ReferenceError),
    #[error(transparent)]
    Comparison(#[from] ComparisonError),
}

/// A run that is over: what its summary says, and the line that tells of trouble.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    pub summary: Summary,
    pub trouble: Option<String>,
}

/// What is run, and where it is written.
#[derive(Clone, Copy)]
pub struct Job<'a> {
    /// Named in the summary.
    pub case_path: &'a Path,
    pub scene: &'a Arc<Scene>,
    pub folder: &'a RunFolder,
    /// Steps after which, at the next row of diagnostics, a checkpoint is written; none is on the way where absent.
    pub checkpoint_every: Option<u64>,
}

/// Simulates a scene on `engine` and writes everything into the folder.
///
/// A run that diverges, and one that is interrupted, leave a complete folder too: of their last good state, and with a
/// checkpoint to go on from. That of a run that came to its end is removed.
pub fn run(job: Job<'_>, engine: &mut dyn Engine, observer: &mut dyn Observer) -> Result<Report, RunError> {
    let prepared = Instant::now();
    // Without time there is nothing to report on the way.
    let flows = job.scene.plan.flows;
    let rows = match flows {
        true => Some(DiagnosticsWriter::create(&job.folder.diagnostics(), probes(job.scene)?)?),
        false => None,
    };
    let moves = job.scene.plan.moves();
    let motion = moves.then(|| MotionWriter::create(job.folder, &job.scene.case)).transpose()?;
    let (info, history) = (engine.info(), Vec::new());
    let mut writer = Recorder { job, info, rows, motion, history, observer, kept: None, failed: None };
    let outcome = simulation::simulate(job.scene, engine, &mut writer)?;
    finish(writer, outcome, prepared)
}

/// Goes on with a run from a state that it was in: what it leaves is what it would have left without the interruption.
pub fn resume(
    job: Job<'_>,
    state: State,
    engine: &mut dyn Engine,
    observer: &mut dyn Observer,
) -> Result<Report, RunError> {
    let prepared = Instant::now();
    let (step, case) = (state.progress.step, &job.scene.case);
    let rows = Some(DiagnosticsWriter::resume(&job.folder.diagnostics(), step, probes(job.scene)?)?);
    let moved = state.progress.motion.map(|known| MotionWriter::resume(job.folder, case, step, known.frames));
    let (motion, history) = moved.transpose()?.map_or((None, Vec::new()), |(motion, rows)| (Some(motion), rows));
    let mut writer =
        Recorder { job, info: engine.info(), rows, motion, history, observer, kept: Some(step), failed: None };
    let outcome = simulation::resume(job.scene, engine, &mut writer, state)?;
    finish(writer, outcome, prepared)
}

/// Names of what the diagnostics have columns of their own for.
fn probes(scene: &Scene) -> Result<Vec<String>, RunError> {
    let probes = Probe::of_case(&scene.case, &scene.cloud.position).map_err(SimulationError::from)?;
    let solve = scene.case.implicit_viscosity().then(|| "viscous_iterations".to_owned());
    Ok(solve.into_iter().chain(probes.into_iter().map(|probe| probe.name)).collect())
}

fn finish(mut writer: Recorder<'_>, outcome: Outcome, prepared: Instant) -> Result<Report, RunError> {
    if matches!(outcome.stop, Stop::Interrupted | Stop::Trouble { .. }) {
        writer.write(&outcome.state);
    }
    let Recorder { job: Job { case_path, scene, folder, .. }, info, failed, history, .. } = writer;
    if let Some(error) = failed {
        return Err(error.into());
    }
    let profiles = profiles(&scene.case)?;
    let began = Instant::now();
    let snapshot = &outcome.snapshot;
    output::points::write(&folder.points(), snapshot)?;
    output::vtu::write(&folder.vtu(), snapshot)?;
    let mut summary = summarise(case_path, scene, &info, &outcome, &history, &profiles)?;
    // Before the pictures, lest they cost a run its numbers; and once more with the time that they took.
    summary.write(&folder.summary())?;
    if scene.case.output.pictures {
        draw(folder, &scene.case, snapshot, &profiles)?;
    }
    summary.seconds.output = began.elapsed().as_secs_f64();
    // The part of the setup before the operations: what is left of the time until now.
    let rest = prepared.elapsed().as_secs_f64() - summary.seconds.stepping - summary.seconds.output;
    summary.seconds.setup = summary.seconds.setup.max(rest);
    summary.write(&folder.summary())?;
    if matches!(outcome.stop, Stop::End | Stop::Steady) {
        folder.remove_checkpoint()?;
    }
    Ok(Report { trouble: trouble(&outcome, scene.case.motion() == Motion::Shifted), summary })
}

/// Draws the pictures of a run that is over from its files.
pub fn render(folder: &RunFolder) -> Result<Vec<PathBuf>, RunError> {
    let summary = Summary::read(&folder.summary())?;
    let snapshot = match summary.case.problem() {
        // Drawn from the case: its figures show what other operators give as well.
        Problem::Derivatives(_) => Snapshot::default(),
        _ => output::points::read(&folder.points(), summary.time)?,
    };
    draw(folder, &summary.case, &snapshot, &profiles(&summary.case)?)
}

/// The pictures of the case's problem.
fn draw(
    folder: &RunFolder,
    case: &Case,
    snapshot: &Snapshot,
    profiles: &BTreeMap<String, Profile>,
) -> Result<Vec<PathBuf>, RunError> {
    if case.moves() {
        let rows = output::motion::read(&folder.motion())?;
        let frames = Frames::open(&folder.frames())?;
        let film = Film { case, time: snapshot.time, rows: &rows, frames: &frames, front: front(case, profiles) };
        return Ok(output::picture::draw_film(folder, &film, snapshot)?);
    }
    match (case.problem(), Known::of(case)) {
        (Problem::Derivatives(_), Some(known)) => {
            Ok(output::picture::draw_comparison(folder, case, &known, &comparison::panels(case)?)?)
        }
        _ => Ok(output::picture::draw_all(folder, case, snapshot, profiles)?),
    }
}

/// The published course of the front, of the first expectation that has one.
fn front<'a>(case: &Case, profiles: &'a BTreeMap<String, Profile>) -> Option<&'a Profile> {
    let (name, _) = case.expect.iter().find(|(_, row)| row.measure == Measure::Front)?;
    profiles.get(name)
}

/// The published profiles of a case, by the name of their expectation.
pub fn profiles(case: &Case) -> Result<BTreeMap<String, Profile>, ReferenceError> {
    let mut profiles = BTreeMap::new();
    for (name, expectation) in &case.expect {
        if let Some(path) = &expectation.profile {
            profiles.insert(name.clone(), Profile::read(path, expectation.column.as_deref())?);
        }
    }
    Ok(profiles)
}

fn summarise(
    case_path: &Path,
    scene: &Scene,
    info: &EngineInfo,
    outcome: &Outcome,
    history: &[motion::Row],
    profiles: &BTreeMap<String, Profile>,
) -> Result<Summary, OutputError> {
    let real = if info.precision == "f32" { 4 } else { 8 };
    let [widened, lowered, nearest] = outcome.ladder;
    let mut warnings = outcome.warnings.clone();
    if outcome.fallbacks > 0 {
        warnings.push(format!("{} pressure solves stalled and were solved directly", outcome.fallbacks));
    }
    warnings.extend(motion::losses(history));
    if let Some(row) = history.last().filter(|row| row.bounded > 0) {
        warnings.push(format!("the way that the pressure pushed a point in a step was bounded {} times", row.bounded));
    }
    Ok(Summary {
        case_path: case_path.to_owned(),
        case: scene.case.clone(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        engine: info.engine.to_owned(),
        adapter: info.adapter.as_ref().map(|adapter| Adapter {
            name: adapter.name.clone(),
            driver: adapter.driver.clone(),
            driver_info: adapter.driver_info.clone(),
            backend: adapter.backend.clone(),
        }),
        precision: info.precision.to_owned(),
        points: scene.sizes.points,
        steps: outcome.steps,
        time: outcome.snapshot.time,
        stop: match outcome.stop {
            Stop::Steady => StopReason::Steady,
            Stop::End => StopReason::End,
            Stop::Interrupted => StopReason::Interrupted,
            Stop::Trouble { .. } => StopReason::Failed,
        },
        seconds: Seconds { setup: outcome.setup.as_secs_f64(), stepping: outcome.stepping.as_secs_f64(), output: 0.0 },
        fallbacks: Fallbacks { direct_solves: outcome.fallbacks, widened, lowered, nearest },
        iterations: outcome.iterations,
        warnings,
        bytes_per_point: scene.plan.total_bytes(&scene.sizes, real) as f64 / scene.sizes.points as f64,
        expect: evaluate_run(&scene.case, &outcome.snapshot, history, profiles)?,
    })
}

fn trouble(outcome: &Outcome, shifted: bool) -> Option<String> {
    let Stop::Trouble { trouble, step } = &outcome.stop else { return None };
    let kept = &outcome.state.progress;
    let tries = match kept.halvings {
        0 => String::new(),
        1 => ", with half the step too".to_owned(),
        halvings => format!(", with the step halved {halvings} times too"),
    };
    let remedy = match trouble {
        Trouble::Engine(EngineError::Device(_)) => "go on with it by `stillpoint resume`, or run it with --engine cpu",
        Trouble::Engine(_) => "try another effects.pressure.solver, or more regular points",
        Trouble::Energy { .. } => "try a smaller time.courant, a smaller cloud.spacing, or a larger guard.energy",
        Trouble::Diverged(_) if shifted => "try a smaller time.courant or time.step, or another cloud.spacing",
        Trouble::Diverged(_) => "try effects.advection.motion = \"shifted\", a smaller time.courant or time.step",
        Trouble::Grown { .. } => "try a time.courant between 0.1 and 0.2, or another cloud.spacing",
        Trouble::NonFinite { .. } | Trouble::Figure { .. } | Trouble::Refused(_) => {
            "try a smaller time.courant or a smaller cloud.spacing"
        }
    };
    Some(format!(
        "in or shortly before step {step} {trouble}{tries}; kept: the state after step {} at {} s; {remedy}",
        kept.step, kept.time
    ))
}

/// Writes every row before it shows it, and the states that are to be kept.
struct Recorder<'a> {
    job: Job<'a>,
    info: EngineInfo,
    rows: Option<DiagnosticsWriter>,
    motion: Option<MotionWriter>,
    history: Vec<motion::Row>,
    observer: &'a mut dyn Observer,
    /// The step of the last checkpoint.
    kept: Option<u64>,
    failed: Option<OutputError>,
}

impl Recorder<'_> {
    /// Writes a checkpoint, the rows before it first.
    fn write(&mut self, state: &State) {
        let Job { case_path, scene, folder, checkpoint_every } = self.job;
        let synced = self.rows.as_mut().map_or(Ok(()), DiagnosticsWriter::sync);
        let synced = synced.and_then(|()| self.motion.as_mut().map_or(Ok(()), MotionWriter::sync));
        let path = folder.checkpoint();
        let written =
            synced.and_then(|()| checkpoint::write(&path, case_path, &scene.case, &self.info, checkpoint_every, state));
        match written {
            Ok(()) => self.kept = Some(state.progress.step),
            Err(error) => drop(self.failed.get_or_insert(error)),
        }
    }
}

impl Observer for Recorder<'_> {
    fn report(&mut self, row: &Diagnostics) {
        if let Some(Err(error)) = self.rows.as_mut().map(|rows| rows.append(row)) {
            self.failed.get_or_insert(error);
        }
        self.observer.report(row);
    }

    fn moved(&mut self, row: &motion::Row) {
        if let Some(Err(error)) = self.motion.as_mut().map(|motion| motion.append(row)) {
            self.failed.get_or_insert(error);
        }
        self.history.push(row.clone());
        self.observer.moved(row);
    }

    fn frame(&mut self, snapshot: &Snapshot) {
        if let Some(Err(error)) = self.motion.as_mut().map(|motion| motion.keep(snapshot)) {
            self.failed.get_or_insert(error);
        }
        self.observer.frame(snapshot);
    }

    fn stop_requested(&self) -> bool {
        self.failed.is_some() || self.observer.stop_requested()
    }

    fn keep(&mut self, state: &State) {
        let due = |every: u64| self.kept.is_none_or(|kept| state.progress.step >= kept.saturating_add(every));
        if self.failed.is_none() && self.job.checkpoint_every.is_some_and(due) {
            self.write(state);
        }
    }
}
