//! A flow that is run to see how it ends.

use std::sync::Arc;

use stillpoint::case::Case;
use stillpoint::cloud::Cloud;
use stillpoint::cpu;
use stillpoint::engine::{Engine, EngineError};
use stillpoint::scene::Scene;
use stillpoint::simulation::{Diagnostics, Outcome, Stop, simulate};

use crate::rows::Rows;

pub type Open = fn(&Arc<Scene>) -> Result<Box<dyn Engine>, EngineError>;

/// How it ended, and the figures on the way.
pub struct Flow {
    pub scene: Arc<Scene>,
    pub outcome: Outcome,
    pub rows: Vec<Diagnostics>,
}

/// Runs a case, or says in one line why not.
pub fn flow(case: &Case, cloud: Option<Cloud>, open: Open) -> Result<Flow, String> {
    let scene = match cloud {
        Some(cloud) => Scene::with_cloud(case, cloud),
        None => Scene::build(case),
    };
    run(scene.map_err(|error| error.to_string())?, open)
}

fn run(scene: Scene, open: Open) -> Result<Flow, String> {
    let scene = Arc::new(scene);
    let mut engine = open(&scene).map_err(|error| error.to_string())?;
    flow_on(&scene, engine.as_mut())
}

/// The same on an engine at hand.
pub fn flow_on(scene: &Arc<Scene>, engine: &mut dyn Engine) -> Result<Flow, String> {
    let mut rows = Rows::default();
    let outcome = simulate(scene, engine, &mut rows).map_err(|error| error.to_string())?;
    Ok(Flow { scene: Arc::clone(scene), outcome, rows: rows.rows })
}

/// On the CPU in f64.
pub fn flow_of(case: &Case) -> Result<Flow, String> {
    flow(case, None, cpu::double)
}

impl Flow {
    /// Nothing that it leaves is other than a finite number.
    pub fn is_finite(&self) -> bool {
        let snapshot = &self.outcome.snapshot;
        let figures = |row: &Diagnostics| [row.kinetic_energy, row.max_speed, row.divergence, row.residual, row.change];
        snapshot.velocity.iter().all(|u| u.is_finite())
            && snapshot.pressure.iter().all(|p| p.is_finite())
            && self.rows.iter().flat_map(figures).all(f64::is_finite)
            && self.outcome.state.non_finite(&self.scene).is_none()
    }

    /// It came to its end.
    pub fn ended(&self) -> bool {
        matches!(self.outcome.stop, Stop::End | Stop::Steady)
    }

    /// m^4/s^2, at the end.
    pub fn energy(&self) -> f64 {
        self.rows.last().map_or(0.0, |row| row.kinetic_energy)
    }

    /// The most that there was, over that of the whole domain moving as fast as its walls, or its fluid at first.
    pub fn most_energy(&self) -> f64 {
        let most = self.rows.iter().map(|row| row.kinetic_energy).fold(0.0, f64::max);
        most / self.scene.energy_scale().unwrap_or(1.0)
    }

    /// In words.
    pub fn end(&self) -> String {
        match &self.outcome.stop {
            Stop::End => "end of time".to_owned(),
            Stop::Steady => "steady".to_owned(),
            Stop::Interrupted => "interrupted".to_owned(),
            Stop::Trouble { trouble, step } => format!("stopped at step {step}: {trouble}"),
        }
    }
}
