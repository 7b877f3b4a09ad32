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
    /// Slots that any of the points `i..i + LANES` uses.
    #[inline(always)]
    fn used<T: Real>(&self, i: usize) -> usize {
        let most = self.count[i..i + T::Pack::LANES].iter().copied().max().unwrap_or(0);
        (most as usize).min(self.capacity)
    }

    /// Calls `body(slot, indexes)` for every slot of the points `i..i + LANES`; unused slots hold the point itself.
    #[inline(always)]
    pub fn for_each<T: Real>(&self, i: usize, mut body: impl FnMut(usize, &[u32])) {
        let first = blocks::at(i, 0, self.capacity);
        for slot in 0..self.used::<T>(i) {
            let start = first + slot * BLOCK;
            body(slot, &self.neighbours[start..start + T::Pack::LANES]);
        }
    }

    /// `sum_j row_ij (p_j - p_i)` for the points of a block; `row` has an entry for every slot, blocked.
    #[inline(always)]
    pub fn differences<T: Real>(&self, block: usize, row: &[T], p: &[T]) -> [T::Pack; PACKS] {
        let own = own(p, block);
        self.fold(block, row, T::Pack::zero(), |sum, pack, index, [factor]| {
            // SAFETY: every stored neighbour is below the number of points.
            sum + factor * (unsafe { T::Pack::gather(p, index) } - own[pack])
        })
    }

    /// Folds `term(sum, pack, indexes, factors)` over the slots of the points of a block, from `start` on: a sum for each of its packs,
    /// which go side by side, as their entries stand in memory. Of `E` factors a slot, blocked, `row` has those of all slots one after
    /// the other.
    #[inline(always)]
    pub fn fold<T: Real, A: Copy, const E: usize>(
        &self,
        block: usize,
        row: &[T],
        start: A,
        term: impl Fn(A, usize, &[u32], [T::Pack; E]) -> A,
    ) -> [A; PACKS] {
        let mut slots = [0; PACKS];
        for (slots, i) in slots.iter_mut().zip(blocks::packs::<T>(block, usize::MAX)) {
            *slots = self.used::<T>(i);
        }
        let width = self.capacity * BLOCK;
        let neighbours = &self.neighbours[block * width..][..width];
        let row = &row[E * block * width..][..E * width];
        let term = |sum: A, pack: usize, slot: usize| {
            let (at, k) = (slot * BLOCK, pack * T::Pack::LANES);
            let index = &neighbours[at..at + BLOCK];
            let mut factors = [T::Pack::zero(); E];
            for (e, factor) in factors.iter_mut().enumerate() {
                *factor = T::Pack::load(&row[e * width + at..][..BLOCK][k..]);
            }
            term(sum, pack, &index[k..k + T::Pack::LANES], factors)
        };
        let packs = BLOCK / T::Pack::LANES;
        let mut sums = [start; PACKS];
        // What all have, then what some have more.
        let common = slots[..packs].iter().copied().min().unwrap_or(0);
        for slot in 0..common {
            unrolled!(pack < PACKS => {
                if pack < packs {
                    sums[pack] = term(sums[pack], pack, slot);
                }
            });
        }
        for pack in 0..packs {
            for slot in common..slots[pack] {
                sums[pack] = term(sums[pack], pack, slot);
            }
        }
        sums
    }
}

/// Most packs of a block: of `f64`.
pub const PACKS: usize = BLOCK / 4;

/// The values at the points of a block, pack by pack.
#[inline(always)]
pub fn own<T: Real>(field: &[T], block: usize) -> [T::Pack; PACKS] {
    let mut own = [T::Pack::zero(); PACKS];
    for (own, i) in own.iter_mut().zip(blocks::packs::<T>(block, usize::MAX)) {
        *own = T::Pack::load(&field[i..]);
    }
    own
}

/// The same of interleaved vectors.
#[inline(always)]
pub fn own_vectors<T: Real>(field: &[T], block: usize) -> [[T::Pack; 2]; PACKS] {
    let mut own = [[T::Pack::zero(); 2]; PACKS];
    for (own, i) in own.iter_mut().zip(blocks::packs::<T>(block, usize::MAX)) {
        *own = T::Pack::load_vectors(&field[2 * i..]);
    }
    own
}
