//! What the GPU engine allocates is what the plan says, and little of its own.

use std::path::Path;
use std::sync::Arc;

use stillpoint::case::Case;
use stillpoint::gpu::Precision;
use stillpoint::scene::Scene;

use crate::engines::{candidate, gpu};

/// The engine's own arrays: tables and scalars of a few hundred bytes; sums of each 64 points, 24 bytes; 4 bytes a cell of
/// the search, of which there are fewer than points. Bytes, and bytes a point.
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
        let own = OWN.0 + OWN.1 * points;
        assert!((planned + 1..=planned + own).contains(&held), "{name}: {held} bytes, planned {planned}, own {own}");
        assert!(held <= 1024 * points, "{name}: {held} bytes for {points} points");
    }
}
