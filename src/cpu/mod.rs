//! The CPU engine: the operations on slices of `f32` or `f64`, several points side by side in a register, on all cores.

pub mod blocks;
mod engine;
mod fields;
mod gather;
pub mod operations;
pub mod real;

pub use engine::CpuEngine;
