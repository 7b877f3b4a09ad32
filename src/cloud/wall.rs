//! The four sides of the rectangle and the points on them.

use std::ops::Range;

use glam::DVec2;

use super::outline::divided;
use super::sizing::Sizing;
use crate::case::{Boundaries, SideKind, SideProfile, Wall};

/// One side of the rectangle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
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

impl Side {
    /// What the side prescribes at a place on it, m/s, in a rectangle of `size`, m; `None` where it follows the fluid.
    pub fn velocity(self, boundaries: &Boundaries, place: DVec2, size: DVec2) -> Option<DVec2> {
        let wall = self.wall(boundaries);
        let along = self.normal().perp().abs();
        let s = place.dot(along) / size.dot(along);
        let share = match wall.profile {
            SideProfile::Uniform => 1.0,
            SideProfile::Parabola => 4.0 * s * (1.0 - s),
        };
        match wall.kind {
            SideKind::Wall | SideKind::Inlet => Some(share * DVec2::from(wall.velocity)),
            SideKind::Slip | SideKind::Outlet => None,
        }
    }
}

/// Number of spacings along each axis.
pub(super) fn cells(size: DVec2, spacing: f64) -> [usize; 2] {
    [(size.x / spacing).round().max(1.0) as usize, (size.y / spacing).round().max(1.0) as usize]
}

/// The square lattice over the rectangle: on the walls where an axis ends at them, half a spacing off the seam where it
/// repeats.
pub(super) struct Lattice {
    /// Width and height of the rectangle, m.
    pub size: DVec2,
    /// Number of spacings along each axis.
    pub cells: [usize; 2],
    pub periodic: [bool; 2],
}

impl Lattice {
    /// The place `(i, j)`; the last of an axis that ends at walls falls on the far one exactly.
    pub fn place(&self, i: usize, j: usize) -> DVec2 {
        let along = |k: usize, axis: usize| {
            let (length, n) = (self.size[axis], self.cells[axis]);
            match self.periodic[axis] {
                true => length * (k as f64 + 0.5) / n as f64,
                false if k == n => length,
                false => length * k as f64 / n as f64,
            }
        };
        DVec2::new(along(i, 0), along(j, 1))
    }

    /// The numbers of the places along an axis that are not on walls.
    pub fn inner(&self, axis: usize) -> Range<usize> {
        usize::from(!self.periodic[axis])..self.cells[axis]
    }

    /// Number of places that are not on walls.
    pub fn interior(&self) -> usize {
        self.inner(0).len() * self.inner(1).len()
    }
}

/// Points on the walls, corners included, one lattice spacing apart, and the sides that each lies on.
pub(super) fn points(lattice: &Lattice) -> (Vec<DVec2>, Vec<Vec<Side>>) {
    let [nx, ny] = lattice.cells;
    let [x, y] = lattice.periodic;
    let mut places: Vec<[usize; 2]> = Vec::with_capacity(2 * (nx + ny));
    let along = if x { 0..nx } else { 0..nx + 1 };
    let ends = |periodic: bool, last: usize| if periodic { vec![] } else { vec![0, last] };
    if !y {
        places.extend(along.clone().map(|i| [i, 0]));
    }
    places.extend(lattice.inner(1).flat_map(|j| ends(x, nx).into_iter().map(move |i| [i, j])));
    if !y {
        places.extend(along.map(|i| [i, ny]));
    }
    let position = places.iter().map(|&[i, j]| lattice.place(i, j)).collect();
    let sides = places.iter().map(|&[i, j]| {
        let touching = [
            (!x && i == 0, Side::Left),
            (!x && i == nx, Side::Right),
            (!y && j == 0, Side::Bottom),
            (!y && j == ny, Side::Top),
        ];
        touching.iter().filter(|(on, _)| *on).map(|&(_, side)| side).collect()
    });
    (position, sides.collect())
}

/// The same, as far apart as `sizing` says.
pub(super) fn graded_points(sizing: &Sizing, [x, y]: [bool; 2]) -> (Vec<DVec2>, Vec<Vec<Side>>) {
    let size = sizing.size();
    let (mut position, mut sides) = (Vec::new(), Vec::new());
    let mut put = |place: DVec2| {
        let touching = [
            (!x && place.x == 0.0, Side::Left),
            (!x && place.x == size.x, Side::Right),
            (!y && place.y == 0.0, Side::Bottom),
            (!y && place.y == size.y, Side::Top),
        ];
        position.push(place);
        sides.push(touching.iter().filter(|(on, _)| *on).map(|&(_, side)| side).collect());
    };
    // The far end of an axis that repeats is the near one again.
    let until_end = |mut cuts: Vec<f64>, periodic: bool| {
        if periodic {
            cuts.pop();
        }
        cuts
    };
    for height in if y { vec![] } else { vec![0.0, size.y] } {
        let at = |share: f64| DVec2::new(share * size.x, height);
        let cuts = divided(size.x, &|share| sizing.at(at(share)));
        until_end(cuts, x).into_iter().for_each(|share| put(at(share)));
    }
    for width in if x { vec![] } else { vec![0.0, size.x] } {
        let at = |share: f64| DVec2::new(width, share * size.y);
        let mut cuts = until_end(divided(size.y, &|share| sizing.at(at(share))), y);
        if !y {
            // The corners are there already.
            cuts.retain(|share| (0.0 < *share) && (*share < 1.0));
        }
        cuts.into_iter().for_each(|share| put(at(share)));
    }
    (position, sides)
}
