//! Bodies in the fluid: `[[obstacles]]`, and where the points lie closer: `[[cloud.refine]]`.

use serde::{Deserialize, Serialize};

/// A solid body at rest, which the fluid flows round: a circle or a polygon.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Obstacle {
    /// What expectations, refinements and the columns of the diagnostics call it.
    pub name: String,
    pub circle: Option<Circle>,
    /// Corners in order, either way round, m.
    pub polygon: Option<Vec<[f64; 2]>>,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Circle {
    /// m
    pub centre: [f64; 2],
    /// m
    pub radius: f64,
}

/// A place around which the points lie closer: the spacing is `spacing` there and `growth` times the distance more away from
/// it, up to `cloud.spacing`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Refine {
    /// The name of an obstacle, or a side.
    pub near: Option<String>,
    /// In place of `near`: two opposite corners of a box, m; the same twice is a place.
    #[serde(rename = "box")]
    pub corners: Option<[[f64; 2]; 2]>,
    /// m
    pub spacing: f64,
    /// How much more a spacing is per distance, m/m.
    #[serde(default = "default_growth")]
    pub growth: f64,
}

fn default_growth() -> f64 {
    0.1
}

/// What the sides are called.
pub const SIDES: [&str; 4] = ["left", "right", "bottom", "top"];
