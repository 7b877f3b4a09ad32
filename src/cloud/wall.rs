//! The four sides of the rectangle and the points on them.

use glam::DVec2;

use crate::case::{Boundaries, Wall};

/// One side of the rectangle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    Left,
    Right,
    Bottom,
    Top,
}

impl Side {
    /// Outward unit normal.
    pub fn normal(self) -> DVec2 {
        match self {
            Side::Left => DVec2::NEG_X,
            Side::Right => DVec2::X,
            Side::Bottom => DVec2::NEG_Y,
            Side::Top => DVec2::Y,
        }
    }

    /// What the case says of this side.
    pub fn wall(self, boundaries: &Boundaries) -> &Wall {
        match self {
            Side::Left => &boundaries.left,
            Side::Right => &boundaries.right,
            Side::Bottom => &boundaries.bottom,
            Side::Top => &boundaries.top,
        }
    }
}

/// Number of spacings along each axis.
pub(super) fn cells(size: DVec2, spacing: f64) -> [usize; 2] {
    [(size.x / spacing).round().max(1.0) as usize, (size.y / spacing).round().max(1.0) as usize]
}

/// The lattice place `(i, j)`; the last of each axis falls on the far wall exactly.
pub(super) fn lattice(size: DVec2, [nx, ny]: [usize; 2], i: usize, j: usize) -> DVec2 {
    let along = |k: usize, n: usize, length: f64| if k == n { length } else { length * k as f64 / n as f64 };
    DVec2::new(along(i, nx, size.x), along(j, ny, size.y))
}

/// Points on the walls, corners included, one lattice spacing apart, and the sides that each lies on.
pub(super) fn points(size: DVec2, [nx, ny]: [usize; 2]) -> (Vec<DVec2>, Vec<Vec<Side>>) {
    let mut places: Vec<[usize; 2]> = Vec::with_capacity(2 * (nx + ny));
    places.extend((0..=nx).map(|i| [i, 0]));
    places.extend((1..ny).flat_map(|j| [[0, j], [nx, j]]));
    places.extend((0..=nx).map(|i| [i, ny]));
    let position = places.iter().map(|&[i, j]| lattice(size, [nx, ny], i, j)).collect();
    let sides = places.iter().map(|&[i, j]| {
        let touching = [(i == 0, Side::Left), (i == nx, Side::Right), (j == 0, Side::Bottom), (j == ny, Side::Top)];
        touching.iter().filter(|(on, _)| *on).map(|&(_, side)| side).collect()
    });
    (position, sides.collect())
}
