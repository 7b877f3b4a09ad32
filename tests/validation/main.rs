//! Whole flows against published values: case, quantity, published value, tolerance, source.

mod cavity;
mod cylinder;
mod known;
mod moving;
