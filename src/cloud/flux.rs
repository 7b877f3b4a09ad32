//! The volume flux of a velocity out of every Voronoi cell, as a sum over the points around it.
//!
//! Continuous: `V_i div u`, the mean over a cell, is `sum_j int u . n` over its faces. Discrete: `sum_k r_ik . u_k`. On each face
//! a quadratic is fitted (least squares) to the points around its middle, and integrated along it: exact for quadratic
//! velocities, of second order on scattered points, where the mean of a face's two points is not (the face's middle lies
//! beside the middle between them). What leaves one cell enters another, whatever the velocity. Weight of a point at scaled
//! distance `q` from the middle: `(1 - q^2)^2`. Between two points on walls the velocity may jump, as at the ends of a lid:
//! there it is their mean, and so where there are too few points for a fit.
//! Units: m.

use glam::DVec2;
use rayon::prelude::*;

use super::grid::Grid;
use super::voronoi::Cells;
use super::{Cloud, shortest};

/// Coefficients of a quadratic.
const TERMS: usize = 6;
/// Radius of a fit over that of the points' own. Narrower ones lose sight of modes of single points, which then grow.
const REACH: f64 = 0.9;
/// Farthest that the middle of a face is from its points, in the same unit; one farther off sees fewer points.
const FARTHEST: f64 = 0.7;
/// Least pivot of a fit, relative to the diagonal entry it came from.
const LEAST_PIVOT: f64 = 1e-8;

/// The rows `r_ik` of all cells.
#[derive(Debug, Clone, PartialEq)]
pub struct Fluxes {
    /// Where each cell's terms begin; one more entry than cells.
    start: Vec<usize>,
    point: Vec<u32>,
    factor: Vec<DVec2>,
}

/// The mean of a velocity over one face, as a sum over points: whose velocity, and its share.
type Mean = Vec<(u32, f64)>;

impl Fluxes {
    /// Fits on the faces of `cells`; the radius of a point's neighbourhood is so many `spacings`.
    pub fn build(cloud: &Cloud, cells: &Cells, spacings: f64) -> Self {
        let seen = (REACH + FARTHEST) * spacings;
        let cell = match &cloud.local {
            Some(_) => (cloud.area() / cloud.len() as f64).sqrt(),
            None => cloud.spacing,
        };
        let grid = Grid::new(&cloud.position, cloud.size, cloud.period, seen * cell);
        // Of the faces to points that come later: each once.
        let means = |point: usize| -> Vec<(usize, Mean)> {
            let later: Vec<usize> = (cells.start[point]..cells.start[point + 1])
                .filter(|&face| cells.neighbour[face] as usize > point)
                .collect();
            // Of a face, the mean of its two points'.
            let spacing =
                |face: usize| 0.5 * (cloud.spacing_at(point) + cloud.spacing_at(cells.neighbour[face] as usize));
            let widest = later.iter().map(|&face| spacing(face)).fold(0.0, f64::max);
            let around = Around::new(cloud, &grid, point, seen * widest);
            let mean = |face: usize| (face, around.mean(cloud, cells, face, REACH * spacings * spacing(face)));
            later.into_iter().map(mean).collect()
        };
        let means: Vec<Vec<(usize, Mean)>> = (0..cloud.len()).into_par_iter().map(means).collect();
        let row = |point: usize| -> Vec<(u32, DVec2)> {
            let mut terms = Vec::new();
            for face in cells.start[point]..cells.start[point + 1] {
                let other = cells.neighbour[face] as usize;
                let area = cells.weight[face] * shortest(cloud.position[other] - cloud.position[point], cloud.period);
                let of = |(found, _): &&(usize, Mean)| match other > point {
                    true => *found == face,
                    false => cells.neighbour[*found] as usize == point,
                };
                if let Some((_, mean)) = means[point.min(other)].iter().find(of) {
                    terms.extend(mean.iter().map(|&(k, share)| (k, share * area)));
                }
            }
            terms.sort_unstable_by_key(|&(k, _)| k);
            terms.dedup_by(|(k, factor), (kept, sum)| {
                let same = k == kept;
                if same {
                    *sum += *factor;
                }
                same
            });
            terms
        };
        let rows: Vec<Vec<(u32, DVec2)>> = (0..cloud.len()).into_par_iter().map(row).collect();
        let mut start = vec![0];
        start.extend(rows.iter().scan(0, |sum, row| {
            *sum += row.len();
            Some(*sum)
        }));
        let (point, factor) = rows.into_iter().flatten().unzip();
        Self { start, point, factor }
    }

    /// The terms of one cell: whose velocity, and the factor of it, m.
    pub fn row(&self, cell: usize) -> impl Iterator<Item = (usize, DVec2)> + '_ {
        let range = self.start[cell]..self.start[cell + 1];
        range.map(|term| (self.point[term] as usize, self.factor[term]))
    }

    /// The most terms that any cell has.
    pub fn most_terms(&self) -> usize {
        self.start.windows(2).map(|pair| pair[1] - pair[0]).max().unwrap_or(0)
    }
}

/// The points that the faces of one may see, and how far they are from it.
struct Around {
    point: usize,
    near: Vec<(u32, DVec2)>,
}

impl Around {
    /// Those within `reach`, m, and some more.
    fn new(cloud: &Cloud, grid: &Grid, point: usize, reach: f64) -> Self {
        let own = cloud.position[point];
        let offset = |other: usize| (other as u32, shortest(cloud.position[other] - own, cloud.period));
        Self { point, near: grid.within(own, reach).map(offset).collect() }
    }

    /// `radius` is that of the fit, m.
    fn mean(&self, cloud: &Cloud, cells: &Cells, face: usize, radius: f64) -> Mean {
        let other = cells.neighbour[face];
        let on_walls = self.point >= cloud.interior && other as usize >= cloud.interior;
        let fitted = if on_walls { None } else { self.fitted(cloud, cells, face, radius) };
        fitted.unwrap_or_else(|| vec![(self.point as u32, 0.5), (other, 0.5)])
    }

    fn fitted(&self, cloud: &Cloud, cells: &Cells, face: usize, radius: f64) -> Option<Mean> {
        let Self { point, near } = self;
        let across = shortest(cloud.position[cells.neighbour[face] as usize] - cloud.position[*point], cloud.period);
        let along = across.perp() / across.length();
        let middle = 0.5 * across + cells.shift[face] * along;
        let half = 0.5 * cells.weight[face] * across.length() * along;
        let basis = |place: DVec2| {
            let [x, y] = ((place - middle) / radius).to_array();
            [1.0, x, y, x * x, x * y, y * y]
        };
        // 0 from the radius on.
        let kernel = |offset: DVec2| (1.0 - offset.length_squared() / (radius * radius)).max(0.0).powi(2);
        let seen: Vec<(u32, [f64; TERMS], f64)> = near
            .iter()
            .map(|&(k, offset)| (k, basis(offset), kernel(offset - middle)))
            .filter(|&(.., weight)| weight > 0.0)
            .collect();
        let mut matrix = [[0.0; TERMS]; TERMS];
        for (_, basis, weight) in &seen {
            for row in 0..TERMS {
                for column in 0..=row {
                    matrix[row][column] += weight * basis[row] * basis[column];
                }
            }
        }
        // Simpson's rule is exact for quadratics.
        let [begin, centre, end] = [middle - half, middle, middle + half].map(basis);
        let integral = std::array::from_fn(|k| (begin[k] + 4.0 * centre[k] + end[k]) / 6.0);
        let coefficient = solve(matrix, integral)?;
        let share = |basis: &[f64; TERMS]| basis.iter().zip(&coefficient).map(|(b, c)| b * c).sum::<f64>();
        Some(seen.iter().map(|(k, basis, weight)| (*k, weight * share(basis))).collect())
    }
}

/// Solves a symmetric system, given by its lower triangle, by Cholesky; `None` where a pivot is too small.
fn solve(mut matrix: [[f64; TERMS]; TERMS], right: [f64; TERMS]) -> Option<[f64; TERMS]> {
    for row in 0..TERMS {
        let diagonal = matrix[row][row];
        for column in 0..=row {
            let done = (0..column).map(|k| matrix[row][k] * matrix[column][k]).sum::<f64>();
            let entry = matrix[row][column] - done;
            if column < row {
                matrix[row][column] = entry / matrix[column][column];
            } else if entry > LEAST_PIVOT * diagonal {
                matrix[row][row] = entry.sqrt();
            } else {
                return None;
            }
        }
    }
    let mut x = right;
    for row in 0..TERMS {
        let done = (0..row).map(|k| matrix[row][k] * x[k]).sum::<f64>();
        x[row] = (x[row] - done) / matrix[row][row];
    }
    for row in (0..TERMS).rev() {
        let done = (row + 1..TERMS).map(|k| matrix[k][row] * x[k]).sum::<f64>();
        x[row] = (x[row] - done) / matrix[row][row];
    }
    Some(x)
}
