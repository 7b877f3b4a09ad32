//! A case run into a folder: the engine chosen, the scene simulated, the files written, the expectations judged.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use crate::case::{Case, Problem, Profile, ReferenceError};
use crate::comparison::{self, ComparisonError};
use crate::engine::{Engine, EngineInfo};
use crate::known::Known;
use crate::measure::{Probe, evaluate};
use crate::output::{
    self, Adapter, DiagnosticsWriter, Fallbacks, OutputError, RunFolder, Seconds, StopReason, Summary,
};
use crate::scene::Scene;
use crate::simulation::{self, Diagnostics, Observer, Outcome, SimulationError, Stop};
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

/// Simulates `scene` on `engine` and writes everything into `folder`. `case_path` is named in the summary.
///
/// A run that diverges, and one that is interrupted, leave a complete folder too: of their last good state.
pub fn run(
    case_path: &Path,
    scene: &Arc<Scene>,
    engine: &mut dyn Engine,
    folder: &RunFolder,
    observer: &mut dyn Observer,
) -> Result<Report, RunError> {
    let prepared = Instant::now();
    // Without time there is nothing to report on the way.
    let probes = Probe::of_case(&scene.case, &scene.cloud.position).map_err(SimulationError::from)?;
    let probes = probes.into_iter().map(|probe| probe.name).collect();
    let rows = scene.plan.flows.then(|| DiagnosticsWriter::create(&folder.diagnostics(), probes)).transpose()?;
    let mut writer = Recorder { rows, observer, failed: None };
    let outcome = simulation::simulate(scene, engine, &mut writer)?;
    if let Some(error) = writer.failed {
        return Err(error.into());
    }
    let info = engine.info();
    let profiles = profiles(&scene.case)?;
    let began = Instant::now();
    let snapshot = &outcome.snapshot;
    output::points::write(&folder.points(), snapshot)?;
    output::vtu::write(&folder.vtu(), snapshot)?;
    let mut summary = summarise(case_path, scene, &info, &outcome, &profiles)?;
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
    Ok(Report { trouble: trouble(&outcome), summary })
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
    match (case.problem(), Known::of(case)) {
        (Problem::Derivatives(_), Some(known)) => {
            Ok(output::picture::draw_comparison(folder, case, &known, &comparison::panels(case)?)?)
        }
        _ => Ok(output::picture::draw_all(folder, case, snapshot, profiles)?),
    }
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
    profiles: &BTreeMap<String, Profile>,
) -> Result<Summary, OutputError> {
    let real = if info.precision == "f32" { 4 } else { 8 };
    let [widened, lowered, nearest] = outcome.ladder;
    let mut warnings = outcome.warnings.clone();
    if outcome.fallbacks > 0 {
        warnings.push(format!("{} pressure solves stalled and were solved directly", outcome.fallbacks));
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
            Stop::NonFinite { .. } => StopReason::Failed,
        },
        seconds: Seconds { setup: outcome.setup.as_secs_f64(), stepping: outcome.stepping.as_secs_f64(), output: 0.0 },
        fallbacks: Fallbacks { direct_solves: outcome.fallbacks, widened, lowered, nearest },
        iterations: outcome.iterations,
        warnings,
        bytes_per_point: scene.plan.total_bytes(&scene.sizes, real) as f64 / scene.sizes.points as f64,
        expect: evaluate(&scene.case, &outcome.snapshot, profiles)?,
    })
}

fn trouble(outcome: &Outcome) -> Option<String> {
    let Stop::NonFinite { field, place, step } = &outcome.stop else { return None };
    Some(format!(
        "{} of point {} at ({}, {}) m turned non-finite in or shortly before step {step}; kept: the state at {} s; try a smaller time.courant",
        field.buffer.name(),
        field.point,
        place.x,
        place.y,
        outcome.snapshot.time,
    ))
}

/// Writes every row before it shows it.
struct Recorder<'a> {
    rows: Option<DiagnosticsWriter>,
    observer: &'a mut dyn Observer,
    failed: Option<OutputError>,
}

impl Observer for Recorder<'_> {
    fn report(&mut self, row: &Diagnostics) {
        if let Some(Err(error)) = self.rows.as_mut().map(|rows| rows.append(row)) {
            self.failed.get_or_insert(error);
        }
        self.observer.report(row);
    }

    fn stop_requested(&self) -> bool {
        self.failed.is_some() || self.observer.stop_requested()
    }
}
