//! Points scattered to a size function, and moved until they lie evenly.
//!
//! Continuous: points that minimise `sum_i int_cell_i rho |x - x_i|^2` have one per `h^2` where `rho = h^-4` (Du, Faber and
//! Gunzburger, SIAM Review 41 (1999) 637-676). Discrete, Lloyd's iteration: every interior point moves towards the `rho`-weighted
//! middle of its Voronoi cell, a little farther than there. Points on walls and outlines stand.

use glam::DVec2;
use rayon::prelude::*;

use super::arrangement::Uniform;
use super::sizing::Sizing;
use super::{Cloud, CloudError, voronoi};
use crate::case::LARGEST_CLOUD;

/// Iterations: after so many a point moves by a hundredth of a spacing.
const ITERATIONS: usize = 60;
/// Part of the way to the middle that a point moves.
const OVERSHOOT: f64 = 1.5;
/// Of even clouds with obstacles: points nearer to an outline, in spacings, are relaxed, and so often.
const NEAR: f64 = 3.0;
const NEAR_ITERATIONS: usize = 12;
/// Closest that an interior point comes to an outline, in spacings: above a half, so that its cell ends before it.
pub(super) const CLEARANCE: f64 = 0.6;
/// Closest that a scattered point comes to a layer, in spacings, before it is relaxed.
pub(super) const APART: f64 = 0.7;

/// About one point per `h^2` of the rectangle: squares are split until they are about as large, and each takes as many points
/// as fit, at random.
pub(super) fn scatter(
    sizing: &Sizing,
    random: &mut Uniform,
    keep: &dyn Fn(DVec2) -> bool,
) -> Result<Vec<DVec2>, CloudError> {
    let size = sizing.size();
    let whole = (size / sizing.base()).round().max(DVec2::ONE);
    let side = size / whole;
    let mut position = Vec::new();
    for row in 0..whole.y as usize {
        for column in 0..whole.x as usize {
            let mut open = vec![(DVec2::new(column as f64, row as f64) * side, side)];
            while let Some((corner, side)) = open.pop() {
                let share = side.x * side.y / sizing.at(corner + 0.5 * side).powi(2);
                if share > 2.0 {
                    let half = 0.5 * side;
                    open.extend(
                        [[1.0, 1.0], [0.0, 1.0], [1.0, 0.0], [0.0, 0.0]]
                            .map(|at| (corner + half * DVec2::from(at), half)),
                    );
                    continue;
                }
                for _ in 0..(share + random.unit()) as usize {
                    let place = corner + side * random.in_unit_square();
                    if keep(place) {
                        position.push(place);
                    }
                }
                if position.len() as f64 > LARGEST_CLOUD {
                    return Err(CloudError::TooMany);
                }
            }
        }
    }
    Ok(position)
}

/// Relaxes the points that were scattered, the first so many.
pub(super) fn relax(cloud: &mut Cloud, scattered: usize, sizing: &Sizing) {
    let all: Vec<usize> = (0..scattered).collect();
    iterate(cloud, sizing, &all, ITERATIONS);
}

/// Relaxes those near outlines: the gap that an obstacle leaves in a lattice is of any width.
pub(super) fn relax_near_outlines(cloud: &mut Cloud, sizing: &Sizing) {
    if cloud.outlines.is_empty() {
        return;
    }
    let reach = NEAR * sizing.base();
    let near = (0..cloud.interior).filter(|&point| cloud.clearance(cloud.position[point]) < reach);
    let near: Vec<usize> = near.collect();
    iterate(cloud, sizing, &near, NEAR_ITERATIONS);
}

fn iterate(cloud: &mut Cloud, sizing: &Sizing, points: &[usize], iterations: usize) {
    let density = |place: DVec2| (sizing.base() / sizing.at(place)).powi(4);
    for _ in 0..iterations {
        let grid = voronoi::grid(cloud);
        let moved = points.par_iter().map(|&point| {
            let own = cloud.position[point];
            let middle = voronoi::middle(cloud, point, &grid, &density);
            let allowed = |place: DVec2| cloud.beside(place).min(cloud.clearance(place)) > CLEARANCE * sizing.at(place);
            let [far, near] = [OVERSHOOT, 1.0].map(|part| own + part * (middle - own));
            if allowed(far) {
                far
            } else if allowed(near) {
                near
            } else {
                own
            }
        });
        let moved: Vec<DVec2> = moved.collect();
        for (&point, place) in points.iter().zip(moved) {
            cloud.position[point] = super::inside(place, cloud.period);
        }
    }
}
