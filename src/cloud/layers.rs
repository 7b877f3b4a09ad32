//! Points in layers along the boundary: behind each of its points stand a few more, one spacing after another, as in a lattice.
//!
//! Fits in layers are nearly symmetric, and err less than those of points that lie anyhow, where most of a flow's shear is. A
//! column ends where a point would be much closer to others of its layer than a spacing, or much farther from all.

use glam::DVec2;

use super::grid::Grid;
use super::shortest;
use super::sizing::Sizing;

/// Most layers. In the cavity at Re 1000, its points closer along the walls, two and four are worse, and none much worse.
const LAYERS: usize = 3;
/// Closest and farthest that neighbours in a layer are, in spacings.
const CLOSEST: f64 = 0.75;
const FARTHEST: f64 = 1.35;
/// Least distance from the boundary, over the way from the point that a column stands behind: it is less in corners.
const STRAIGHT: f64 = 0.95;

/// The layers behind the points `place` of a boundary with outward normals `normal`; `distance` is that of a place from the
/// boundary, m.
pub(super) fn layers(
    place: &[DVec2],
    normal: &[DVec2],
    sizing: &Sizing,
    period: DVec2,
    distance: &dyn Fn(DVec2) -> f64,
) -> Vec<DVec2> {
    let mut layers = Vec::new();
    // Where each column has got to, its normal, and how far that is from the boundary, m.
    let mut columns: Vec<(DVec2, DVec2, f64)> =
        place.iter().zip(normal).map(|(&place, &normal)| (place, normal, 0.0)).collect();
    for _ in 0..LAYERS {
        columns.retain_mut(|(place, normal, way)| {
            let step = sizing.at(*place);
            *place -= step * *normal;
            *way += step;
            distance(*place) >= STRAIGHT * *way
        });
        let layer: Vec<DVec2> = columns.iter().map(|(place, ..)| *place).collect();
        let grid = Grid::new(&layer, sizing.size(), period, 1.5 * sizing.least());
        let (layer, grid) = (&layer, &grid);
        let mut kept = vec![false; layer.len()];
        for (own, &place) in layer.iter().enumerate() {
            let spacing = sizing.at(place);
            let near = |reach: f64| {
                let others = grid.within(place, reach).filter(move |&other| other != own);
                others.filter(move |&other| shortest(layer[other] - place, period).length() < reach)
            };
            let crowded = near(CLOSEST * spacing).any(|other| kept[other]);
            kept[own] = !crowded && near(FARTHEST * spacing).next().is_some();
        }
        let mut keep = kept.into_iter();
        columns.retain(|_| keep.next() == Some(true));
        layers.extend(columns.iter().map(|(place, ..)| *place));
    }
    layers
}
