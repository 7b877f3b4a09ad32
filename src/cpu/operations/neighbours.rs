//! Neighbour search: the points within the radius `r_e` of each point, through a cell list.
//!
//! The cells are squares of side `r_e`; counting, a running sum and a stable scatter put the points in order, cell by
//! cell, so that the same points give the same lists. Shapes: one list of `capacity` slots a point, blocked.

use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::operations::space::Space;
use crate::cpu::real::{One, Real};
use crate::step::Grid;

/// Points sorted into cells, to be searched.
#[derive(Clone, Copy)]
pub struct Search<'a, T, S> {
    pub position: &'a [T],
    pub points: usize,
    pub grid: &'a Grid,
    /// Where each cell's points begin in `sorted`; one more entry than cells.
    pub start: &'a [u32],
    /// The points, cell by cell, ascending within a cell.
    pub sorted: &'a [u32],
    pub space: S,
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

impl<T: Real, S: Space<T>> Search<'_, T, S> {
    /// Calls `found(j)` for every point within `radius` of point `i`, `i` itself apart, in the order of the cells: along
    /// each row from the window's first, past the seam where it reaches there.
    #[inline(always)]
    pub fn within(&self, i: usize, radius: T, mut found: impl FnMut(u32)) {
        self.around(i, radius, |j, near| {
            if near {
                found(j);
            }
        });
    }

    /// Calls `met(j, near)` for every point in the cells around point `i`, in that order, and says whether it is within `radius`.
    #[inline(always)]
    fn around(&self, i: usize, radius: T, mut met: impl FnMut(u32, bool)) {
        let (position, grid, space) = (self.position, self.grid, self.space);
        let own = [position[2 * i], position[2 * i + 1]];
        let [cx, cy] = grid.cell_of(own.map(Real::to_f64));
        let [nx, ny] = grid.cells;
        let [left, columns] = grid.window(0, cx, radius.to_f64());
        let [bottom, rows] = grid.window(1, cy, radius.to_f64());
        let beyond = (left + columns).saturating_sub(nx);
        for y in bottom..bottom + rows {
            let row = ((if y < ny { y } else { y - ny }) * nx) as usize;
            for [from, to] in [[left, left + columns - beyond], [0, beyond]] {
                let (first, last) = (self.start[row + from as usize], self.start[row + to as usize]);
                for &j in &self.sorted[first as usize..last as usize] {
                    let d = [position[2 * j as usize] - own[0], position[2 * j as usize + 1] - own[1]];
                    let [dx, dy] = space.shortest(d.map(One)).map(|d| d.0);
                    // No branch: which points are near follows no pattern.
                    met(j, (j as usize != i) & (dx * dx + dy * dy < radius * radius));
                }
            }
        }
    }
}

/// Fills the list of every point. Returns the largest number of neighbours met; above `capacity` the lists are cut off
/// and the caller reports it.
pub fn find_neighbours<T: Real, S: Space<T>>(
    search: Search<T, S>,
    radius: T,
    capacity: usize,
    neighbours: &mut [u32],
    count: &mut [u32],
) -> usize {
    list(search, &|_| radius, capacity, neighbours, count)
}

/// The same where every point has its own radius.
pub fn find_local_neighbours<T: Real, S: Space<T>>(
    search: Search<T, S>,
    support: &[T],
    capacity: usize,
    neighbours: &mut [u32],
    count: &mut [u32],
) -> usize {
    list(search, &|i| support[i], capacity, neighbours, count)
}

fn list<T: Real, S: Space<T>>(
    search: Search<T, S>,
    radius: &(impl Fn(usize) -> T + Sync),
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
                search.around(i, radius(i), |j, near| {
                    // One that is not near is written over by the next.
                    if met < capacity {
                        neighbours[met * BLOCK + lane] = j;
                    }
                    met += usize::from(near);
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
    use crate::cloud::{shortest, test_clouds};
    use crate::cpu::operations::space::Domain;
    use crate::with_space;

    #[test]
    fn equal_to_brute_force() {
        for cloud in test_clouds() {
            let points = cloud.len();
            let position: Vec<f64> = cloud.position.iter().flat_map(|place| [place.x, place.y]).collect();
            let radius = 2.6 * cloud.spacing;
            let grid = Grid::new(cloud.size, cloud.period, radius);
            let (mut start, mut sorted) = (vec![0; grid.count() + 1], vec![0; points]);
            build_cells(&position, points, &grid, &mut start, &mut sorted);
            let padded = blocks::padded(points);
            let capacity = 64;
            let (mut neighbours, mut count) = (vec![0; padded * capacity], vec![0; padded]);
            let domain = Domain::new(cloud.size, cloud.period);
            with_space!(domain, space => {
                let (position, start, sorted) = (&position[..], &start[..], &sorted[..]);
                let search = Search { position, points, grid: &grid, start, sorted, space };
                find_neighbours(search, radius, capacity, &mut neighbours, &mut count)
            });
            for i in 0..points {
                let mut found: Vec<u32> =
                    (0..count[i] as usize).map(|slot| neighbours[blocks::at(i, slot, capacity)]).collect();
                found.sort_unstable();
                let near = |&j: &u32| {
                    let offset = cloud.position[j as usize] - cloud.position[i];
                    j as usize != i && shortest(offset, cloud.period).length_squared() < radius * radius
                };
                let brute: Vec<u32> = (0..points as u32).filter(near).collect();
                assert_eq!(found, brute, "point {i}");
            }
        }
    }
}
