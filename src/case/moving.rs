//! What a case says of points that move: where the fluid is at the start, how it moves there, how its points move.

use serde::{Deserialize, Serialize};

use super::{Case, Operators, PressureForm};

/// What becomes of the points once the flow has moved them: where the fields are carried to.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Motion {
    /// Back to where the points stood.
    #[default]
    Fixed,
    /// Nowhere: the points stay where the flow has moved them.
    Lagrangian,
    /// To places beside those, more evenly spaced.
    Shifted,
}

/// The rectangle that holds fluid at the start; the rest of the domain is empty. Where it ends inside the domain, its
/// outermost points are the free surface.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fill {
    /// Lower left corner, m.
    pub from: [f64; 2],
    /// Upper right corner, m.
    pub to: [f64; 2],
    /// The shape of the surface on top; flat where absent.
    pub wave: Option<Wave>,
}

/// A surface raised by `amplitude cos(pi half_waves x / width)`, `x` from the left end of the fill.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Wave {
    /// m
    pub amplitude: f64,
    /// Half waves along the fill.
    pub half_waves: u32,
}

/// How the fluid moves at the start; at rest where nothing is said.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Initial {
    /// Angular velocity of a rotation as of a solid about the middle of `cloud.fill`, 1/s.
    pub rotation: f64,
}

/// A place where the pressure is recorded.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sensor {
    /// m
    pub at: [f64; 2],
}

/// Radius of the neighbourhood of points that move, in spacings: of fits, and of weighted means.
const MOVING_RADIUS: f64 = 3.1;
const INTEGRAL_RADIUS: f64 = 2.1;

impl Case {
    /// What becomes of the points; `fixed` without advection.
    pub fn motion(&self) -> Motion {
        self.effects.advection.as_ref().map_or(Motion::Fixed, |advection| advection.motion)
    }

    /// True where the points stay where they have moved to.
    pub fn moves(&self) -> bool {
        self.motion() != Motion::Fixed
    }

    /// The pressure form that goes with the motion and the operators, where the case leaves it open.
    pub(super) fn settle_form(&mut self) {
        let form = match (self.moves(), self.method.operators) {
            (false, _) => PressureForm::Conservative,
            (true, Operators::Interpolation) => PressureForm::Collocated,
            (true, Operators::Integral) => PressureForm::Integral,
        };
        if let Some(pressure) = &mut self.effects.pressure {
            pressure.form.get_or_insert(form);
        }
        if self.moves() {
            self.method.radius.get_or_insert(match self.method.operators {
                Operators::Interpolation => MOVING_RADIUS,
                Operators::Integral => INTEGRAL_RADIUS,
            });
        }
    }
}
