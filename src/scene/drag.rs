//! Where a porous body is.

use super::Scene;
use crate::case::Obstacle;
use crate::cloud::shape::Shape;
use crate::engine::Data;
use crate::step::Buffer;

/// What the body takes of the velocity at every point, `nu / k`, 1/s; 0 outside.
pub(super) fn resistance(scene: &Scene) -> Option<(Buffer, Data)> {
    let drag = scene.case.effects.drag.as_ref()?;
    let body =
        Obstacle { name: String::new(), circle: drag.circle.clone(), polygon: drag.polygon.clone(), parts: None };
    let everywhere = drag.circle.is_none() && drag.polygon.is_none();
    let shape = Shape::of(&body);
    let within = |place| everywhere || shape.distance(place) <= 0.0;
    let rate = scene.constants.viscosity / drag.permeability;
    let values: Vec<f64> = scene.cloud.position.iter().map(|&place| if within(place) { rate } else { 0.0 }).collect();
    Some((Buffer::Resistance, scene.scalars(&values, 0.0)))
}
