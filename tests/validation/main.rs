//! Whole flows against published values: case, quantity, published value, tolerance, source.

#[path = "../support/rows.rs"]
mod rows;

mod cavity;
mod cylinder;
mod known;
mod moving;
