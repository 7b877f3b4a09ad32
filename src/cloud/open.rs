//! The velocity at points of sides that follow the fluid: of slip sides and of outlets.
//!
//! Continuous: `d u / dn = 0`; through a slip side `n . u = 0`. Discrete: `u = sum_j s_j u_j`, the value at the point of the polynomial
//! `a + b s + c s^2 + d n^2` (`s` along the side, `n` across) that fits the points around it which do not follow: even in `n`, so that
//! its slope across is zero. At a corner of two such sides it is even in both. Weighted by `(1 - (r / radius)^2)^4`; where there
//! are too few points for it, their weighted mean. Units: none.

use glam::DVec2;

use super::grid::Grid;
use super::{Cloud, Side, shortest};
use crate::case::{Boundaries, SideKind};

/// One such point.
#[derive(Debug, Clone, PartialEq)]
pub struct OpenPoint {
    pub point: usize,
    /// Whose velocities, and their shares.
    pub row: Vec<(usize, f64)>,
    /// What is taken out of the velocity: the normal of a slip side; zero at an outlet.
    pub normal: DVec2,
}

/// Coefficients of the polynomial.
const TERMS: usize = 4;
/// Least pivot, relative to the diagonal entry it came from.
const LEAST_PIVOT: f64 = 1e-8;

/// The points of the sides that follow the fluid, unless another side of theirs prescribes a velocity; the radius of
/// a point's neighbourhood is so many `spacings` of its own.
pub fn open_points(cloud: &Cloud, boundaries: &Boundaries, spacings: f64) -> Vec<OpenPoint> {
    let kind = |side: &Side| side.wall(boundaries).kind;
    let follows = |side: &Side| matches!(kind(side), SideKind::Slip | SideKind::Outlet);
    let slips = |sides: &[Side]| sides.iter().filter(|side| kind(side) == SideKind::Slip).count();
    // A point of an obstacle is on no side, and rests; so does the corner of two slip sides, which nothing passes.
    let open = |sides: &[Side]| !sides.is_empty() && sides.iter().all(follows) && slips(sides) < 2;
    let is_open = |point: usize| point >= cloud.interior && open(&cloud.sides[point - cloud.interior]);
    let grid = Grid::new(&cloud.position, cloud.size, cloud.period, spacings * cloud.spacing);
    let make = |point: usize| {
        let (own, sides) = (cloud.position[point], &cloud.sides[point - cloud.interior]);
        let radius = spacings * cloud.spacing_at(point);
        let around = grid.within(own, radius).filter(|&other| !is_open(other));
        let near: Vec<(usize, DVec2)> = around
            .map(|other| (other, shortest(cloud.position[other] - own, cloud.period) / radius))
            .filter(|(_, offset)| offset.length_squared() < 1.0)
            .collect();
        let slip = sides.iter().filter(|side| kind(side) == SideKind::Slip).map(|side| side.normal());
        OpenPoint { point, row: row(&near, sides), normal: slip.sum() }
    };
    (cloud.interior..cloud.len()).filter(|&point| is_open(point)).map(make).collect()
}

/// The shares of the points at scaled offsets.
fn row(near: &[(usize, DVec2)], sides: &[Side]) -> Vec<(usize, f64)> {
    let normal = sides[0].normal();
    let basis = |offset: DVec2| {
        let (s, n) = (offset.dot(normal.perp()), offset.dot(normal));
        [1.0, if sides.len() > 1 { 0.0 } else { s }, s * s, n * n]
    };
    let weight = |offset: DVec2| (1.0 - offset.length_squared()).powi(4);
    let mut matrix = [[0.0; TERMS]; TERMS];
    for (_, offset) in near {
        let (basis, weight) = (basis(*offset), weight(*offset));
        for row in 0..TERMS {
            for column in 0..TERMS {
                matrix[row][column] += weight * basis[row] * basis[column];
            }
        }
    }
    if sides.len() > 1 {
        matrix[1][1] = 1.0;
    }
    match first_row_of_inverse(matrix) {
        Some(inverse) => near
            .iter()
            .map(|&(point, offset)| {
                let sum: f64 = basis(offset).iter().zip(inverse).map(|(term, factor)| term * factor).sum();
                (point, weight(offset) * sum)
            })
            .collect(),
        None => {
            let total: f64 = near.iter().map(|(_, offset)| weight(*offset)).sum();
            near.iter().map(|&(point, offset)| (point, weight(offset) / total)).collect()
        }
    }
}

/// By elimination without pivoting, which normal matrices need none of; `None` where one is too weak.
fn first_row_of_inverse(mut matrix: [[f64; TERMS]; TERMS]) -> Option<[f64; TERMS]> {
    let diagonal: [f64; TERMS] = std::array::from_fn(|k| matrix[k][k]);
    let mut right = [0.0; TERMS];
    right[0] = 1.0;
    for pivot in 0..TERMS {
        if matrix[pivot][pivot] <= LEAST_PIVOT * diagonal[pivot] {
            return None;
        }
        for row in pivot + 1..TERMS {
            let factor = matrix[row][pivot] / matrix[pivot][pivot];
            let above = matrix[pivot];
            matrix[row].iter_mut().zip(above).skip(pivot).for_each(|(entry, above)| *entry -= factor * above);
            right[row] -= factor * right[pivot];
        }
    }
    for row in (0..TERMS).rev() {
        let known: f64 = (row + 1..TERMS).map(|column| matrix[row][column] * right[column]).sum();
        right[row] = (right[row] - known) / matrix[row][row];
    }
    Some(right)
}
