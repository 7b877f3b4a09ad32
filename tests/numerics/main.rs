//! The numerics by their properties: exactness, orders of convergence, conservation, symmetry, repeatability.

#[path = "../support/bench.rs"]
mod bench;
#[path = "../support/cases.rs"]
mod cases;
#[path = "../support/random.rs"]
mod random;
#[path = "../support/rows.rs"]
mod rows;
#[path = "../support/spoiled.rs"]
mod spoiled;

mod aggregates;
mod carried;
mod carried_around;
mod clouds;
mod coarse;
mod drag;
mod energy;
mod exact;
mod fallback;
mod flux;
mod forces;
mod grading;
mod gravity;
mod ladder;
mod least_squares;
mod matrix;
mod memory;
mod obstacles;
mod options;
mod orders;
mod poisson;
mod remap;
mod repeatability;
mod runs;
mod sides;
mod viscosity;
mod voronoi;
