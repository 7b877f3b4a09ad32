//! The lists of neighbours, as the search fills them and as everything that sums over neighbours walks them.

use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::real::{Pack, Real};

/// The neighbours of every point, slot by slot as the rows are.
#[derive(Clone, Copy)]
pub struct Lists<'a> {
    pub neighbours: &'a [u32],
    pub count: &'a [u32],
    pub capacity: usize,
}

impl Lists<'_> {
    /// Calls `body(slot, indexes)` for every slot of the points `i..i + LANES`; unused slots hold the point itself.
    #[inline(always)]
    pub fn for_each<T: Real>(&self, i: usize, mut body: impl FnMut(usize, &[u32])) {
        let rows = self.count[i..i + T::Pack::LANES].iter().copied().max().unwrap_or(0) as usize;
        let first = blocks::at(i, 0, self.capacity);
        for slot in 0..rows.min(self.capacity) {
            let start = first + slot * BLOCK;
            body(slot, &self.neighbours[start..start + T::Pack::LANES]);
        }
    }

    /// `sum_j row_ij (p_j - p_i)` for the points `i..i + LANES`; `row` has an entry for every slot, blocked.
    #[inline(always)]
    pub fn differences<T: Real>(&self, i: usize, row: &[T], p: &[T]) -> T::Pack {
        let first = blocks::at(i, 0, self.capacity);
        let own = T::Pack::load(&p[i..]);
        let mut sum = T::Pack::zero();
        self.for_each::<T>(i, |slot, index| {
            // SAFETY: every stored neighbour is below the number of points.
            let other = unsafe { T::Pack::gather(p, index) };
            sum += T::Pack::load(&row[first + slot * BLOCK..]) * (other - own);
        });
        sum
    }
}
