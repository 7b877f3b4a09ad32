//! Columns of water that collapse, from which the tests of points that move make their cases.

use std::path::Path;

use stillpoint::case::Case;

const COLUMN: &str = r#"
title = "Column"
domain = { width = 0.3, height = 0.2 }
cloud = { arrangement = "regular", spacing = 0.01, fill = { from = [0.0, 0.0], to = [0.08, 0.12] } }
fluid = { density = 1000.0 }
method = { operators = "interpolation" }
effects = { gravity = { acceleration = [0.0, -9.81] }, pressure = {}, advection = { motion = "shifted" } }
time = { end = 0.1, courant = 0.2 }
output = { pictures = false, report_every = 7, frame_every = 0.02, sensors = { foot = { at = [0.04, 0.0] } } }
"#;

/// What makes each kind of motion, by name.
pub const MOTIONS: [(&str, &[&str]); 6] = [
    ("shifted", &[]),
    ("shifted, viscous", &["effects.viscosity.kinematic=0.001"]),
    ("lagrangian", &["effects.advection.motion=lagrangian"]),
    ("lagrangian, viscous", &["effects.advection.motion=lagrangian", "effects.viscosity.kinematic=0.001"]),
    ("MPS", MPS),
    ("MPS, viscous", &[MPS[0], MPS[1], MPS[2], "effects.viscosity.kinematic=0.001"]),
];

pub const MPS: &[&str] = &["method.operators=integral", "effects.advection.motion=lagrangian", "time.step=0.001"];

/// A column of shifted points, 8 by 12 spacings, unless `overrides` (`key=value`) say otherwise.
pub fn column(overrides: &[&str]) -> Case {
    let overrides: Vec<String> = overrides.iter().map(|given| (*given).to_owned()).collect();
    Case::from_text(COLUMN, Path::new("column.toml"), &overrides).expect("a case")
}
