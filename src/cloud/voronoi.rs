//! Voronoi cells of the points, clipped by the walls of the rectangle: the geometry of the conservative pressure equation.
//!
//! Every point clips its own cell from the bisectors with the points around it; no mesh is stored. A pair of points
//! that share a face of length `A_ij` gets one weight `w_ij = w_ji = A_ij / |d_ij|`, and every point its volume `V_i`.
//! Then `sum_j w_ij d_ij = -A_i n_i`, `4 V_i = sum_j w_ij |d_ij|^2` inside, and the volumes sum to the area. Along an axis that
//! repeats there is no wall, and offsets go the shortest way.
//! Units: m for faces, m^2 for volumes; the weights have none.

use glam::DVec2;
use rayon::prelude::*;

use super::grid::Grid;
use super::{Cloud, inside, shortest};

/// Faces shorter than this fraction of the spacing are left out: lattice points that touch at a corner alone.
const LEAST_FACE: f64 = 1e-7;

/// The cells of all points of a cloud.
#[derive(Debug, Clone, PartialEq)]
pub struct Cells {
    /// Volume of every cell, m^2.
    pub volume: Vec<f64>,
    /// Where each point's faces begin in `neighbour` and `weight`; one more entry than points.
    pub start: Vec<usize>,
    /// The point across each face.
    pub neighbour: Vec<u32>,
    /// `w_ij` of each face; the same number from both sides.
    pub weight: Vec<f64>,
    /// How far the middle of each face lies beside the middle between its points: to the left on the way to `neighbour`, m.
    pub shift: Vec<f64>,
    /// The pieces of wall, point by point.
    pub walls: Vec<WallPiece>,
}

/// The part of one side of the rectangle that lies on one cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallPiece {
    /// Whose cell it is on.
    pub point: usize,
    /// m
    pub middle: DVec2,
    /// `A_i n_i`: outward, as long as the piece, m.
    pub area: DVec2,
}

/// One cell on its own.
struct Cell {
    volume: f64,
    /// Ascending by neighbour.
    faces: Vec<Face>,
    walls: Vec<WallPiece>,
}

/// One face, as one of its cells sees it.
#[derive(Clone, Copy)]
struct Face {
    neighbour: u32,
    weight: f64,
    shift: f64,
}

impl Cells {
    /// Clips the cells of a cloud.
    pub fn build(cloud: &Cloud) -> Self {
        let grid = Grid::new(&cloud.position, cloud.size, cloud.period, 1.5 * cloud.spacing);
        let mut cells: Vec<Cell> = (0..cloud.len()).into_par_iter().map(|point| clip(cloud, point, &grid)).collect();
        symmetrise(&mut cells);
        let mut start = Vec::with_capacity(cells.len() + 1);
        start.push(0);
        start.extend(cells.iter().scan(0, |sum, cell| {
            *sum += cell.faces.len();
            Some(*sum)
        }));
        Self {
            volume: cells.iter().map(|cell| cell.volume).collect(),
            start,
            neighbour: cells.iter().flat_map(|cell| cell.faces.iter().map(|face| face.neighbour)).collect(),
            weight: cells.iter().flat_map(|cell| cell.faces.iter().map(|face| face.weight)).collect(),
            shift: cells.iter().flat_map(|cell| cell.faces.iter().map(|face| face.shift)).collect(),
            walls: cells.into_iter().flat_map(|cell| cell.walls).collect(),
        }
    }

    /// The faces of one point: neighbours and weights.
    pub fn faces(&self, point: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let range = self.start[point]..self.start[point + 1];
        range.map(|face| (self.neighbour[face] as usize, self.weight[face]))
    }

    /// The volume flux out of every cell through the walls, m^2/s, where the fluid at a place on them moves with `velocity`,
    /// m/s. The midpoint rule leaves a little over, of second order in the spacing, which is spread over the walls: as much
    /// flows in as out.
    pub fn wall_flux(&self, velocity: &dyn Fn(DVec2) -> DVec2) -> Vec<f64> {
        let mut flux = vec![0.0; self.volume.len()];
        let through = |piece: &WallPiece| velocity(piece.middle).dot(piece.area);
        let length: f64 = self.walls.iter().map(|piece| piece.area.length()).sum();
        let excess = self.walls.iter().map(through).sum::<f64>() / length;
        for piece in &self.walls {
            flux[piece.point] += through(piece) - excess * piece.area.length();
        }
        flux
    }

    /// The most faces that any cell has.
    pub fn most_faces(&self) -> usize {
        self.start.windows(2).map(|pair| pair[1] - pair[0]).max().unwrap_or(0)
    }
}

/// What lies across an edge of a cell.
#[derive(Clone, Copy, PartialEq)]
enum Across {
    Wall,
    Point(u32),
}

/// A convex polygon; edge `k` runs from corner `k` to the next, relative to the cell's point.
#[derive(Default)]
struct Polygon {
    corners: Vec<(DVec2, Across)>,
    scratch: Vec<(DVec2, Across)>,
}

impl Polygon {
    /// Cuts away what lies beyond the line `x . direction = offset`.
    fn cut(&mut self, direction: DVec2, offset: f64, across: Across) {
        let outside = |corner: DVec2| corner.dot(direction) - offset;
        if self.corners.iter().all(|&(corner, _)| outside(corner) <= 0.0) {
            return;
        }
        self.scratch.clear();
        for k in 0..self.corners.len() {
            let (from, edge) = self.corners[k];
            let (to, _) = self.corners[(k + 1) % self.corners.len()];
            let (a, b) = (outside(from), outside(to));
            let crossing = || from + (to - from) * (a / (a - b));
            match (a <= 0.0, b <= 0.0) {
                (true, true) => self.scratch.push((from, edge)),
                (true, false) => {
                    self.scratch.push((from, edge));
                    self.scratch.push((crossing(), across));
                }
                (false, true) => self.scratch.push((crossing(), edge)),
                (false, false) => {}
            }
        }
        std::mem::swap(&mut self.corners, &mut self.scratch);
    }

    /// Distance of the farthest corner.
    fn reach(&self) -> f64 {
        self.corners.iter().map(|(corner, _)| corner.length_squared()).fold(0.0, f64::max).sqrt()
    }
}

fn clip(cloud: &Cloud, point: usize, grid: &Grid) -> Cell {
    let Cloud { position, size, period, spacing, .. } = cloud;
    let own = position[point];
    // From wall to wall; along a period as far as the point's own image can matter.
    let repeats = period.cmpgt(DVec2::ZERO);
    let low = DVec2::select(repeats, -0.5 * *period, -own);
    let high = DVec2::select(repeats, 0.5 * *period, *size - own);
    let mut polygon = Polygon::default();
    polygon
        .corners
        .extend([low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)].map(|corner| (corner, Across::Wall)));
    // Ring by ring, until no point farther away can reach the cell.
    for ring in 0..=grid.rings() {
        for other in grid.ring(own, ring).filter(|&other| other != point) {
            let offset = shortest(position[other] - own, *period);
            polygon.cut(offset, 0.5 * offset.length_squared(), Across::Point(other as u32));
        }
        if 2.0 * polygon.reach() <= grid.reach(ring) {
            break;
        }
    }
    let mut cell = Cell { volume: 0.0, faces: Vec::with_capacity(polygon.corners.len()), walls: Vec::new() };
    for k in 0..polygon.corners.len() {
        let (from, across) = polygon.corners[k];
        let (to, _) = polygon.corners[(k + 1) % polygon.corners.len()];
        cell.volume += 0.5 * from.perp_dot(to);
        let length = from.distance(to);
        if length <= LEAST_FACE * spacing {
            continue;
        }
        match across {
            Across::Point(other) => {
                let offset = shortest(position[other as usize] - own, *period);
                let distance = offset.length();
                // The middle between the points lies on the face's line.
                let shift = 0.5 * (from + to).dot(offset.perp()) / distance;
                cell.faces.push(Face { neighbour: other, weight: length / distance, shift });
            }
            // Corners run against the clock: outward is to the right.
            Across::Wall => {
                let middle = inside(own + 0.5 * (from + to), *period);
                cell.walls.push(WallPiece { point, middle, area: -(to - from).perp() });
            }
        }
    }
    cell.faces.sort_unstable_by_key(|face| face.neighbour);
    cell
}

/// Gives both sides of every face the mean of what they found; a face seen from one side alone is a rounding matter
/// and goes.
fn symmetrise(cells: &mut [Cell]) {
    let seen: Vec<Vec<Face>> = cells.iter().map(|cell| cell.faces.clone()).collect();
    cells.par_iter_mut().enumerate().for_each(|(point, cell)| {
        cell.faces.retain_mut(|face| {
            let other = &seen[face.neighbour as usize];
            match other.binary_search_by_key(&(point as u32), |back| back.neighbour) {
                Ok(found) => {
                    face.weight = 0.5 * (face.weight + other[found].weight);
                    true
                }
                Err(_) => false,
            }
        });
    });
}
