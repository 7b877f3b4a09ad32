//! Where a porous body is.

use super::Scene;
use crate::cloud::shape::Shape;
use crate::engine::Data;
use crate::step::Buffer;

/// What the body takes of the velocity at every point, `nu / k`, 1/s; 0 outside.
pub(super) fn resistance(scene: &Scene) -> Option<(Buffer, Data)> {
    let drag = scene.case.effects.drag.as_ref()?;
    let shape = drag.circle.as_ref().map(Shape::circle).or_else(|| drag.polygon.as_deref().map(Shape::polygon));
    let within = |place| shape.as_ref().is_none_or(|shape| shape.distance(place) <= 0.0);
    let rate = scene.constants.viscosity / drag.permeability;
    let values: Vec<f64> = scene.cloud.position.iter().map(|&place| if within(place) { rate } else { 0.0 }).collect();
    Some((Buffer::Resistance, scene.scalars(&values, 0.0)))
}
