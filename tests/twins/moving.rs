//! Whole runs of points that move: the front and the energies of a collapse are the same on both engines.

use std::path::Path;
use std::sync::Arc;

use stillpoint::case::Case;
use stillpoint::cpu;
use stillpoint::engine::Engine;
use stillpoint::gpu::Precision;
use stillpoint::motion::Row;
use stillpoint::scene::Scene;
use stillpoint::simulation::{Stop, simulate};

use crate::engines::{candidate, gpu};
use crate::rows::Rows;

/// A column ten spacings wide and twice as high, 100 steps of its collapse.
const SHORT: [&str; 4] =
    ["cloud.spacing=0.005715", "time.step=0.001", "time.end=0.1", "effects.pressure.tolerance=1e-12"];

/// Largest difference in the front, over the column's breadth, and in either energy, over the potential one at the start: in
/// f64, and between f32 and f64. Measured in f64: 1e-14 (MPS) and 1e-10 (shifted points), in f32 3e-6
/// and 9e-4.
const DOUBLE: f64 = 1e-6;
const SINGLE: f64 = 5e-3;

fn collapse(name: &str, changes: &[&str]) -> Arc<Scene> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(name);
    let changes: Vec<String> = SHORT.iter().chain(changes).map(|&change| change.to_owned()).collect();
    Arc::new(Scene::build(&Case::load(&path, &changes).expect("a shipped case")).expect("a scene"))
}

fn rows(scene: &Scene, engine: &mut dyn Engine) -> Vec<Row> {
    let mut rows = Rows::default();
    let outcome = simulate(scene, engine, &mut rows).expect("a run");
    assert_eq!((outcome.stop, outcome.steps), (Stop::End, 100));
    rows.moved
}

/// The largest differences of front and energies over all rows, relative.
fn differences(scene: &Scene, ours: &[Row], theirs: &[Row]) -> [(&'static str, f64); 3] {
    assert_eq!(ours.len(), theirs.len());
    let breadth = scene.case.cloud.fill.as_ref().expect("a fill").to[0];
    let start = theirs[0].potential_energy;
    let largest = |of: &dyn Fn(&Row) -> f64, size: f64| {
        ours.iter().zip(theirs).map(|(a, b)| (of(a) - of(b)).abs() / size).fold(0.0, f64::max)
    };
    [
        ("front", largest(&|row| row.front, breadth)),
        ("kinetic energy", largest(&|row| row.kinetic_energy, start)),
        ("potential energy", largest(&|row| row.potential_energy, start)),
    ]
}

#[test]
fn a_collapse_has_the_same_front_and_energies_on_both_engines() {
    let Some(candidate) = candidate() else { return };
    for name in ["dam_break_mps.toml", "dam_break_shifted.toml"] {
        let scene = collapse(name, &[]);
        let theirs = rows(&scene, cpu::double(&scene).expect("an engine").as_mut());
        // Something happens: the front is on its way, with a share of the energy.
        let last = theirs.last().expect("rows");
        assert!(last.front > 1.5 * theirs[0].front && last.kinetic_energy > 0.1 * theirs[0].potential_energy);
        let held = |ours: &[Row], bound: f64, precision: &str| {
            for (quantity, difference) in differences(&scene, ours, &theirs) {
                assert!(difference < bound, "{name}, {precision}: {quantity} {difference:e} off");
            }
        };
        held(&rows(&scene, &mut gpu(&candidate, &scene, Precision::Single)), SINGLE, "f32");
        if candidate.double_precision {
            held(&rows(&scene, &mut gpu(&candidate, &scene, Precision::Double)), DOUBLE, "f64");
        }
        // What is held sees a change of a hundredth in the fluid's weight.
        let heavier = collapse(name, &["effects.gravity.acceleration=[0.0, -9.82]"]);
        let other = rows(&heavier, cpu::double(&heavier).expect("an engine").as_mut());
        assert!(differences(&scene, &other, &theirs).iter().all(|(_, difference)| *difference > DOUBLE));
    }
}
