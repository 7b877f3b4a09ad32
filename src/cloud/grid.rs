//! Points sorted into square cells, on the host and in f64: for what is done once.

use glam::{DVec2, USizeVec2};

/// A cell list over a rectangle.
pub struct Grid {
    cell: f64,
    cells: USizeVec2,
    start: Vec<u32>,
    points: Vec<u32>,
}

impl Grid {
    /// Sorts `position` into cells of about `cell` m a side; a point outside the rectangle counts to the nearest cell.
    pub fn new(position: &[DVec2], size: DVec2, cell: f64) -> Self {
        // Never many more cells than points, whatever the shape of the rectangle.
        let most = (4 * position.len() + 16) as f64;
        let cell = cell.max((size.x * size.y / most).sqrt()).max(size.max_element() / most);
        let cells = (size / cell).floor().as_usizevec2() + 1;
        let mut grid = Self { cell, cells, start: vec![0; cells.x * cells.y + 1], points: vec![0; position.len()] };
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

    /// The points in the ring of cells at Chebyshev distance `ring` from the cell of `place`.
    pub fn ring(&self, place: DVec2, ring: usize) -> impl Iterator<Item = usize> + '_ {
        let centre = self.cell_of(place);
        let centre = (centre.x as i64, centre.y as i64);
        let reach = ring as i64;
        (-reach..=reach)
            .flat_map(move |dy| {
                // Whole rows at the top and the bottom of the ring, two cells on the rows between.
                let step = if dy.abs() == reach { 1 } else { (2 * reach).max(1) };
                (-reach..=reach).step_by(step as usize).flat_map(move |dx| self.cell(centre.0 + dx, centre.1 + dy))
            })
            .map(|&point| point as usize)
    }

    /// Distance within which the rings `0..=ring` around any place hold every point, m.
    pub fn reach(&self, ring: usize) -> f64 {
        ring as f64 * self.cell
    }

    /// Number of rings after which there is nothing left to find.
    pub fn rings(&self) -> usize {
        self.cells.max_element()
    }

    fn cell(&self, x: i64, y: i64) -> std::slice::Iter<'_, u32> {
        let inside = x >= 0 && y >= 0 && (x as usize) < self.cells.x && (y as usize) < self.cells.y;
        let range = if inside {
            let cell = self.index(USizeVec2::new(x as usize, y as usize));
            self.start[cell] as usize..self.start[cell + 1] as usize
        } else {
            0..0
        };
        self.points[range].iter()
    }
}
