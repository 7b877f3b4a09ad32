//! The cells of the neighbour search: how places map to them, the same on both engines.

use glam::DVec2;

/// Cells over the rectangle: squares, but where a period takes a whole number of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// Cells along x and y.
    pub cells: [u32; 2],
    /// Cells per metre along x and y: the reciprocals of their sides.
    pub per_metre: [f64; 2],
    /// The axes along which the last cell meets the first.
    pub periodic: [bool; 2],
}

impl Grid {
    /// Most cells along an axis: beyond it cells are made larger than the radius.
    const MOST: f64 = 32_768.0;

    /// Cells no smaller than `radius`, m, over a rectangle of `size`, m. `period` is its own length along an axis that
    /// repeats, 0 along another.
    pub fn new(size: DVec2, period: DVec2, radius: f64) -> Self {
        // A little above the radius, so that rounding to f32 never puts a neighbour two cells away: a place of many cells
        // from the origin is off by as many rounding units.
        let slack = 1.0 + 1e-6 * (size.max_element() / radius).clamp(10.0, Self::MOST);
        let side = (radius * slack).max(size.max_element() / Self::MOST);
        let along = |length: f64, period: f64| match (length / side).floor() {
            whole if period > 0.0 => (whole.max(1.0) as u32, whole.max(1.0) / period),
            whole => (whole as u32 + 1, 1.0 / side),
        };
        let [(columns, across), (rows, up)] = [along(size.x, period.x), along(size.y, period.y)];
        let periodic = [period.x > 0.0, period.y > 0.0];
        Self { cells: [columns, rows], per_metre: [across, up], periodic }
    }

    /// Number of cells.
    pub fn count(&self) -> usize {
        self.cells[0] as usize * self.cells[1] as usize
    }

    /// The cell of a place; one outside the rectangle counts to the nearest cell.
    #[inline(always)]
    pub fn cell_of(&self, place: [f64; 2]) -> [u32; 2] {
        // A cast from float saturates: negative places and NaN go to 0.
        let along = |axis: usize| ((place[axis] * self.per_metre[axis]) as u32).min(self.cells[axis] - 1);
        [along(0), along(1)]
    }

    /// The cells along an axis that are within `radius`, m, of any place in `cell`: the first, and how many follow each
    /// other from there, past the seam where there is one; none twice.
    #[inline(always)]
    pub fn window(&self, axis: usize, cell: u32, radius: f64) -> [u32; 2] {
        let count = self.cells[axis];
        let ring = (radius * self.per_metre[axis]).ceil().max(1.0) as u32;
        if !self.periodic[axis] {
            let first = cell.saturating_sub(ring);
            return [first, (cell + ring).min(count - 1) - first + 1];
        }
        if 2 * ring + 1 >= count { [0, count] } else { [(cell + count - ring) % count, 2 * ring + 1] }
    }
}
