//! The CPU engine: the operations on slices of `f32` or `f64`, several points side by side in a register, on all cores.

pub mod blocks;
mod compact;
mod engine;
mod fields;
mod gather;
pub mod operations;
pub mod real;
mod unrolled;

use std::sync::Arc;

use crate::engine::{Engine, EngineError};
use crate::scene::Scene;

pub use engine::CpuEngine;

/// A CPU engine in `f32`. Callers that go through [`Engine`] compile none of the generic operations again.
pub fn single(scene: &Arc<Scene>) -> Result<Box<dyn Engine>, EngineError> {
    Ok(Box::new(CpuEngine::<f32>::new(Arc::clone(scene))?))
}

/// The same in `f64`.
pub fn double(scene: &Arc<Scene>) -> Result<Box<dyn Engine>, EngineError> {
    Ok(Box::new(CpuEngine::<f64>::new(Arc::clone(scene))?))
}
