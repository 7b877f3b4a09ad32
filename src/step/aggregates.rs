//! The levels of the coarse pressure of points that stand still: aggregates of a few points, then of a few aggregates, and so on.

use super::BLOCK;

/// One level. Its aggregates stand one after another in arrays of all levels, whole blocks of them; the rows of its matrix slot by slot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Level {
    /// Place of its first aggregate. Place 0 is no aggregate's: what has no pressure to be found belongs there.
    pub first: usize,
    pub count: usize,
    /// Most neighbours of an aggregate.
    pub slots: usize,
    /// Where its rows begin.
    pub entries: usize,
}

impl Level {
    /// Places that it takes.
    pub fn width(self) -> usize {
        self.count.div_ceil(BLOCK) * BLOCK
    }

    /// Entry of a neighbour of its aggregate at `place`.
    pub fn entry(self, place: usize, slot: usize) -> usize {
        self.entries + slot * self.width() + place - self.first
    }

    /// The level above, of so many aggregates with so many neighbours.
    pub fn above(self, count: usize, slots: usize) -> Self {
        Self { first: self.first + self.width(), count, slots, entries: self.entries + self.slots * self.width() }
    }

    /// The level of the smallest aggregates.
    pub fn finest(count: usize, slots: usize) -> Self {
        Self { first: BLOCK, count, slots, entries: 0 }
    }
}
