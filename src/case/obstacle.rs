//! Bodies in the fluid: `[[obstacles]]`, and where the points lie closer: `[[cloud.refine]]`.

use glam::DVec2;
use serde::{Deserialize, Serialize};

/// A solid body at rest, which the fluid flows round: a circle, a polygon, or made of parts.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Obstacle {
    /// What expectations, refinements and the columns of the diagnostics call it.
    pub name: String,
    pub circle: Option<Circle>,
    /// Corners in order, either way round, m.
    pub polygon: Option<Vec<[f64; 2]>>,
    /// In order: each is added to those before it, taken from them, or cut with them.
    pub parts: Option<Vec<Part>>,
}

/// A part of a body: one of the four figures.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Part {
    pub circle: Option<Circle>,
    pub ellipse: Option<Ellipse>,
    #[serde(rename = "box")]
    pub block: Option<Block>,
    pub capsule: Option<Capsule>,
    #[serde(default)]
    pub combine: Combine,
}

impl Part {
    /// The corners of the box around it, m.
    pub fn bounds(&self) -> (DVec2, DVec2) {
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        let mut take = |centre: [f64; 2], reach: DVec2| {
            (low, high) = (low.min(DVec2::from(centre) - reach), high.max(DVec2::from(centre) + reach));
        };
        if let Some(circle) = &self.circle {
            take(circle.centre, DVec2::splat(circle.radius));
        }
        if let Some(Ellipse { centre, axes, turn }) = &self.ellipse {
            let along = DVec2::from_angle(turn.to_radians());
            take(
                *centre,
                DVec2::new((axes[0] * along.x).hypot(axes[1] * along.y), (axes[0] * along.y).hypot(axes[1] * along.x)),
            );
        }
        if let Some(Block { centre, size, corner, turn }) = &self.block {
            let along = DVec2::from_angle(turn.to_radians()).abs();
            let half = 0.5 * DVec2::from(*size) - *corner;
            take(*centre, DVec2::new(half.dot(along), half.dot(DVec2::new(along.y, along.x))) + *corner);
        }
        if let Some(capsule) = &self.capsule {
            take(capsule.from, DVec2::splat(capsule.radius));
            take(capsule.to, DVec2::splat(capsule.radius));
        }
        (low, high)
    }
}

/// What becomes of a part and those before it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Combine {
    /// The body is what either has.
    #[default]
    Add,
    /// What those before have and this has not.
    Subtract,
    /// What both have.
    Intersect,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ellipse {
    /// m
    pub centre: [f64; 2],
    /// Half its length and half its width, m.
    pub axes: [f64; 2],
    /// Of its length from the x axis, degrees, anticlockwise.
    #[serde(default)]
    pub turn: f64,
}

/// A rectangle, its corners rounded.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Block {
    /// m
    pub centre: [f64; 2],
    /// Width and height, corners included, m.
    pub size: [f64; 2],
    /// Radius of its corners, m.
    #[serde(default)]
    pub corner: f64,
    /// Degrees, anticlockwise.
    #[serde(default)]
    pub turn: f64,
}

/// All that is nearer than `radius` to the way between two places.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Capsule {
    /// m
    pub from: [f64; 2],
    /// m
    pub to: [f64; 2],
    /// m
    pub radius: f64,
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
