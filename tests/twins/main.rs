//! The two engines against each other: the same operations on the same numbers, and whole runs.
//!
//! Three engines take part: CPU f64, CPU f32, GPU f32. CPU f32 differs from CPU f64 by rounding alone, which says how far GPU
//! f32 may lie from CPU f32; what is beyond that is an error of logic.

#[path = "../support/adapter.rs"]
mod adapter;
#[path = "../support/cases.rs"]
mod cases;
#[path = "../support/rows.rs"]
mod rows;
#[path = "../support/spoiled.rs"]
mod spoiled;

mod compare;
mod coverage;
mod engines;
mod forms;
mod memory;
mod moving;
mod operations;
mod runs;
mod scenes;
mod state;
mod times;
mod trouble;
