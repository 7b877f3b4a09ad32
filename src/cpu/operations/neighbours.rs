//! Neighbour search: the points within the radius `r_e` of each point, through a cell list.
//!
//! The cells are squares of side `r_e`; counting, a running sum and a stable scatter put the points in order, cell by
//! cell, so that the same points give the same lists. Shapes: one list of `capacity` slots a point, blocked.

use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::real::Real;
use crate::step::Grid;

/// Points sorted into cells, to be searched.
#[derive(Clone, Copy)]
pub struct Search<'a, T> {
    pub position: &'a [T],
    pub points: usize,
    pub grid: &'a Grid,
    /// Where each cell's points begin in `sorted`; one more entry than cells.
    pub start: &'a [u32],
    /// The points, cell by cell, ascending within a cell.
    pub sorted: &'a [u32],
}

/// Sorts points into cells: fills what [`Search`] calls `start` and `sorted`.
pub fn build_cells<T: Real>(position: &[T], points: usize, grid: &Grid, start: &mut [u32], sorted: &mut [u32]) {
    let cell_of = |point: usize| {
        let [x, y] = grid.cell_of([position[2 * point].to_f64(), position[2 * point + 1].to_f64()]);
        (y * grid.cells[0] + x) as usize
    };
    start.fill(0);
    for point in 0..points {
        start[cell_of(point) + 1] += 1;
    }
    for cell in 0..grid.count() {
        start[cell + 1] += start[cell];
    }
    // Each start serves as its cell's cursor, ends where the next cell begins, and is shifted back into place.
    for point in 0..points {
        let cell = cell_of(point);
        sorted[start[cell] as usize] = point as u32;
        start[cell] += 1;
    }
    start.copy_within(0..grid.count(), 1);
    start[0] = 0;
}

impl<T: Real> Search<'_, T> {
    /// Calls `found(j)` for every point within `radius` of point `i`, `i` itself apart, in the order of the cells.
    #[inline(always)]
    pub fn within(&self, i: usize, radius: T, mut found: impl FnMut(u32)) {
        let (position, grid) = (self.position, self.grid);
        let own = [position[2 * i], position[2 * i + 1]];
        let [cx, cy] = grid.cell_of(own.map(Real::to_f64));
        let ring = (radius.to_f64() * grid.per_metre).ceil().max(1.0) as u32;
        let [nx, ny] = grid.cells;
        for y in cy.saturating_sub(ring)..=(cy + ring).min(ny - 1) {
            let row = (y * nx) as usize;
            let first = self.start[row + cx.saturating_sub(ring) as usize] as usize;
            let last = self.start[row + (cx + ring).min(nx - 1) as usize + 1] as usize;
            for &j in &self.sorted[first..last] {
                let (dx, dy) = (position[2 * j as usize] - own[0], position[2 * j as usize + 1] - own[1]);
                if j as usize != i && dx * dx + dy * dy < radius * radius {
                    found(j);
                }
            }
        }
    }
}

/// Fills the list of every point. Returns the largest number of neighbours met; above `capacity` the lists are cut off
/// and the caller reports it.
pub fn find_neighbours<T: Real>(
    search: Search<T>,
    radius: T,
    capacity: usize,
    neighbours: &mut [u32],
    count: &mut [u32],
) -> usize {
    let points = search.points;
    blocks::for_each_2((neighbours, capacity), (&mut *count, 1), &|block, neighbours, count| {
        for lane in 0..BLOCK {
            let i = block * BLOCK + lane;
            let own = i.min(points - 1);
            let mut met = 0;
            if i < points {
                search.within(i, radius, |j| {
                    if met < capacity {
                        neighbours[met * BLOCK + lane] = j;
                    }
                    met += 1;
                });
            }
            for slot in met..capacity {
                neighbours[slot * BLOCK + lane] = own as u32;
            }
            count[lane] = met as u32;
        }
    });
    count.iter().copied().max().unwrap_or(0) as usize
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cloud::test_clouds;

    #[test]
    fn equal_to_brute_force() {
        for cloud in test_clouds() {
            let points = cloud.len();
            let position: Vec<f64> = cloud.position.iter().flat_map(|place| [place.x, place.y]).collect();
            let radius = 2.6 * cloud.spacing;
            let grid = Grid::new(cloud.size, radius);
            let (mut start, mut sorted) = (vec![0; grid.count() + 1], vec![0; points]);
            build_cells(&position, points, &grid, &mut start, &mut sorted);
            let search = Search { position: &position, points, grid: &grid, start: &start, sorted: &sorted };
            let padded = blocks::padded(points);
            let capacity = 64;
            let (mut neighbours, mut count) = (vec![0; padded * capacity], vec![0; padded]);
            find_neighbours(search, radius, capacity, &mut neighbours, &mut count);
            for i in 0..points {
                let mut found: Vec<u32> =
                    (0..count[i] as usize).map(|slot| neighbours[blocks::at(i, slot, capacity)]).collect();
                found.sort_unstable();
                let near = |&j: &u32| {
                    j as usize != i && cloud.position[j as usize].distance_squared(cloud.position[i]) < radius * radius
                };
                let brute: Vec<u32> = (0..points as u32).filter(near).collect();
                assert_eq!(found, brute, "point {i}");
            }
        }
    }
}
