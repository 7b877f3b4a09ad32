//! Which engine runs a scene, from what the command line asks for.

use std::io::{self, Write};
use std::sync::Arc;

use super::CliError;
use super::args::{EngineChoice, Precision, RunArguments};
use crate::cpu;
use crate::engine::{Engine, EngineError};
use crate::gpu::adapter::{self, Candidate};
use crate::gpu::{self, Gpu, GpuEngine};
use crate::output::checkpoint::Head;
use crate::scene::Scene;

/// Opens the engine asked for; `auto` takes a hardware GPU if there is one, else the CPU, which beats a software one. A
/// hardware GPU that will not open, or that the scene does not fit on, leaves `auto` to the CPU too, with a note that says why.
pub(super) fn open(scene: &Arc<Scene>, arguments: &RunArguments) -> Result<Box<dyn Engine>, CliError> {
    let Asked { engine, adapter, precision } = Asked::new(arguments)?;
    match engine {
        EngineChoice::Cpu => Ok(on_cpu(scene, precision)?),
        EngineChoice::Gpu => Ok(on_gpu(scene, &adapter::choose(adapter)?, precision)?),
        EngineChoice::Auto => {
            let hardware = adapter::list().into_iter().find(|candidate| !candidate.info.software);
            match hardware.map(|candidate| (on_gpu(scene, &candidate, precision), candidate.info.name)) {
                Some((Ok(engine), _)) => Ok(engine),
                Some((Err(error), name)) => {
                    // A closed standard error leaves the summary to tell which engine it was.
                    let _ = writeln!(io::stderr(), "note: on the CPU, for {name} will not do: {error}");
                    Ok(on_cpu(scene, precision)?)
                }
                None => Ok(on_cpu(scene, precision)?),
            }
        }
    }
}

/// Opens the engine that a checkpoint was written by: no other goes on to the same bits.
pub(super) fn reopen(scene: &Arc<Scene>, head: &Head) -> Result<Box<dyn Engine>, CliError> {
    let precision = match head.precision.as_str() {
        "f32" => Precision::F32,
        "f64" => Precision::F64,
        other => return Err(CliError::UnknownEngine(format!("{other} numbers"))),
    };
    match head.engine.as_str() {
        "cpu" => Ok(on_cpu(scene, Some(precision))?),
        "gpu" => Ok(on_gpu(scene, &adapter::choose(head.adapter.as_deref())?, Some(precision))?),
        other => Err(CliError::UnknownEngine(other.to_owned())),
    }
}

struct Asked<'a> {
    engine: EngineChoice,
    adapter: Option<&'a str>,
    precision: Option<Precision>,
}

impl<'a> Asked<'a> {
    /// Naming an adapter asks for the GPU.
    fn new(arguments: &'a RunArguments) -> Result<Self, CliError> {
        let RunArguments { engine, adapter, precision, .. } = arguments;
        let engine = match (engine, adapter) {
            (EngineChoice::Cpu, Some(_)) => return Err(CliError::AdapterOnCpu),
            (EngineChoice::Auto, Some(_)) => EngineChoice::Gpu,
            (engine, _) => *engine,
        };
        Ok(Self { engine, adapter: adapter.as_deref(), precision: *precision })
    }
}

fn on_cpu(scene: &Arc<Scene>, precision: Option<Precision>) -> Result<Box<dyn Engine>, EngineError> {
    match precision.unwrap_or(Precision::F64) {
        Precision::F32 => cpu::single(scene),
        Precision::F64 => cpu::double(scene),
    }
}

fn on_gpu(
    scene: &Arc<Scene>,
    candidate: &Candidate,
    precision: Option<Precision>,
) -> Result<Box<dyn Engine>, EngineError> {
    let precision = match precision.unwrap_or(Precision::F32) {
        Precision::F32 => gpu::Precision::Single,
        Precision::F64 => gpu::Precision::Double,
    };
    Ok(Box::new(GpuEngine::new(Arc::clone(scene), Gpu::open(candidate, precision)?)?))
}
