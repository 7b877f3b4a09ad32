//! Fluid in a part of the rectangle: a lattice of points whose outermost are the free surface.
//!
//! Beside a wall that mirrors the fluid the first points stand half a spacing off it, so that each is one spacing from its
//! image. Beside a wall of points (MPS) they stand one spacing off it. Where the fluid ends they stand on its end.

use glam::DVec2;

use super::Cloud;
use super::arrangement::{jitter, sort_by_cell};
use super::wall::{self, Lattice, Side};
use crate::case::{Arrangement, Case, Fill, PressureForm};

/// Rows of points behind a wall of MPS, in spacings beyond the radius of the neighbourhood a wall point sees none.
fn rows_behind(case: &Case) -> usize {
    (case.method.radius() - 1e-9).floor() as usize
}

/// The points of a case with `cloud.fill`.
pub(super) fn build(case: &Case, fill: &Fill) -> Cloud {
    let size = DVec2::new(case.domain.width, case.domain.height);
    let spacing = case.cloud.spacing;
    let walls = case.effects.pressure.as_ref().is_some_and(|pressure| pressure.form() == PressureForm::Integral);
    let [x, y] = [0, 1].map(|axis| Line::new(fill.from[axis], fill.to[axis], size[axis], spacing, walls));
    let mut position: Vec<DVec2> = (0..y.count)
        .flat_map(|j| (0..x.count).map(move |i| (i, j)))
        .map(|(i, j)| DVec2::new(x.place(i), y.place(j)))
        .collect();
    if case.cloud.arrangement == Arrangement::Jittered {
        jitter(&case.cloud, &mut position, |place| !on_surface(fill, size, place));
    }
    if let Some(wave) = &fill.wave {
        let [low, high] = [fill.from[1], fill.to[1]];
        for place in &mut position {
            let phase = std::f64::consts::PI * f64::from(wave.half_waves) * (place.x - fill.from[0])
                / (fill.to[0] - fill.from[0]);
            place.y += wave.amplitude * phase.cos() * (place.y - low) / (high - low);
        }
    }
    sort_by_cell(&mut position, 2.0 * spacing);
    let interior = position.len();
    let (mut normal, mut sides) = (Vec::new(), Vec::new());
    let mut pressured = interior;
    if walls {
        let lattice = Lattice { size, cells: wall::cells(size, spacing), periodic: [false; 2] };
        let (boundary, of) = wall::points(&lattice);
        position.extend(boundary);
        pressured = position.len();
        sides = of;
        let (behind, of) = behind_walls(&lattice, rows_behind(case));
        position.extend(behind);
        sides.extend(of);
        normal = sides.iter().map(|sides| sides.iter().map(|side| side.normal()).sum::<DVec2>().normalize()).collect();
    }
    // Between mirrors the lattice is fitted to the fill: what the points are measured against is its own spacing.
    let spacing = if walls { spacing } else { (x.step * y.step).sqrt() };
    let filled = Some(x.step * y.step);
    let (outlines, local, period) = (Vec::new(), None, DVec2::ZERO);
    Cloud { interior, pressured, normal, position, sides, outlines, filled, spacing, local, size, period }
}

/// Where the fluid ends inside the domain.
fn on_surface(fill: &Fill, size: DVec2, place: DVec2) -> bool {
    (0..2).any(|axis| {
        let near = |end: f64| (place[axis] - end).abs() < 1e-9 * size[axis];
        (near(fill.from[axis]) && fill.from[axis] > 0.0) || (near(fill.to[axis]) && fill.to[axis] < size[axis])
    })
}

/// The places along one axis.
#[derive(Clone, Copy)]
struct Line {
    first: f64,
    step: f64,
    count: usize,
}

impl Line {
    fn new(from: f64, to: f64, length: f64, spacing: f64, walls: bool) -> Self {
        // How far from its end the first point stands, in spacings.
        let off = |at_wall: bool| match (at_wall, walls) {
            (false, _) => 0.0,
            (true, false) => 0.5,
            (true, true) => 1.0,
        };
        let within = 1e-9 * length;
        let [low, high] = [off(from <= within), off(to >= length - within)];
        // Half a gap too many, as between a wall and the surface, is one more, whatever rounding made of it.
        let gaps = ((to - from) / spacing - low - high + 1e-6).round().max(0.0);
        let step = (to - from) / (gaps + low + high);
        Self { first: from + low * step, step, count: gaps as usize + 1 }
    }

    fn place(self, k: usize) -> f64 {
        self.first + k as f64 * self.step
    }
}

/// Points on `rows` lattice lines outside the rectangle, and the sides that each lies behind.
fn behind_walls(lattice: &Lattice, rows: usize) -> (Vec<DVec2>, Vec<Vec<Side>>) {
    let [nx, ny] = lattice.cells.map(|count| count as i64);
    let rows = rows as i64;
    let step = DVec2::new(lattice.size.x / nx as f64, lattice.size.y / ny as f64);
    let (mut position, mut sides) = (Vec::new(), Vec::new());
    for (i, j) in (-rows..=ny + rows).flat_map(|j| (-rows..=nx + rows).map(move |i| (i, j))) {
        let beyond = [(i < 0, Side::Left), (i > nx, Side::Right), (j < 0, Side::Bottom), (j > ny, Side::Top)];
        let of: Vec<Side> = beyond.iter().filter(|(beyond, _)| *beyond).map(|&(_, side)| side).collect();
        if !of.is_empty() {
            position.push(DVec2::new(i as f64, j as f64) * step);
            sides.push(of);
        }
    }
    (position, sides)
}
