//! What the GPU engine allocates is what the plan says, and little of its own.

use std::path::Path;
use std::sync::Arc;

use stillpoint::case::Case;
use stillpoint::engine::Engine;
use stillpoint::gpu::Precision;
use stillpoint::scene::Scene;

use crate::engines::{candidate, gpu};

/// The engine's own arrays: tables and scalars of a few hundred bytes; sums of each 64 points, 24 bytes; 4 bytes a cell of
/// the search, of which there are fewer than points. Bytes, and bytes a point; three numbers a place of the coarse pressure beside.
const OWN: (u64, u64) = (1024, 4);

#[test]
fn the_shipped_cavities_take_what_their_plan_says_and_a_kilobyte_a_point_at_most() {
    let Some(candidate) = candidate() else { return };
    for name in ["cavity_re100_regular.toml", "cavity_re100_random.toml"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(name);
        let scene = Arc::new(Scene::build(&Case::load(&path, &[]).expect("a shipped case")).expect("a scene"));
        let points = scene.sizes.points as u64;
        let held = gpu(&candidate, &scene, Precision::Single).allocated_bytes();
        let planned = scene.plan.total_bytes(&scene.sizes, Precision::Single.bytes()) as u64;
        let coarse = (3 * Precision::Single.bytes() * scene.sizes.coarse) as u64;
        let own = OWN.0 + OWN.1 * points + coarse;
        assert!((planned + 1..=planned + own).contains(&held), "{name}: {held} bytes, planned {planned}, own {own}");
        assert!(held <= 1024 * points, "{name}: {held} bytes for {points} points");
    }
}

/// The same of points that move, whose tank has more cells than it has points: 4 bytes a cell, and as many again for each 64; three
/// numbers a place of the coarse pressure's grids, and four of its sums for each 64 cells of the finest.
fn moving_takes_what_its_plan_says(name: &str, spacing: &str, least: usize) {
    let Some(candidate) = candidate() else { return };
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(name);
    let case = Case::load(&path, &[format!("cloud.spacing={spacing}")]).expect("a shipped case");
    let scene = Arc::new(Scene::build(&case).expect("a scene"));
    let (points, cells) = (scene.sizes.points as u64, scene.sizes.cells as u64);
    assert!(scene.sizes.interior >= least, "{name}: {} points", scene.sizes.interior);
    let mut engine = gpu(&candidate, &scene, Precision::Single);
    let planned = scene.plan.total_bytes(&scene.sizes, Precision::Single.bytes()) as u64;
    let coarse = (3 * Precision::Single.bytes() * scene.sizes.coarse) as u64;
    let sums = (4 * Precision::Single.bytes()) as u64 * cells.div_ceil(64);
    let own = OWN.0 + points / 2 + 4 * cells + cells / 16 + coarse + sums;
    let held = engine.allocated_bytes();
    assert!((planned + 1..=planned + own).contains(&held), "{name}: {held} bytes, planned {planned}, own {own}");
    // A step takes none.
    engine.advance(1, &scene.clock(1e-5)).expect("a step");
    assert_eq!(engine.allocated_bytes(), held, "{name}");
    assert!(planned <= 1024 * points, "{name}: {planned} bytes for {points} points");
}

#[test]
fn points_that_move_take_what_their_plan_says_and_a_kilobyte_each_at_most() {
    moving_takes_what_its_plan_says("dam_break_mps.toml", "0.002857500", 800);
    moving_takes_what_its_plan_says("dam_break_shifted.toml", "0.002857500", 800);
}

#[test]
#[ignore = "half a minute"]
fn a_hundred_thousand_points_that_move_take_what_their_plan_says() {
    moving_takes_what_its_plan_says("dam_break_mps.toml", "0.000254", 100_000);
    moving_takes_what_its_plan_says("dam_break_shifted.toml", "0.000254", 100_000);
}
