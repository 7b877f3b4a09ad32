//! The levels of aggregates that the coarse pressure of points that stand still goes through; the cycle is that of `coarse.rs`.
//!
//! Shapes: see [`crate::step::aggregates`]; the matrix has the diagonal at all places, then what a smoothing step multiplies with, then
//! the links.

use std::ops::Range;

use super::coarse::Hierarchy;
use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::real::{Pack, Real};
use crate::step::aggregates::Level;

/// Aggregates, and the matrix over them.
#[derive(Clone, Copy)]
pub struct Aggregated<'a, T> {
    pub levels: &'a [Level],
    pub start: &'a [u32],
    pub parts: &'a [u32],
    pub parent: &'a [u32],
    pub neighbours: &'a [u32],
    pub matrix: &'a [T],
}

impl<T: Real> Aggregated<'_, T> {
    fn places(&self) -> usize {
        self.parent.len()
    }

    fn range(&self, level: usize) -> Range<usize> {
        let level = self.levels[level];
        level.first..level.first + level.width()
    }

    /// Sums up `from` over the parts of each aggregate of a level.
    fn sum_parts(&self, level: usize, from: impl Fn(usize) -> T + Sync, out: &mut [T]) {
        let range = self.range(level);
        let first = range.start;
        blocks::for_each(&mut out[range], 1, &|block, out| {
            for (k, out) in out.iter_mut().enumerate() {
                let place = first + block * BLOCK + k;
                let parts = &self.parts[self.start[place] as usize..self.start[place + 1] as usize];
                *out = parts.iter().fold(T::zero(), |sum, &part| sum + from(part as usize));
            }
        });
    }
}

impl<T: Real> Hierarchy<T> for Aggregated<'_, T> {
    fn levels(&self) -> usize {
        self.levels.len()
    }

    fn ranges(&self, level: usize) -> impl Iterator<Item = Range<usize>> {
        std::iter::once(self.range(level))
    }

    fn smoothing(&self) -> &[T] {
        &self.matrix[self.places()..]
    }

    fn sum_points(&self, residual: &[T], right: &mut [T]) {
        self.sum_parts(0, |point| residual[point], right);
    }

    fn left(&self, level: usize, right: &[T], value: &[T], out: &mut [T]) {
        let (range, level) = (self.range(level), self.levels[level]);
        let links = &self.matrix[2 * self.places()..];
        blocks::for_each(&mut out[range], 1, &|block, out| {
            for k in (0..out.len()).step_by(T::Pack::LANES) {
                let place = level.first + block * BLOCK + k;
                let own = T::Pack::load(&self.matrix[place..]) * T::Pack::load(&value[place..]);
                let mut left = T::Pack::load(&right[place..]) - own;
                for slot in 0..level.slots {
                    let entry = level.entry(place, slot);
                    let index = &self.neighbours[entry..entry + T::Pack::LANES];
                    // SAFETY: every neighbour stored is one of the places, of which `value` has one each.
                    let other = unsafe { T::Pack::gather(value, index) };
                    left += T::Pack::load(&links[entry..]) * other;
                }
                left.store(&mut out[k..]);
            }
        });
    }

    fn sum_up(&self, level: usize, left: &[T], right: &mut [T]) {
        self.sum_parts(level + 1, |place| left[place], right);
    }

    fn bring_down(&self, level: usize, above: &[T], value: &mut [T]) {
        let range = self.range(level);
        for (value, &parent) in value[range.clone()].iter_mut().zip(&self.parent[range]) {
            *value += above[parent as usize];
        }
    }
}
