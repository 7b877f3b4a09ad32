//! The shipped cases whose answer is known in closed form, as they are shipped: flows, derivatives, the Poisson equation.
//!
//! Quantities, tolerances and sources are those of the case files.

use std::path::Path;
use std::sync::Arc;

use stillpoint::case::Case;
use stillpoint::cpu;
use stillpoint::measure::{ExpectationResult, evaluate};
use stillpoint::run::profiles;
use stillpoint::scene::Scene;
use stillpoint::simulation::simulate;

fn measured(name: &str, overrides: &[&str]) -> Vec<ExpectationResult> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(name);
    let overrides: Vec<String> = overrides.iter().map(|given| (*given).to_owned()).collect();
    let case = Case::load(&path, &overrides).expect("a shipped case");
    let scene = Arc::new(Scene::build(&case).expect("a scene"));
    let outcome = simulate(&scene, cpu::double(&scene).expect("an engine").as_mut(), &mut ()).expect("a run");
    assert_eq!((outcome.fallbacks, &outcome.warnings[..]), (0, &[][..]), "{name}");
    evaluate(&case, &outcome.snapshot, &profiles(&case).expect("profiles")).expect("measurements")
}

const CASES: [&str; 12] = [
    "taylor_green.toml",
    "kovasznay.toml",
    "derivatives.toml",
    "poisson.toml",
    "couette.toml",
    "poiseuille.toml",
    "conduction.toml",
    "rotating_tracer.toml",
    "channel.toml",
    "stokes_cavity.toml",
    "creeping_cavity.toml",
    "brinkman.toml",
];

#[test]
fn every_error_is_within_its_tolerance() {
    for name in CASES {
        let rows = measured(name, &[]);
        assert!(!rows.is_empty(), "{name} expects nothing");
        for row in rows {
            assert!(row.pass, "{name}: {} is {:?}, tolerance {}", row.quantity, row.error, row.tolerance);
        }
    }
}

/// What would spoil each is seen.
#[test]
fn errors_beyond_their_tolerance_are_missed() {
    for (name, spoiled) in [
        ("taylor_green.toml", "effects.pressure.divergence=faces"),
        ("kovasznay.toml", "effects.pressure.divergence=faces"),
        ("derivatives.toml", "method.operators=integral"),
        ("poisson.toml", "cloud.spacing=0.1"),
        ("couette.toml", "cloud.spacing=0.0625"),
        ("poiseuille.toml", "cloud.spacing=0.0625"),
        ("conduction.toml", "cloud.spacing=0.0625"),
        ("rotating_tracer.toml", "method.order=2"),
        ("stokes_cavity.toml", "cloud.spacing=0.125"),
        ("creeping_cavity.toml", "cloud.spacing=0.1"),
        ("brinkman.toml", "effects.drag.permeability=0.011"),
    ] {
        assert!(measured(name, &[spoiled]).iter().all(|row| !row.pass), "{name} with {spoiled}");
    }
}

/// A channel that slips has no parabola, and one of another viscosity another pressure.
#[test]
fn a_channel_that_is_not_poiseuilles_is_missed() {
    for (spoiled, missed) in [
        ("boundaries.left.profile=uniform", &["u_middle", "u_outlet", "pressure"][..]),
        ("effects.viscosity.kinematic=0.06", &["pressure"]),
    ] {
        let rows = measured("channel.toml", &[spoiled, "cloud.spacing=0.0625"]);
        let found: Vec<_> = rows.iter().filter(|row| !row.pass).map(|row| row.name.as_str()).collect();
        assert!(missed.iter().all(|name| found.contains(name)), "{spoiled}: {found:?} alone");
    }
}

/// Air heated from the side, on fewer points than is shipped: de Vahl Davis's values all the same, and without its weight none.
#[test]
fn a_heated_cavity_gives_the_published_values() {
    for row in measured("heated_cavity_ra1e3.toml", &["cloud.spacing=0.03125"]) {
        assert!(row.pass, "{}: {:?}", row.quantity, row.error);
    }
    let lighter = measured("heated_cavity_ra1e3.toml", &["cloud.spacing=0.03125", "effects.buoyancy.expansion=0.9"]);
    assert!(lighter.iter().filter(|row| row.name != "nusselt").all(|row| !row.pass), "{lighter:?}");
}
