//! The shipped cavities at Re 100: their published values, and the order at which the errors along both centrelines fall.
//!
//! Quantities, values and tolerances are those of the case files and the profiles beside them: spectral elements, which agree with O. Botella,
//! R. Peyret, Computers & Fluids 27 (1998) 421-433; and U. Ghia, K.N. Ghia, C.T. Shin, J. Comput. Phys. 48 (1982) 387-411.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use stillpoint::case::Case;
use stillpoint::cpu;
use stillpoint::measure::{ExpectationResult, evaluate};
use stillpoint::run::profiles;
use stillpoint::scene::Scene;
use stillpoint::simulation::{Stop, simulate};

/// What the case measures by the name of its expectation, of the steady flow with `n` spacings a side.
fn measured(name: &str, n: usize, overrides: &[&str]) -> BTreeMap<String, ExpectationResult> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(name);
    let spacing = format!("cloud.spacing={:e}", 1.0 / n as f64);
    let overrides: Vec<String> = overrides.iter().map(|given| (*given).to_owned()).chain([spacing]).collect();
    let case = Case::load(&path, &overrides).expect("a shipped case");
    let scene = Arc::new(Scene::build(&case).expect("a scene"));
    let mut engine = cpu::single(&scene).expect("an engine");
    let outcome = simulate(&scene, engine.as_mut(), &mut ()).expect("a run");
    assert_eq!(outcome.stop, Stop::Steady, "{name} at 1/{n}");
    assert_eq!((outcome.fallbacks, &outcome.warnings[..]), (0, &[][..]), "{name} at 1/{n}");
    let profiles = profiles(&case).expect("profiles");
    let results = evaluate(&case, &outcome.snapshot, &profiles).expect("measurements");
    results.into_iter().map(|row| (row.name.clone(), row)).collect()
}

fn error(rows: &BTreeMap<String, ExpectationResult>, name: &str) -> f64 {
    rows[name].error.expect("a finite measurement")
}

const CASES: [&str; 2] = ["cavity_re100_regular.toml", "cavity_re100_random.toml"];

#[test]
fn at_re_100_every_published_value_is_met_and_errors_fall_at_order_one_and_a_half() {
    for name in CASES {
        let (coarse, fine) = (measured(name, 16, &[]), measured(name, 64, &[]));
        assert!(fine.len() >= 7, "{name}: {} published values", fine.len());
        for row in fine.values() {
            assert!(
                row.pass,
                "{name}: {} off by {:?}, tolerance {}; {}",
                row.quantity, row.error, row.tolerance, row.source
            );
        }
        for profile in ["u_profile", "v_profile"] {
            let (from, to) = (error(&coarse, profile), error(&fine, profile));
            let order = 0.5 * (from / to).log2();
            assert!(order >= 1.5, "{name}, {profile}: order {order}, from {from} to {to}");
        }
    }
}

/// The paper's scheme. At 1/32 a multiplier in all rows, walls' too, has no bound.
#[test]
fn the_papers_pressure_comes_to_rest_on_coarse_points() {
    let errors = [24, 32, 40].map(|n| error(&measured("cavity_re100_paper.toml", n, &[]), "u_profile"));
    assert!(errors.windows(2).all(|pair| pair[1] < 0.75 * pair[0]) && errors[2] < 0.003, "{errors:?}");
}

#[test]
fn a_viscosity_a_tenth_too_large_misses_a_published_profile() {
    for name in CASES {
        let (right, wrong) = (measured(name, 32, &[]), measured(name, 32, &["effects.viscosity.kinematic=0.011"]));
        assert!(!wrong["v_profile"].pass, "{name}: {wrong:?}");
        assert!(error(&wrong, "v_profile") > 2.0 * error(&right, "v_profile"), "{name}: {wrong:?}");
    }
}
