//! The GPU engine: the plan's operations as WGSL compute shaders, on any adapter that wgpu finds.
//!
//! A batch of steps is one submission. What would need the host's eyes, the end of a pressure solve above all, is decided
//! on the GPU: every dispatch takes its number of workgroups from a table that small kernels rewrite. See
//! `shaders/library/control.wgsl` for the states, [`batch`] for the host's side.

pub mod adapter;
mod batch;
mod bindings;
mod device;
mod engine;
mod grids;
mod launch;
mod layout;
mod memory;
mod prelude;
mod program;
mod self_test;
mod sources;
#[cfg(test)]
mod tests;
mod timer;
mod unrolled;

pub use device::Gpu;
pub use engine::GpuEngine;
pub use prelude::Precision;
