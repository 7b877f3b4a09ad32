//! The lists of neighbours, as the search fills them and as everything that sums over neighbours walks them.

use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::real::{Pack, Real};
use crate::cpu::unrolled::unrolled;

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

    /// The same, to the last bit, for all points of a block: slot by slot, as the rows stand in memory.
    #[inline(always)]
    pub fn block_of_differences<T: Real>(&self, block: usize, row: &[T], p: &[T], out: &mut [T]) {
        let (first, width) = (block * BLOCK, self.capacity * BLOCK);
        let (neighbours, row) = (&self.neighbours[block * width..][..width], &row[block * width..][..width]);
        let (own, out) = (&p[first..first + BLOCK], &mut out[..BLOCK]);
        let mut slots = [0; MOST_PACKS];
        for (slots, count) in slots.iter_mut().zip(self.count[first..first + BLOCK].chunks_exact(T::Pack::LANES)) {
            *slots = (count.iter().copied().max().unwrap_or(0) as usize).min(self.capacity);
        }
        let packs = BLOCK / T::Pack::LANES;
        let term = |slot: usize, k: usize, sum: T::Pack| {
            let at = slot * BLOCK + k;
            // SAFETY: every stored neighbour is below the number of points.
            let other = unsafe { T::Pack::gather(p, &neighbours[at..]) };
            sum + T::Pack::load(&row[at..]) * (other - T::Pack::load(&own[k..]))
        };
        let mut sums = [T::Pack::zero(); MOST_PACKS];
        // What all have, then what some have more.
        let common = slots[..packs].iter().copied().min().unwrap_or(0);
        for slot in 0..common {
            unrolled!(pack < MOST_PACKS => {
                if pack < packs {
                    sums[pack] = term(slot, pack * T::Pack::LANES, sums[pack]);
                }
            });
        }
        unrolled!(pack < MOST_PACKS => {
            if pack < packs {
                let k = pack * T::Pack::LANES;
                let sum = (common..slots[pack]).fold(sums[pack], |sum, slot| term(slot, k, sum));
                sum.store(&mut out[k..]);
            }
        });
    }
}

/// Packs of a block: of `f64`, four to a pack.
const MOST_PACKS: usize = BLOCK / 4;
