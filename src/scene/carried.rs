//! What the carried fields begin with, how fast they diffuse, and what the sides do to them.

use super::Scene;
use crate::case::{Case, Wall};
use crate::cloud::voronoi::{Boundary, Cells};
use crate::engine::Data;
use crate::step::{Buffer, Carried};

/// Largest stable step, s: the midpoint rule over half a step is stable up to `(dt / 2) |lambda| = 2`, and no eigenvalue of
/// `D / V_i sum_j w_ij (phi_j - phi_i)` is larger than twice its largest diagonal entry (Gershgorin).
pub(super) fn limit(case: &Case, cells: Option<&Cells>) -> f64 {
    let Some(cells) = cells else { return f64::INFINITY };
    let diffusivity = case.diffusing().into_iter().map(|field| case.diffusivity(field)).fold(0.0, f64::max);
    let entry = |point: usize| cells.faces(point).map(|(_, weight)| weight).sum::<f64>() / cells.volume[point];
    let largest = (0..cells.volume.len()).map(entry).fold(0.0, f64::max);
    4.0 / (2.0 * diffusivity * largest)
}

/// The arrays of every field.
pub(super) fn initial(scene: &Scene, volume: &[f64]) -> Vec<(Buffer, Data)> {
    let (case, cloud) = (&scene.case, &scene.cloud);
    let mut data = Vec::new();
    for &field in &scene.plan.carried {
        let diffusivity = case.diffusivity(field);
        let mut reach: Vec<f64> = volume.iter().map(|volume| diffusivity / volume).collect();
        let mut values: Vec<f64> = match field {
            Carried::Temperature => {
                vec![case.effects.heat.as_ref().map_or(0.0, |heat| heat.initial); cloud.len()]
            }
            Carried::Tracer(number) => {
                let tracer = &case.effects.tracers[number];
                cloud.position.iter().map(|&place| tracer.initially(place)).collect()
            }
        };
        if field == Carried::Temperature {
            for point in 0..cloud.sides.len() {
                if let Some(temperature) = held(scene, point) {
                    values[cloud.interior + point] = temperature;
                    reach[cloud.interior + point] = 0.0;
                }
            }
        }
        data.push((Buffer::Carried(field), scene.scalars(&values, 0.0)));
        data.push((Buffer::Reach(field), scene.scalars(&reach, 0.0)));
    }
    data.push((Buffer::HeatSupply, scene.scalars(&supply(scene, volume), 0.0)));
    data
}

/// The temperature that is held at a boundary point, K: at a corner the mean of those that its sides hold.
fn held(scene: &Scene, point: usize) -> Option<f64> {
    let walls = scene.cloud.sides[point].iter().map(|side| side.wall(&scene.case.boundaries));
    let given: Vec<f64> = walls.filter_map(|wall: &Wall| wall.temperature).collect();
    (!given.is_empty()).then(|| given.iter().sum::<f64>() / given.len() as f64)
}

/// What flows in through the pieces of wall of every cell, K/s: `q A_i / V_i`; nothing through obstacles.
fn supply(scene: &Scene, volume: &[f64]) -> Vec<f64> {
    let cloud = &scene.cloud;
    let mut supply = vec![0.0; cloud.len()];
    for piece in scene.cells.iter().flat_map(|cells| &cells.walls) {
        let Boundary::Side(side) = piece.of else { continue };
        let held = piece.point >= cloud.interior && held(scene, piece.point - cloud.interior).is_some();
        if !held {
            let flux = side.wall(&scene.case.boundaries).heat_flux.unwrap_or(0.0);
            supply[piece.point] += flux * piece.area.length() / volume[piece.point];
        }
    }
    supply
}
