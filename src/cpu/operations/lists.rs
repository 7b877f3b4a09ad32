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

    /// The same, to the last bit, for the points `i..i + ABREAST`.
    #[inline(always)]
    pub fn differences_abreast<T: Real>(&self, i: usize, row: &[T], p: &[T]) -> [T::Pack; PACKS] {
        let own = own(p, i);
        self.fold(i, row, T::Pack::zero(), |sum, pack, index, [factor]| {
            // SAFETY: every stored neighbour is below the number of points.
            sum + factor * (unsafe { T::Pack::gather(p, index) } - own[pack])
        })
    }

    /// Folds `term(sum, pack, indexes, factors)` over the slots of the points `i..i + ABREAST`, from `start` on: a sum for each pack of them,
    /// those of [`abreast`]. The packs go side by side, as their entries stand in memory. Of `E` factors a slot, blocked, `row` has those of
    /// all slots one after the other.
    #[inline(always)]
    pub fn fold<T: Real, A: Copy, const E: usize>(
        &self,
        i: usize,
        row: &[T],
        start: A,
        term: impl Fn(A, usize, &[u32], [T::Pack; E]) -> A,
    ) -> [A; PACKS] {
        let mut slots = [0; PACKS];
        for (slots, k) in slots.iter_mut().zip(abreast::<T>(i)) {
            let most = self.count[k..k + T::Pack::LANES].iter().copied().max().unwrap_or(0);
            *slots = (most as usize).min(self.capacity);
        }
        let (block, within, width) = (i / BLOCK, i % BLOCK, self.capacity * BLOCK);
        let neighbours = &self.neighbours[block * width..][..width];
        let row = &row[E * block * width..][..E * width];
        let term = |sum: A, pack: usize, slot: usize| {
            let at = slot * BLOCK + within;
            let index = &neighbours[at..at + ABREAST];
            let k = pack * T::Pack::LANES;
            let mut factors = [T::Pack::zero(); E];
            for (e, factor) in factors.iter_mut().enumerate() {
                *factor = T::Pack::load(&row[e * width + at..][..ABREAST][k..]);
            }
            term(sum, pack, &index[k..k + T::Pack::LANES], factors)
        };
        let packs = ABREAST / T::Pack::LANES;
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

/// The values at the points `i..i + ABREAST`, pack by pack.
#[inline(always)]
pub fn own<T: Real>(field: &[T], i: usize) -> [T::Pack; PACKS] {
    let mut own = [T::Pack::zero(); PACKS];
    for (own, i) in own.iter_mut().zip(abreast::<T>(i)) {
        *own = T::Pack::load(&field[i..]);
    }
    own
}

/// The same of interleaved vectors.
#[inline(always)]
pub fn own_vectors<T: Real>(field: &[T], i: usize) -> [[T::Pack; 2]; PACKS] {
    let mut own = [[T::Pack::zero(); 2]; PACKS];
    for (own, i) in own.iter_mut().zip(abreast::<T>(i)) {
        *own = T::Pack::load_vectors(&field[2 * i..]);
    }
    own
}

/// Points whose neighbours are gone through side by side: their entries of a slot fill whole lines of the cache.
pub const ABREAST: usize = 16;
/// Most packs of them: of `f64`.
pub const PACKS: usize = ABREAST / 4;

/// First points of the packs of the points `i..i + ABREAST`.
#[inline(always)]
pub fn abreast<T: Real>(i: usize) -> impl Iterator<Item = usize> {
    (i..i + ABREAST).step_by(T::Pack::LANES)
}
