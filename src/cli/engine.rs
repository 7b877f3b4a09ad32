//! Which engine runs a scene, from what the command line asks for.

use std::sync::Arc;

use super::CliError;
use super::args::{EngineChoice, Precision, RunArguments};
use crate::cpu::CpuEngine;
use crate::engine::{Engine, EngineError};
use crate::scene::Scene;

/// Opens the engine asked for; `auto` takes a hardware GPU if there is one, else the CPU.
pub(super) fn open(scene: &Arc<Scene>, arguments: &RunArguments) -> Result<Box<dyn Engine>, CliError> {
    match arguments.engine {
        EngineChoice::Gpu => Err(EngineError::Adapter("no GPU engine in this build".to_owned()).into()),
        EngineChoice::Cpu | EngineChoice::Auto => Ok(cpu(scene, arguments.precision)?),
    }
}

fn cpu(scene: &Arc<Scene>, precision: Option<Precision>) -> Result<Box<dyn Engine>, EngineError> {
    Ok(match precision.unwrap_or(Precision::F64) {
        Precision::F32 => Box::new(CpuEngine::<f32>::new(Arc::clone(scene))?),
        Precision::F64 => Box::new(CpuEngine::<f64>::new(Arc::clone(scene))?),
    })
}
