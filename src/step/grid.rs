//! The cells of the neighbour search: how places map to them, the same on both engines.

use glam::DVec2;

/// Square cells over the rectangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// Cells along x and y.
    pub cells: [u32; 2],
    /// Cells per metre: the reciprocal of their side.
    pub per_metre: f64,
}

impl Grid {
    /// Most cells along an axis: beyond it cells are made larger than the radius.
    const MOST: f64 = 32_768.0;

    /// Cells no smaller than `radius`, m, over a rectangle of `size`, m.
    pub fn new(size: DVec2, radius: f64) -> Self {
        // A little above the radius, so that rounding to f32 never puts a neighbour two cells away: a place of many cells
        // from the origin is off by as many rounding units.
        let slack = 1.0 + 1e-6 * (size.max_element() / radius).clamp(10.0, Self::MOST);
        let side = (radius * slack).max(size.max_element() / Self::MOST);
        let along = |length: f64| (length / side).floor() as u32 + 1;
        Self { cells: [along(size.x), along(size.y)], per_metre: 1.0 / side }
    }

    /// Number of cells.
    pub fn count(&self) -> usize {
        self.cells[0] as usize * self.cells[1] as usize
    }

    /// The cell of a place; one outside the rectangle counts to the nearest cell.
    #[inline(always)]
    pub fn cell_of(&self, place: [f64; 2]) -> [u32; 2] {
        // A cast from float saturates: negative places and NaN go to 0.
        [
            ((place[0] * self.per_metre) as u32).min(self.cells[0] - 1),
            ((place[1] * self.per_metre) as u32).min(self.cells[1] - 1),
        ]
    }
}
