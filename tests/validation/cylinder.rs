//! The shipped cases whose points lie closer in places, as they are shipped: the cylinder at Re 20 and the cavity at Re 1000.
//!
//! Quantities, values, tolerances and sources are those of the case files.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use stillpoint::case::Case;
use stillpoint::cpu;
use stillpoint::measure::{ExpectationResult, evaluate};
use stillpoint::run::profiles;
use stillpoint::scene::Scene;
use stillpoint::simulation::{Stop, simulate};

fn measured(name: &str, overrides: &[&str]) -> (usize, BTreeMap<String, ExpectationResult>) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(name);
    let overrides: Vec<String> = overrides.iter().map(|given| (*given).to_owned()).collect();
    let case = Case::load(&path, &overrides).expect("a shipped case");
    let scene = Arc::new(Scene::build(&case).expect("a scene"));
    let outcome = simulate(&scene, cpu::double(&scene).expect("an engine").as_mut(), &mut ()).expect("a run");
    assert_eq!(outcome.stop, Stop::Steady, "{name}");
    assert_eq!((outcome.fallbacks, &outcome.warnings[..]), (0, &[][..]), "{name}");
    let rows = evaluate(&case, &outcome.snapshot, &profiles(&case).expect("profiles")).expect("measurements");
    (scene.sizes.points, rows.into_iter().map(|row| (row.name.clone(), row)).collect())
}

#[test]
fn every_published_value_is_met_on_few_points() {
    for (name, values, most) in [("cylinder_re20.toml", 2, 5500), ("cavity_re1000_graded.toml", 7, 4000)] {
        let (points, rows) = measured(name, &[]);
        assert!(rows.len() == values && points < most, "{name}: {} values, {points} points", rows.len());
        for row in rows.values() {
            let ExpectationResult { quantity, error, tolerance, .. } = row;
            assert!(row.pass, "{name}: {quantity} off by {error:?}, tolerance {tolerance}");
        }
    }
}

/// On coarse points even, so that it is quick.
#[test]
fn a_viscosity_a_tenth_too_large_misses_the_drag() {
    let coarse = ["cloud.arrangement=jittered", "cloud.spacing=0.01", "cloud.refine=[]"];
    let thick = [&coarse[..], &["effects.viscosity.kinematic=0.0011"]].concat();
    let (right, wrong) = (measured("cylinder_re20.toml", &coarse).1, measured("cylinder_re20.toml", &thick).1);
    assert!(right["drag"].pass && !wrong["drag"].pass, "{right:?} {wrong:?}");
}
