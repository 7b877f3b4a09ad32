//! The grids of the coarse pressure: the cells of the neighbour search, then four cells to one, down to a single cell.

use super::Grid;

/// One grid. Its cells stand row by row in arrays of all grids, each row with one place free at either end, each grid with one free
/// row at either end: what would be outside is there, and zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Level {
    /// Place of its first cell.
    pub first: usize,
    pub columns: usize,
    pub rows: usize,
}

impl Level {
    /// Places from a cell to the one above.
    pub fn stride(self) -> usize {
        self.columns + 2
    }

    /// Place of a cell.
    pub fn at(self, column: usize, row: usize) -> usize {
        self.first + row * self.stride() + column
    }

    /// Place behind the free row at its end.
    fn end(self) -> usize {
        self.at(0, self.rows + 1) + self.columns + 1
    }
}

/// Entries of a cell's row of the coarse matrix: of the nine cells around, row by row, its own in the middle.
pub const AROUND: usize = 9;
/// And what a smoothing step multiplies with, after them.
pub const ENTRIES: usize = AROUND + 1;

/// The grids above the points, finest first.
pub fn levels(grid: &Grid) -> Vec<Level> {
    let mut levels: Vec<Level> = Vec::new();
    let [mut columns, mut rows] = grid.cells.map(|cells| cells as usize);
    loop {
        let start = levels.last().map_or(0, |level| level.end());
        levels.push(Level { first: start + columns + 3, columns, rows });
        if columns == 1 && rows == 1 {
            return levels;
        }
        (columns, rows) = (columns.div_ceil(2), rows.div_ceil(2));
    }
}

/// Places of all grids together.
pub fn places(grid: &Grid) -> usize {
    levels(grid).last().map_or(0, |level| level.end())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_cells_share_a_place_and_all_have_room_around() {
        let grid = Grid { cells: [7, 4], per_metre: [1.0; 2], periodic: [false; 2] };
        let mut taken = vec![false; places(&grid)];
        for level in levels(&grid) {
            for row in 0..level.rows {
                for column in 0..level.columns {
                    assert!(!std::mem::replace(&mut taken[level.at(column, row)], true));
                }
            }
        }
        for level in levels(&grid) {
            for row in [0, level.rows - 1] {
                let (left, right) = (level.at(0, row) - 1, level.at(level.columns - 1, row) + 1);
                assert!(!taken[left] && !taken[right]);
                assert!(left >= level.stride() && right + level.stride() < taken.len());
            }
        }
        let sizes: Vec<_> = levels(&grid).iter().map(|level| (level.columns, level.rows)).collect();
        assert_eq!(sizes, [(7, 4), (4, 2), (2, 1), (1, 1)]);
    }
}
