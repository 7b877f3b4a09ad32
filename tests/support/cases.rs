//! The lid-driven cavity as a text, from which every test makes its case as `--set` would.

use std::path::Path;

use stillpoint::case::Case;

const CAVITY: &str = r#"
title = "Cavity"
domain = { width = 1.0, height = 1.0 }
cloud = { arrangement = "regular", spacing = 0.05 }
fluid = { density = 1.0 }
boundaries = { top = { velocity = [1.0, 0.0] } }
effects = { viscosity = { kinematic = 0.01 }, pressure = {}, advection = {} }
time = { end = 1.0 }
output = { pictures = false }
"#;

/// What makes each arrangement of the cavity, by name. Random points take a wider radius: they leave gaps.
#[allow(dead_code, reason = "not every file of tests goes through them")]
pub const ARRANGEMENTS: [(&str, &[&str]); 3] = [
    ("regular", &[]),
    ("jittered", &["cloud.arrangement=jittered", "cloud.jitter=0.45"]),
    ("random", &["cloud.arrangement=random", "method.radius=2.8"]),
];

/// The cavity at Re 100, on 21 x 21 regular points unless `overrides` (`key=value`) say otherwise.
pub fn cavity(overrides: &[&str]) -> Case {
    let overrides: Vec<String> = overrides.iter().map(|given| (*given).to_owned()).collect();
    Case::from_text(CAVITY, Path::new("cavity.toml"), &overrides).expect("a case")
}

/// The same with `n` spacings to a metre.
pub fn cavity_of(n: usize, overrides: &[&str]) -> Case {
    let spacing = format!("cloud.spacing={:e}", 1.0 / n as f64);
    cavity(&[overrides, &[spacing.as_str()]].concat())
}

/// The same flow in a unit of length `metres` long: places, velocities and the viscosity change, and nothing in proportion.
#[allow(dead_code, reason = "not every file of tests goes through it")]
pub fn scaled(mut case: Case, metres: f64) -> Case {
    case.domain.width *= metres;
    case.domain.height *= metres;
    case.cloud.spacing *= metres;
    case.boundaries.top.velocity[0] *= metres;
    if let Some(viscosity) = &mut case.effects.viscosity {
        viscosity.kinematic *= metres * metres;
    }
    case
}

/// A problem without time, on jittered points, `n` spacings to a metre.
#[allow(dead_code, reason = "not every file of tests goes through it")]
pub fn problem(n: usize, overrides: &[&str]) -> Case {
    let text = "title = \"Problem\"\ndomain = { width = 1.0, height = 1.0 }\nfluid = { density = 1.0 }\n\
                cloud = { arrangement = \"jittered\", spacing = 0.05 }\noutput = { pictures = false }\n";
    let spacing = format!("cloud.spacing={:e}", 1.0 / n as f64);
    let overrides: Vec<String> = overrides.iter().map(|given| (*given).to_owned()).chain([spacing]).collect();
    Case::from_text(text, Path::new("problem.toml"), &overrides).expect("a case")
}

/// Second order on scattered points.
#[allow(dead_code, reason = "not every file of tests asks for it")]
pub const FIT: &str = "effects.pressure.divergence=fit";

const VORTICES: &str = r#"
title = "Vortices"
domain = { width = 1.0, height = 1.0, periodic = "both" }
cloud = { arrangement = "regular", spacing = 0.05 }
fluid = { density = 1.0 }
effects = { viscosity = { kinematic = 0.01 }, pressure = {}, advection = {} }
time = { end = 0.5 }
exact = { solution = "taylor_green" }
output = { pictures = false }
"#;

const TURNING: &str = r#"
title = "Turning"
domain = { width = 1.0, height = 1.0 }
cloud = { arrangement = "regular", spacing = 0.05 }
fluid = { density = 1.0 }
effects = { advection = {}, tracers = [{ name = "c", shape = "gaussian", centre = [0.5, 0.75], radius = 0.1 }] }
time = { end = 1.0 }
exact = { solution = "rotation" }
output = { pictures = false }
"#;

/// A Gaussian that a solid rotation carries round, with `n` spacings to a metre.
#[allow(dead_code, reason = "not every file of tests has it")]
pub fn turning(n: usize, overrides: &[&str]) -> Case {
    case_of(TURNING, n, overrides)
}

const WAKE: &str = r#"
title = "Wake"
domain = { width = 1.5, height = 1.0 }
cloud = { arrangement = "regular", spacing = 0.05 }
fluid = { density = 1.0 }
effects = { viscosity = { kinematic = 0.025 }, pressure = { tolerance = 1e-7 }, advection = {} }
time = { end = 6.0, steady = 1e-4 }
exact = { solution = "kovasznay" }
output = { pictures = false }
"#;

fn case_of(text: &str, n: usize, overrides: &[&str]) -> Case {
    let spacing = format!("cloud.spacing={:e}", 1.0 / n as f64);
    let overrides: Vec<String> = overrides.iter().copied().chain([spacing.as_str()]).map(str::to_owned).collect();
    Case::from_text(text, Path::new("case.toml"), &overrides).expect("a case")
}

/// Taylor-Green vortices at Re 100 in a periodic box, with `n` spacings to a metre.
#[allow(dead_code, reason = "not every file of tests has them")]
pub fn vortices(n: usize, overrides: &[&str]) -> Case {
    case_of(VORTICES, n, overrides)
}

/// Kovasznay's flow at Re 40 through a box, with `n` spacings to a metre.
#[allow(dead_code, reason = "not every file of tests has it")]
pub fn wake(n: usize, overrides: &[&str]) -> Case {
    case_of(WAKE, n, overrides)
}
