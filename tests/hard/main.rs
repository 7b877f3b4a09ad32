//! What may not go wrong: runs that are killed, files of any content, scenes at the edge of what the method can do.
//!
//! Quick parts of each run with the other tests. The whole of them, some minutes:
//! `cargo test --release --test hard -- --ignored --nocapture`.

#[path = "../support/adapter.rs"]
mod adapter;
#[path = "../support/cases.rs"]
mod cases;
#[path = "../support/hostile.rs"]
mod hostile;
#[path = "../support/random.rs"]
mod random;
#[path = "../support/rows.rs"]
mod rows;
#[path = "../support/spoiled.rs"]
mod spoiled;

mod checkpoints;
mod columns;
mod files;
mod flow;
mod folders;
mod guards;
mod kills;
mod price;
mod resuming;
mod scenes;
mod soak;
mod table;
mod table_of_input;
mod table_of_motion;
mod table_of_points;
mod table_of_pressure;
mod table_of_shapes;
mod table_of_time;
mod table_on_gpu;

/// Of the project.
const ROOT: &str = env!("CARGO_MANIFEST_DIR");
