//! Points sorted into square cells, on the host and in f64: for what is done once.

use std::ops::Range;

use glam::{DVec2, USizeVec2};

/// A cell list over a rectangle, which may repeat along an axis.
pub struct Grid {
    /// Sides of a cell, m.
    cell: DVec2,
    cells: USizeVec2,
    periodic: [bool; 2],
    start: Vec<u32>,
    points: Vec<u32>,
}

impl Grid {
    /// Sorts `position` into cells of `cell` m a side or more; a point outside the rectangle counts to the nearest cell.
    /// `period` is the rectangle's own length along an axis that repeats, 0 along another.
    pub fn new(position: &[DVec2], size: DVec2, period: DVec2, cell: f64) -> Self {
        // Never many more cells than points, whatever the shape of the rectangle.
        let most = (4 * position.len() + 16) as f64;
        let cell = cell.max((size.x * size.y / most).sqrt()).max(size.max_element() / most);
        let periodic = [period.x > 0.0, period.y > 0.0];
        let whole = (size / cell).floor().as_usizevec2();
        // Cells that fill a period leave no rest.
        let along = |axis: usize| match periodic[axis] {
            true => (whole[axis].max(1), size[axis] / whole[axis].max(1) as f64),
            false => (whole[axis] + 1, cell),
        };
        let [(columns, width), (rows, height)] = [along(0), along(1)];
        let (cells, cell) = (USizeVec2::new(columns, rows), DVec2::new(width, height));
        let (start, points) = (vec![0; columns * rows + 1], vec![0; position.len()]);
        let mut grid = Self { cell, cells, periodic, start, points };
        let of: Vec<u32> = position.iter().map(|&place| grid.index(grid.cell_of(place)) as u32).collect();
        for &cell in &of {
            grid.start[cell as usize + 1] += 1;
        }
        for cell in 0..cells.x * cells.y {
            grid.start[cell + 1] += grid.start[cell];
        }
        let mut cursor = grid.start.clone();
        for (point, &cell) in of.iter().enumerate() {
            grid.points[cursor[cell as usize] as usize] = point as u32;
            cursor[cell as usize] += 1;
        }
        grid
    }

    fn index(&self, cell: USizeVec2) -> usize {
        cell.y * self.cells.x + cell.x
    }

    fn cell_of(&self, place: DVec2) -> USizeVec2 {
        // A cast from float saturates, so that no place is out of range.
        (place / self.cell).max(DVec2::ZERO).as_usizevec2().min(self.cells - 1)
    }

    /// Columns and rows.
    pub fn cells(&self) -> USizeVec2 {
        self.cells
    }

    /// The points, cell by cell and row by row.
    pub fn sorted(&self) -> &[u32] {
        &self.points
    }

    /// Where those of some cells of a row stand among them.
    pub fn span(&self, row: usize, columns: Range<usize>) -> Range<usize> {
        let first = row * self.cells.x;
        self.start[first + columns.start] as usize..self.start[first + columns.end] as usize
    }

    /// The points in the ring of cells at Chebyshev distance `ring` from the cell of `place`, no cell twice.
    pub fn ring(&self, place: DVec2, ring: usize) -> impl Iterator<Item = usize> + '_ {
        let centre = self.cell_of(place);
        let reach = ring as i64;
        (-reach..=reach)
            .flat_map(move |dy| {
                // Whole rows at the top and the bottom of the ring, two cells on the rows between.
                let step = if dy.abs() == reach { 1 } else { (2 * reach).max(1) };
                (-reach..=reach).step_by(step as usize).flat_map(move |dx| self.cell(centre, [dx, dy]))
            })
            .map(|&point| point as usize)
    }

    /// Distance within which the rings `0..=ring` around any place hold every point, m.
    pub fn reach(&self, ring: usize) -> f64 {
        ring as f64 * self.cell.min_element()
    }

    /// The points of the rings that hold all within `distance`, m, of `place`, and some more.
    pub fn within(&self, place: DVec2, distance: f64) -> impl Iterator<Item = usize> + '_ {
        let last = (1..=self.rings()).find(|&ring| self.reach(ring) >= distance).unwrap_or(self.rings());
        (0..=last).flat_map(move |ring| self.ring(place, ring))
    }

    /// Number of rings after which there is nothing left to find.
    pub fn rings(&self) -> usize {
        self.cells.max_element()
    }

    /// The points of the cell `offset` cells from `centre`.
    fn cell(&self, centre: USizeVec2, offset: [i64; 2]) -> std::slice::Iter<'_, u32> {
        let along = |axis: usize| {
            let (count, offset) = (self.cells[axis] as i64, offset[axis]);
            let at = centre[axis] as i64 + offset;
            let inside = match self.periodic[axis] {
                // Half of them on either side.
                true => -(count - 1) / 2 <= offset && offset <= count / 2,
                false => (0..count).contains(&at),
            };
            inside.then(|| at.rem_euclid(count) as usize)
        };
        let range = match (along(0), along(1)) {
            (Some(x), Some(y)) => {
                let cell = self.index(USizeVec2::new(x, y));
                self.start[cell] as usize..self.start[cell + 1] as usize
            }
            _ => 0..0,
        };
        self.points[range].iter()
    }
}
