//! Voronoi cells of the points, clipped by the walls of the rectangle and the outlines of obstacles: the geometry of the
//! conservative pressure equation.
//!
//! Every point clips its own cell from the bisectors with the points around it; no mesh is stored. A pair of points
//! that share a face of length `A_ij` gets one weight `w_ij = w_ji = A_ij / |d_ij|`, and every point its volume `V_i`.
//! Then `sum_j w_ij d_ij = -A_i n_i`, `4 V_i = sum_j w_ij |d_ij|^2` inside, and the volumes sum to the area. Along an axis that
//! repeats there is no wall, and offsets go the shortest way.
//!
//! Cells of points on outlines, and no others, touch these (`outline.rs`). Such a cell is cut along the middle of the angle that
//! the fluid has at its point: each half is convex, whatever the angle, and ends at the straight way from the point to the
//! place where the next cell begins. What lies between that way and a curved outline is counted in the volume.
//! Units: m for faces, m^2 for volumes; the weights have none.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use glam::DVec2;
use rayon::prelude::*;

use super::grid::Grid;
use super::{Cloud, Side, inside, shortest};

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

/// The part of one side of the rectangle, or of half the way to the next point of an outline, that lies on one cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallPiece {
    /// Whose cell it is on.
    pub point: usize,
    pub of: Boundary,
    /// m
    pub middle: DVec2,
    /// `A_i n_i`: outward, as long as the piece, m.
    pub area: DVec2,
}

/// What a piece of wall belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Boundary {
    Side(Side),
    /// Its number in the case.
    Obstacle(usize),
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
        let grid = grid(cloud);
        let corners = corners(cloud);
        let mut cells: Vec<Cell> =
            (0..cloud.len()).into_par_iter().map(|point| clip(cloud, point, &grid, corners.get(&point))).collect();
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

    /// The volume flux out of every cell through the walls, m^2/s, where the fluid in the middle of a piece of them moves with
    /// `velocity`, m/s. The midpoint rule leaves a little over, of second order in the spacing, which is spread over what lets fluid through:
    /// as much flows in as out.
    pub fn wall_flux(&self, velocity: &dyn Fn(&WallPiece) -> DVec2) -> Vec<f64> {
        let mut flux = vec![0.0; self.volume.len()];
        let through = |piece: &WallPiece| velocity(piece).dot(piece.area);
        // Over what lets something through: a wall stays tight.
        let open: Vec<(&WallPiece, f64)> =
            self.walls.iter().map(|piece| (piece, through(piece))).filter(|&(_, flux)| flux != 0.0).collect();
        let length: f64 = open.iter().map(|(piece, _)| piece.area.length()).sum();
        let excess = open.iter().map(|(_, flux)| flux).sum::<f64>() / length.max(f64::MIN_POSITIVE);
        for (piece, through) in open {
            flux[piece.point] += through - excess * piece.area.length();
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
    Wall(Boundary),
    Point(u32),
    /// The other half of the same cell.
    Half,
}

/// An outline as one of its points sees it.
#[derive(Clone, Copy)]
struct Corner {
    obstacle: usize,
    /// The ways to the ends of the cell's pieces of it: back and on, anticlockwise round the obstacle, m.
    ways: [DVec2; 2],
    /// What the obstacle has beyond these ways, m^2.
    bulge: f64,
}

/// The points of outlines, and how these look there.
fn corners(cloud: &Cloud) -> BTreeMap<usize, Corner> {
    let mut corners = BTreeMap::new();
    for (obstacle, outline) in cloud.outlines.iter().enumerate() {
        let count = outline.points.len();
        for k in 0..count {
            let (point, before) = (outline.points.start + k, (k + count - 1) % count);
            let own = cloud.position[point];
            let ways = [outline.middle[before] - own, outline.middle[k] - own];
            corners.insert(point, Corner { obstacle, ways, bulge: outline.bulge[before][1] + outline.bulge[k][0] });
        }
    }
    corners
}

/// The points sorted for the search of those around a cell.
pub(super) fn grid(cloud: &Cloud) -> Grid {
    let typical = match &cloud.local {
        Some(_) => (cloud.area() / cloud.len() as f64).sqrt(),
        None => cloud.spacing,
    };
    Grid::new(&cloud.position, cloud.size, cloud.period, 1.5 * typical)
}

/// A convex polygon; edge `k` runs from corner `k` to the next, relative to the cell's point.
#[derive(Clone, Default)]
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

/// The Voronoi cell of a point in the rectangle.
fn polygon(cloud: &Cloud, point: usize, grid: &Grid) -> Polygon {
    let Cloud { position, size, period, .. } = cloud;
    let own = position[point];
    // From wall to wall; along a period as far as the point's own image can matter.
    let repeats = period.cmpgt(DVec2::ZERO);
    let low = DVec2::select(repeats, -0.5 * *period, -own);
    let high = DVec2::select(repeats, 0.5 * *period, *size - own);
    let mut polygon = Polygon::default();
    let sides = [
        (low, Side::Bottom),
        (DVec2::new(high.x, low.y), Side::Right),
        (high, Side::Top),
        (DVec2::new(low.x, high.y), Side::Left),
    ];
    polygon.corners.extend(sides.map(|(corner, side)| (corner, Across::Wall(Boundary::Side(side)))));
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
    polygon
}

/// The middle of a cell that touches no outline, weighted with `density`, as an offset from nowhere: a place, m. The weight is
/// that of the middle of each triangle between the point and an edge.
pub(super) fn middle(cloud: &Cloud, point: usize, grid: &Grid, density: &dyn Fn(DVec2) -> f64) -> DVec2 {
    let own = cloud.position[point];
    let corners = polygon(cloud, point, grid).corners;
    let (mut mass, mut moment) = (0.0, DVec2::ZERO);
    for k in 0..corners.len() {
        let (from, to) = (corners[k].0, corners[(k + 1) % corners.len()].0);
        let centre = (from + to) / 3.0;
        let part = 0.5 * from.perp_dot(to) * density(own + centre);
        mass += part;
        moment += part * centre;
    }
    own + moment / mass
}

/// The half of a polygon that lies anticlockwise of `from` and clockwise of `to`, less than half a turn apart.
fn half(polygon: &Polygon, (from, before): (DVec2, Across), (to, after): (DVec2, Across)) -> Polygon {
    let mut half = polygon.clone();
    half.cut(-from.perp(), 0.0, before);
    half.cut(to.perp(), 0.0, after);
    half
}

fn clip(cloud: &Cloud, point: usize, grid: &Grid, corner: Option<&Corner>) -> Cell {
    let whole = polygon(cloud, point, grid);
    let mut cell = Cell { volume: 0.0, faces: Vec::with_capacity(whole.corners.len()), walls: Vec::new() };
    match corner {
        None => cell.add(cloud, point, &whole),
        Some(&Corner { obstacle, ways: [back, on], bulge }) => {
            // The fluid is anticlockwise of the way back.
            let turn = back.angle_to(on).rem_euclid(TAU);
            let between = DVec2::from_angle(0.5 * turn).rotate(back);
            let (wall, cut) = (Across::Wall(Boundary::Obstacle(obstacle)), (between, Across::Half));
            cell.add(cloud, point, &half(&whole, (back, wall), cut));
            cell.add(cloud, point, &half(&whole, cut, (on, wall)));
            cell.volume -= bulge;
            cell.join();
        }
    }
    cell.faces.sort_unstable_by_key(|face| face.neighbour);
    cell
}

impl Cell {
    /// Takes in a convex part.
    fn add(&mut self, cloud: &Cloud, point: usize, part: &Polygon) {
        let Cloud { position, period, .. } = cloud;
        let own = position[point];
        for k in 0..part.corners.len() {
            let (from, across) = part.corners[k];
            let (to, _) = part.corners[(k + 1) % part.corners.len()];
            self.volume += 0.5 * from.perp_dot(to);
            let length = from.distance(to);
            if length <= LEAST_FACE * cloud.spacing_at(point) {
                continue;
            }
            match across {
                Across::Point(other) => {
                    let offset = shortest(position[other as usize] - own, *period);
                    let distance = offset.length();
                    // The middle between the points lies on the face's line.
                    let shift = 0.5 * (from + to).dot(offset.perp()) / distance;
                    self.faces.push(Face { neighbour: other, weight: length / distance, shift });
                }
                // Corners run against the clock: outward is to the right.
                Across::Wall(of) => {
                    let middle = inside(own + 0.5 * (from + to), *period);
                    self.walls.push(WallPiece { point, of, middle, area: -(to - from).perp() });
                }
                Across::Half => {}
            }
        }
    }

    /// Joins the two pieces of a face that the cut between the halves runs through.
    fn join(&mut self) {
        self.faces.sort_by_key(|face| face.neighbour);
        self.faces.dedup_by(|other, face| {
            let same = other.neighbour == face.neighbour;
            if same {
                let weight = face.weight + other.weight;
                face.shift = (face.weight * face.shift + other.weight * other.shift) / weight;
                face.weight = weight;
            }
            same
        });
    }
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
