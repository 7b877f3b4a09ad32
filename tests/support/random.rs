//! Random numbers, the same in every run.

use glam::DVec2;
use rand_core::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

pub struct Random(Xoshiro256PlusPlus);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(Xoshiro256PlusPlus::seed_from_u64(seed))
    }

    /// In [-1, 1).
    pub fn number(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    #[allow(dead_code, reason = "not every file of tests asks for it")]
    pub fn vector(&mut self) -> DVec2 {
        let x = self.number();
        DVec2::new(x, self.number())
    }

    #[allow(dead_code, reason = "not every file of tests asks for it")]
    pub fn numbers(&mut self, count: usize) -> Vec<f64> {
        (0..count).map(|_| self.number()).collect()
    }
}
