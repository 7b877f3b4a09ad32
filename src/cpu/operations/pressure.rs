//! What the iterative pressure solvers share: the matrix as rows, when to stop, what to report.

use std::ops::Range;

use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::operations::lists::PACKS;
use crate::cpu::real::{Pack, Real};
use crate::engine::{Outcome, SolveInfo};

/// A pressure matrix, a block of rows at a time.
pub trait Rows<T: Real>: Sync {
    /// `A p` at the points of a block, pack by pack.
    fn products(&self, block: usize, p: &[T]) -> [T::Pack; PACKS];

    /// Calls `body(i, (A p)_i)` for the packs of whole blocks of points.
    #[inline(always)]
    fn multiply(&self, range: Range<usize>, p: &[T], mut body: impl FnMut(usize, T::Pack)) {
        for block in range.start / BLOCK..range.end / BLOCK {
            for (i, product) in blocks::packs::<T>(block, usize::MAX).zip(self.products(block, p)) {
                body(i, product);
            }
        }
    }

    /// Adds to `sums` the squares of two entries in the unit that the tolerance is in: of the residual, and of the
    /// diagonal times the solution, which is what rounding errors are measured against.
    fn measure(&self, i: usize, residual: T::Pack, size: T::Pack, sums: &mut [T::Pack]);
}

/// When an iterative solve stops.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stop {
    /// Root mean square of the residual, as a density `r_i / V_i`, at which the solve is done.
    pub residual: f64,
    pub max_iterations: u32,
    /// Rounding units of the diagonal's product below which a residual is as small as it gets.
    pub floor: f64,
    /// The matrix has the constants in its null space: the mean of a residual counts for nothing.
    pub singular: bool,
}

impl Stop {
    /// Iterations without a tenth off the best residual after which a solve has stagnated: a long channel of some ten thousand
    /// points stands still for 250 and goes on.
    pub const PATIENCE: u32 = 600;
    /// Times that a solve may begin again from a recomputed residual that is not what the recurrence promised.
    pub const RESTARTS: u32 = 3;
    /// [`Stop::floor`] of the conservative matrix, with about 6 entries a row.
    pub const CONSERVATIVE_FLOOR: f64 = 4.0;
    /// And of the collocated one: four times the entries, of either sign, round twice as far.
    pub const COLLOCATED_FLOOR: f64 = 8.0;
}

/// Whether to go on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    Continue,
    /// By the recurrence: recompute.
    Check,
    Done,
}

/// Watches the residual of one solve.
pub struct Monitor {
    stop: Stop,
    points: usize,
    best: f64,
    since_best: u32,
    starts: u32,
    pub info: SolveInfo,
}

impl Monitor {
    pub fn new(stop: Stop, points: usize) -> Self {
        Self { stop, points, best: f64::INFINITY, since_best: 0, starts: 0, info: SolveInfo::default() }
    }

    fn reached<T: Real>(&self, square: f64, scale: f64) -> (f64, bool) {
        let rms = |square: f64| (square / self.points as f64).sqrt();
        let floor = self.stop.floor * T::EPSILON.to_f64() * rms(scale);
        (rms(square), rms(square) <= self.stop.residual.max(floor))
    }

    /// Takes a residual recomputed from the solution: the first one, and one after every stretch of iterations.
    pub fn recomputed<T: Real>(&mut self, square: f64, scale: f64) -> Verdict {
        let (now, reached) = self.reached::<T>(square, scale);
        if self.starts == 0 {
            self.info.first_residual = now;
        }
        self.info.last_residual = now;
        if !now.is_finite() {
            self.info.outcome = Outcome::BrokeDown;
        } else if reached {
            self.info.outcome = Outcome::Converged;
        } else if self.starts > Stop::RESTARTS || self.info.iterations >= self.stop.max_iterations {
            self.info.outcome = Outcome::Stagnated;
        } else if self.info.outcome == Outcome::Converged {
            self.starts += 1;
            (self.best, self.since_best) = (now, 0);
            return Verdict::Continue;
        }
        Verdict::Done
    }

    /// Takes a residual from the recurrence, after one more iteration.
    pub fn iterated<T: Real>(&mut self, square: f64, scale: f64) -> Verdict {
        self.info.iterations += 1;
        let (now, reached) = self.reached::<T>(square, scale);
        if now < 0.9 * self.best {
            (self.best, self.since_best) = (now, 0);
        } else {
            self.since_best += 1;
        }
        if !now.is_finite() {
            self.info.outcome = Outcome::BrokeDown;
        } else if self.since_best >= Stop::PATIENCE {
            self.info.outcome = Outcome::Stagnated;
        } else if !reached && self.info.iterations < self.stop.max_iterations {
            return Verdict::Continue;
        }
        Verdict::Check
    }
}

/// Root mean square of what `pressure` leaves of `source`, `b - A p` less its mean over the first `shifted` rows, which have a
/// multiplier where the matrix is singular, in the unit that the tolerance is in.
pub fn residual<T: Real>(matrix: &impl Rows<T>, points: usize, shifted: usize, source: &[T], pressure: &[T]) -> f64 {
    let left = |i: usize, product: T::Pack| T::Pack::load(&source[i..]) - product;
    let [sum] = blocks::sum_ranges(source.len(), &|range| {
        let mut sum = 0.0;
        matrix.multiply(range, pressure, |i, product| sum += lanes::<T>(within::<T>(left(i, product), i, shifted)));
        [sum]
    });
    let mean = T::Pack::splat(T::from_f64(sum / shifted.max(1) as f64));
    let [square] = blocks::sum_ranges(source.len(), &|range| {
        let mut sums = [T::Pack::zero(); 2];
        matrix.multiply(range, pressure, |i, product| {
            let left = left(i, product) - within::<T>(mean, i, shifted);
            matrix.measure(i, within::<T>(left, i, points), T::Pack::zero(), &mut sums);
        });
        [lanes::<T>(sums[0])]
    });
    (square / points as f64).sqrt()
}

/// Sum over the lanes.
#[inline(always)]
pub fn lanes<T: Real>(pack: T::Pack) -> f64 {
    (0..T::Pack::LANES).map(|lane| pack.lane(lane).to_f64()).sum()
}

/// `value`, zero in the lanes past the last point.
#[inline(always)]
pub fn within<T: Real>(value: T::Pack, i: usize, points: usize) -> T::Pack {
    if i + T::Pack::LANES <= points {
        return value;
    }
    T::Pack::from_lanes(|lane| if i + lane < points { value.lane(lane) } else { T::zero() })
}
