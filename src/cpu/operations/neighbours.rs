//! Neighbour search: the points within the radius `r_e` of each point, through a cell list.
//!
//! The cells are squares of side `r_e`; counting, a running sum and a stable scatter put the points in order, cell by
//! cell, so that the same points give the same lists. Shapes: one list of `capacity` slots a point, blocked.

use std::ops::Range;

use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::compact;
use crate::cpu::operations::space::Space;
use crate::cpu::real::{One, Pack, Real};
use crate::cpu::unrolled::unrolled;
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
    pub fn within(&self, i: usize, radius: T, mut found: impl FnMut(u32)) {
        let position = self.position;
        let own = [position[2 * i], position[2 * i + 1]];
        self.rows(own, radius, |row| {
            for &j in &self.sorted[row] {
                let d = [position[2 * j as usize] - own[0], position[2 * j as usize + 1] - own[1]];
                let [dx, dy] = self.space.shortest(d.map(One)).map(|d| d.0);
                if j as usize != i && dx * dx + dy * dy < radius * radius {
                    found(j);
                }
            }
        });
    }

    /// Calls `row` for every row of the cells around a place, in that order, with where its points stand in `sorted`.
    #[inline(always)]
    fn rows(&self, place: [T; 2], radius: T, mut row: impl FnMut(Range<usize>)) {
        let grid = self.grid;
        let [cx, cy] = grid.cell_of(place.map(Real::to_f64));
        let [nx, ny] = grid.cells;
        let [left, columns] = grid.window(0, cx, radius.to_f64());
        let [bottom, rows] = grid.window(1, cy, radius.to_f64());
        let beyond = (left + columns).saturating_sub(nx);
        for y in bottom..bottom + rows {
            let first = ((if y < ny { y } else { y - ny }) * nx) as usize;
            let start = |column: u32| self.start[first + column as usize] as usize;
            row(start(left)..start(left + columns - beyond));
            if beyond > 0 {
                row(start(0)..start(beyond));
            }
        }
    }

    /// The points in the order of the cells.
    fn in_order(&self) -> InOrder<T> {
        let sorted = &self.sorted[..self.points];
        let along = |axis| sorted.iter().map(move |&j| self.position[2 * j as usize + axis]);
        let rest = || std::iter::repeat_n(T::zero(), AT_ONCE);
        let mut turn = vec![0; self.points];
        for (k, &j) in (0..).zip(sorted) {
            turn[j as usize] = k;
        }
        InOrder {
            place: [along(0).chain(rest()).collect(), along(1).chain(rest()).collect()],
            point: sorted.iter().copied().chain([0; AT_ONCE]).collect(),
            turn,
        }
    }
}

/// Points that are looked at together.
const AT_ONCE: usize = compact::WIDTH;

/// Points in the order of the cells, and [`AT_ONCE`] more that are none.
struct InOrder<T> {
    /// x and y, m.
    place: [Vec<T>; 2],
    point: Vec<u32>,
    /// Where each point stands.
    turn: Vec<u32>,
}

impl<T: Real> InOrder<T> {
    /// Which of the points from `first` on are nearer than the root of `square` to a place, a bit each.
    #[inline(always)]
    fn near<S: Space<T>>(&self, first: usize, space: S, [x, y]: [T::Pack; 2], square: T::Pack) -> u32 {
        let mut near = 0;
        unrolled!(pack < AT_ONCE => {
            let k = pack * T::Pack::LANES;
            if k < AT_ONCE {
                let there = [T::Pack::load(&self.place[0][first + k..]), T::Pack::load(&self.place[1][first + k..])];
                let [dx, dy] = space.shortest([there[0] - x, there[1] - y]);
                near |= square.above(dx * dx + dy * dy) << k;
            }
        });
        near
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
    let Search { position, points, space, .. } = search;
    let order = search.in_order();
    blocks::for_each_2((neighbours, capacity), (&mut *count, 1), &|block, neighbours, count| {
        let mut found = vec![0; capacity + AT_ONCE];
        for lane in 0..BLOCK {
            let i = block * BLOCK + lane;
            let mut met = 0;
            if i < points {
                let (place, turn) = ([position[2 * i], position[2 * i + 1]], order.turn[i] as usize);
                let from = [T::Pack::splat(place[0]), T::Pack::splat(place[1])];
                let square = T::Pack::splat(radius(i) * radius(i));
                search.rows(place, radius(i), |row| {
                    let mut first = row.start;
                    while first < row.end {
                        let mut near = order.near(first, space, from, square);
                        // Less those of the next row, and the point itself.
                        near &= u32::MAX >> (u32::BITS as usize - AT_ONCE.min(row.end - first));
                        near &= !1_u32.checked_shl(turn.wrapping_sub(first) as u32).unwrap_or(0);
                        compact::write(&order.point[first..], near, &mut found[met.min(capacity)..]);
                        met += near.count_ones() as usize;
                        first += AT_ONCE;
                    }
                });
            }
            found[met.min(capacity)..].fill(i.min(points - 1) as u32);
            for slot in 0..capacity {
                neighbours[slot * BLOCK + lane] = found[slot];
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
