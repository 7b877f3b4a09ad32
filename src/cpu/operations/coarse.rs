//! A coarse pressure: what the solvers add to a residual over the diagonal, so that they need not carry the pressure from neighbour
//! to neighbour through the whole fluid.
//!
//! Continuous: the pressure's error is smooth after a few iterations, and a smooth one is that of far fewer points. Discrete: cells
//! of the neighbour search where points move, aggregates of some four points where they stand (`aggregates.rs`), `K_0 = R K R^T` with
//! `R` the sum over the points of each; then four to one,
//! `K_(l+1) = R K_l R^T / 2`: the halves make up for steps of `R^T`, which are steeper than the slope that they stand for. One cycle
//! goes down and up through the grids with a damped Jacobi step before and after on each:
//! `z = r / D + R^T (cycle)(R r)`, linear in `r`, and symmetric where `K` is. Units: those of the matrix.
//! Sources: Braess, Computing 55 (1995) 379-393 (sums over aggregates, and what they are divided by); Tatebe, NASA CP 3224 (1993)
//! 621-634 (a cycle as preconditioner of conjugate gradients).
//! Shapes: see [`crate::step::coarse`]; the matrix entry by entry, all places of one after those of the one before.

use std::ops::Range;

use crate::cpu::blocks;
use crate::cpu::operations::lists::Lists;
use crate::cpu::real::{Pack, Real};
use crate::step::coarse::{AROUND, ENTRIES, Level};

/// What the matrix of a coarser grid is divided by.
pub const SCALE: f64 = 2.0;
/// Sums that take turns.
const TURNS: usize = 4;
/// Number of the sum over neighbours that have a factor, but no entry.
const BEYOND: u8 = AROUND as u8;
/// Sums of a row, with room to a power of two.
const SUMS: usize = 16;
/// Share of a Jacobi step that is taken.
pub const DAMPING: f64 = 0.8;

/// Where points stand in the grids: cells with their points, and the grids above.
#[derive(Clone, Copy)]
pub struct Grids<'a> {
    pub levels: &'a [Level],
    /// Where each cell's points begin in `sorted`.
    pub start: &'a [u32],
    pub sorted: &'a [u32],
}

impl Grids<'_> {
    /// Calls `body(place, points)` for every cell of the finest grid.
    fn for_each_cell(&self, mut body: impl FnMut(usize, &[u32])) {
        let finest = self.levels[0];
        for row in 0..finest.rows {
            for column in 0..finest.columns {
                let cell = row * finest.columns + column;
                let points = self.start[cell] as usize..self.start[cell + 1] as usize;
                body(finest.at(column, row), &self.sorted[points]);
            }
        }
    }
}

/// Fills the place of each point's cell, 0 where the pressure is held: at the surface and from `pressured` on.
pub fn place(grids: Grids, surface: &[u32], pressured: usize, cell: &mut [u32]) {
    cell.fill(0);
    grids.for_each_cell(|place, points| {
        for &point in points {
            let free = (point as usize) < pressured && surface[point as usize] == 0;
            cell[point as usize] = if free { place as u32 } else { 0 };
        }
    });
}

/// Fills the rows of all grids. `sign` is 1 where the factors in `row` are of `p_i - p_j`, -1 where they are of `p_j - p_i`.
pub fn assemble<T: Real>(grids: Grids, lists: Lists, row: &[T], sign: T, cell: &[u32], matrix: &mut [T]) {
    let places = matrix.len() / ENTRIES;
    matrix.fill(T::zero());
    let stride = grids.levels[0].stride();
    // Which sum the neighbours in a place belong to, by how far it is behind the lowest around a cell, and 1. Those in the cell itself
    // have one to themselves, and those whose pressure is held another, at 0.
    let mut number = vec![BEYOND; 2 * stride + 4];
    for (entry, (up, along)) in (0..AROUND as u8).zip((0..3).flat_map(|up| (0..3).map(move |along| (up, along)))) {
        number[up * stride + along + 1] = entry;
    }
    for (i, &place) in cell.iter().enumerate().filter(|&(_, &place)| place != 0) {
        // In turn, so that an addition need not wait for the one before.
        let mut sums = [[T::zero(); SUMS]; TURNS];
        for slot in 0..(lists.count[i] as usize).min(lists.capacity) {
            let at = blocks::at(i, slot, lists.capacity);
            let other = cell[lists.neighbours[at] as usize] as usize;
            // No branch: which neighbours share a cell follows no pattern.
            let way = if other == 0 { 0 } else { other + stride + 2 - place as usize };
            sums[slot % TURNS][number[way] as usize % SUMS] += row[at];
        }
        let sum = |entry: usize| -> T { sums.iter().map(|sums| sums[entry]).sum() };
        let mut own = sum(BEYOND as usize);
        for entry in (0..AROUND).filter(|&entry| entry != AROUND / 2) {
            let sum = sum(entry);
            own += sum;
            matrix[entry * places + place as usize] -= sign * sum;
        }
        matrix[AROUND / 2 * places + place as usize] += sign * own;
    }
    for row in 0..grids.levels[0].rows {
        let level = grids.levels[0];
        (level.at(0, row)..level.at(level.columns, row)).for_each(|place| set_smoothing(matrix, places, place));
    }
    for pair in grids.levels.windows(2) {
        let (fine, coarse) = (pair[0], pair[1]);
        for row in 0..coarse.rows {
            for column in 0..coarse.columns {
                let mut sums = [T::zero(); AROUND];
                let own = |(x, y): (usize, usize)| matrix[AROUND / 2 * places + fine.at(x, y)];
                if children(fine, column, row).all(|child| own(child) == T::zero()) {
                    continue;
                }
                for (x, y) in children(fine, column, row) {
                    for entry in 0..AROUND {
                        // Where the cell beyond lies, seen from the coarse one.
                        let across = |fine: usize, way: usize| (fine + 1 + way) / 2 - fine / 2;
                        let to = 3 * across(y, entry / 3) + across(x, entry % 3);
                        sums[to] += matrix[entry * places + fine.at(x, y)];
                    }
                }
                let place = coarse.at(column, row);
                for (entry, sum) in sums.into_iter().enumerate() {
                    matrix[entry * places + place] = sum * T::from_f64(1.0 / SCALE);
                }
                set_smoothing(matrix, places, place);
            }
        }
    }
}

/// The cells that make up a coarse one.
fn children(fine: Level, column: usize, row: usize) -> impl Iterator<Item = (usize, usize)> {
    let span = |coarse: usize, count: usize| 2 * coarse..(2 * coarse + 2).min(count);
    let columns = span(column, fine.columns);
    span(row, fine.rows).flat_map(move |y| columns.clone().map(move |x| (x, y)))
}

/// What a smoothing step multiplies with at a cell: nothing where there is no row.
fn set_smoothing<T: Real>(matrix: &mut [T], places: usize, place: usize) {
    let own = matrix[AROUND / 2 * places + place];
    matrix[AROUND * places + place] = if own == T::zero() { own } else { T::from_f64(DAMPING) / own };
}

/// What a preconditioner adds to `r / D`.
pub trait Correction<T: Real>: Sync {
    /// False where there is none.
    const PRESENT: bool;

    /// Takes a residual; returns its product with what is to be added.
    fn correct(&mut self, residual: &[T]) -> f64;

    /// What is added at the points `i..i + LANES`.
    fn at(&self, i: usize) -> T::Pack;
}

/// Jacobi's preconditioner alone.
pub struct Nothing;

impl<T: Real> Correction<T> for Nothing {
    const PRESENT: bool = false;

    fn correct(&mut self, _: &[T]) -> f64 {
        0.0
    }

    #[inline(always)]
    fn at(&self, _: usize) -> T::Pack {
        T::Pack::zero()
    }
}

/// Vectors over all places.
#[derive(Debug, Clone, Default)]
pub struct Vectors<T> {
    pub right: Vec<T>,
    pub value: Vec<T>,
    pub smoothed: Vec<T>,
}

impl<T: Real> Vectors<T> {
    pub fn new(places: usize) -> Self {
        let zeros = vec![T::zero(); places];
        Self { right: zeros.clone(), value: zeros.clone(), smoothed: zeros }
    }

    /// All zero again: a cycle leaves out places that have no row in the matrix.
    pub fn clear(&mut self) {
        [&mut self.right, &mut self.value, &mut self.smoothed].into_iter().for_each(|vector| vector.fill(T::zero()));
    }
}

/// What the cycle goes through: levels, each of some places, and the matrix of each.
pub trait Hierarchy<T: Real>: Sync {
    fn levels(&self) -> usize;

    /// The places of a level, as ranges of arrays of all levels.
    fn ranges(&self, level: usize) -> impl Iterator<Item = Range<usize>>;

    /// What a smoothing step multiplies with, at all places.
    fn smoothing(&self) -> &[T];

    /// Sums a residual at the points up over the finest level.
    fn sum_points(&self, residual: &[T], right: &mut [T]);

    /// `b - K x` on a level.
    fn left(&self, level: usize, right: &[T], value: &[T], out: &mut [T]);

    /// Sums what is left on a level up over the one above, as its right side.
    fn sum_up(&self, level: usize, left: &[T], right: &mut [T]);

    /// Adds what the level above has found.
    fn bring_down(&self, level: usize, above: &[T], value: &mut [T]);
}

/// A coarse pressure.
pub struct Coarse<'a, T, H> {
    pub hierarchy: H,
    /// The place of each point's cell, or aggregate.
    pub cell: &'a [u32],
    pub vectors: &'a mut Vectors<T>,
}

impl<T: Real, H: Hierarchy<T>> Correction<T> for Coarse<'_, T, H> {
    const PRESENT: bool = true;

    fn correct(&mut self, residual: &[T]) -> f64 {
        let Self { hierarchy, vectors: Vectors { right, value, smoothed }, .. } = self;
        let (smoothing, levels) = (hierarchy.smoothing(), hierarchy.levels());
        hierarchy.sum_points(residual, right);
        for level in 0..levels {
            for at in hierarchy.ranges(level) {
                for ((x, b), s) in value[at.clone()].iter_mut().zip(&right[at.clone()]).zip(&smoothing[at]) {
                    *x = *s * *b;
                }
            }
            if level + 1 < levels {
                // What the first smoothing leaves; kept where the second goes.
                hierarchy.left(level, right, value, smoothed);
                hierarchy.sum_up(level, smoothed, right);
            }
        }
        for level in (0..levels).rev() {
            if level + 1 < levels {
                hierarchy.bring_down(level, smoothed, value);
            }
            hierarchy.left(level, right, value, smoothed);
            for at in hierarchy.ranges(level) {
                for ((e, x), s) in smoothed[at.clone()].iter_mut().zip(&value[at.clone()]).zip(&smoothing[at]) {
                    *e = *x + *s * *e;
                }
            }
        }
        let mut sum = 0.0;
        for at in hierarchy.ranges(0) {
            let row: T = right[at.clone()].iter().zip(&smoothed[at]).fold(T::zero(), |sum, (b, e)| sum + *b * *e);
            sum += row.to_f64();
        }
        sum
    }

    #[inline(always)]
    fn at(&self, i: usize) -> T::Pack {
        // SAFETY: every cell stored is one of the places, of which each of the vectors has one; place 0 holds zero.
        unsafe { T::Pack::gather(&self.vectors.smoothed, &self.cell[i..i + T::Pack::LANES]) }
    }
}

/// Cells of grids, and the matrix over them.
pub struct Gridded<'a, T> {
    grids: Grids<'a>,
    matrix: &'a [T],
    /// The columns of each row that lie between the first cell and the last that have a row in the matrix; level by level.
    wet: Vec<Vec<Range<usize>>>,
}

impl<'a, T: Real> Gridded<'a, T> {
    pub fn new(grids: Grids<'a>, matrix: &'a [T]) -> Self {
        let smoothing = &matrix[matrix.len() / ENTRIES * AROUND..];
        let wet = |level: &Level| {
            let row = |row| {
                let has_row = |column: &usize| smoothing[level.at(*column, row)] != T::zero();
                let first = (0..level.columns).find(has_row).unwrap_or(0);
                first..(first..level.columns).rfind(has_row).map_or(first, |last| last + 1)
            };
            (0..level.rows).map(row).collect()
        };
        Self { grids, matrix, wet: grids.levels.iter().map(wet).collect() }
    }

    fn places(&self) -> usize {
        self.matrix.len() / ENTRIES
    }
}

impl<T: Real> Hierarchy<T> for Gridded<'_, T> {
    fn levels(&self) -> usize {
        self.grids.levels.len()
    }

    fn ranges(&self, level: usize) -> impl Iterator<Item = Range<usize>> {
        let grid = self.grids.levels[level];
        let rows = self.wet[level].iter().enumerate();
        rows.map(move |(row, wet)| grid.at(wet.start, row)..grid.at(wet.end, row))
    }

    fn smoothing(&self) -> &[T] {
        &self.matrix[AROUND * self.places()..]
    }

    fn sum_points(&self, residual: &[T], right: &mut [T]) {
        self.grids.for_each_cell(|place, points| {
            right[place] = points.iter().map(|&point| residual[point as usize]).fold(T::zero(), |sum, r| sum + r);
        });
    }

    fn left(&self, level: usize, right: &[T], value: &[T], out: &mut [T]) {
        let (places, stride) = (self.places(), self.grids.levels[level].stride());
        for at in self.ranges(level) {
            out[at.clone()].copy_from_slice(&right[at.clone()]);
            for entry in 0..AROUND {
                let from = at.start + entry / 3 * stride + entry % 3 - stride - 1;
                let factors = &self.matrix[entry * places..][at.clone()];
                for ((out, factor), x) in out[at.clone()].iter_mut().zip(factors).zip(&value[from..from + at.len()]) {
                    *out -= *factor * *x;
                }
            }
        }
    }

    fn sum_up(&self, level: usize, left: &[T], right: &mut [T]) {
        let (fine, coarse) = (self.grids.levels[level], self.grids.levels[level + 1]);
        for (row, wet) in self.wet[level + 1].iter().enumerate() {
            for column in wet.clone() {
                let left = children(fine, column, row).map(|(x, y)| left[fine.at(x, y)]);
                right[coarse.at(column, row)] = left.fold(T::zero(), |sum, left| sum + left);
            }
        }
    }

    fn bring_down(&self, level: usize, above: &[T], value: &mut [T]) {
        let (fine, coarse) = (self.grids.levels[level], self.grids.levels[level + 1]);
        for (row, wet) in self.wet[level].iter().enumerate() {
            for column in wet.clone() {
                value[fine.at(column, row)] += above[coarse.at(column / 2, row / 2)];
            }
        }
    }
}
