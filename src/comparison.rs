//! The paper's Fig. 1: the derivatives of one field by both families of operators, on a lattice and on scattered points.

use std::sync::Arc;

use glam::DVec2;

use crate::case::{Arrangement, Case, Component, DEFAULT_JITTER, Operators};
use crate::cpu;
use crate::engine::EngineError;
use crate::known::Known;
use crate::measure::FieldError;
use crate::scene::{Scene, SceneError};
use crate::simulation::{SimulationError, simulate};
use crate::snapshot::Derivatives;

/// One family on one arrangement.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    pub operators: Operators,
    pub arrangement: Arrangement,
    /// m
    pub position: Vec<DVec2>,
    pub derivatives: Derivatives,
    /// Rms error over the rms of the exact values.
    pub gradient_error: f64,
    /// The same; `None` for fits of order 1.
    pub laplacian_error: Option<f64>,
}

/// Why the four could not be computed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ComparisonError {
    #[error(transparent)]
    Scene(#[from] SceneError),
    #[error(transparent)]
    Engine(#[from] EngineError),
    #[error(transparent)]
    Simulation(#[from] SimulationError),
}

/// Integral and interpolation form, each on a lattice and on the points of the case (jittered ones where it has a lattice),
/// on the CPU engine in f64. Empty for a case that is not about derivatives.
pub fn panels(case: &Case) -> Result<Vec<Panel>, ComparisonError> {
    let Some(known) = Known::of(case).filter(|_| case.derivatives.is_some()) else { return Ok(Vec::new()) };
    let mut panels = Vec::new();
    for operators in [Operators::Integral, Operators::Interpolation] {
        let mut lattice = case.clone();
        lattice.method.operators = operators;
        let mut scattered = lattice.clone();
        lattice.cloud.arrangement = Arrangement::Regular;
        if scattered.cloud.arrangement == Arrangement::Regular {
            (scattered.cloud.arrangement, scattered.cloud.jitter) = (Arrangement::Jittered, Some(DEFAULT_JITTER));
        }
        panels.extend([panel(&lattice, &known)?, panel(&scattered, &known)?]);
    }
    Ok(panels)
}

fn panel(case: &Case, known: &Known) -> Result<Panel, ComparisonError> {
    let scene = Arc::new(Scene::build(case)?);
    let outcome = simulate(&scene, cpu::double(&scene)?.as_mut(), &mut ())?;
    let snapshot = outcome.snapshot;
    let error = |component| {
        let FieldError { difference, exact } = FieldError::of_known(&snapshot, known, component);
        difference / exact
    };
    let (gradient_error, laplacian_error) = (error(Component::Gradient), error(Component::Laplacian));
    let derivatives = snapshot.derivatives.unwrap_or_default();
    Ok(Panel {
        operators: case.method.operators,
        arrangement: case.cloud.arrangement,
        position: snapshot.position,
        laplacian_error: (!derivatives.laplacian.is_empty()).then_some(laplacian_error),
        derivatives,
        gradient_error,
    })
}
