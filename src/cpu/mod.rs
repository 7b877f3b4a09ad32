//! The CPU engine.

pub mod blocks;
pub mod operations;
pub mod real;
