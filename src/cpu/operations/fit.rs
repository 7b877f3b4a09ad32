//! The normal equations of every point, factorised, and the ladder for points whose equations are too weak.

use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::operations::moments::{self, FACTOR, Moments, PIVOT_THRESHOLD, WeightFunction};
use crate::cpu::operations::neighbours::Search;
use crate::cpu::operations::space::Space;
use crate::cpu::real::{One, Pack, Real};
use crate::step::Rung;

/// Forms and factorises the 5x5 normal matrix of every point.
///
/// `rung` becomes 0 where every pivot passed, else [`Rung::FAILED`]: those points are left to [`widen_support`].
pub fn factorise<T: Real, S: Space<T>>(
    space: S,
    position: &[T],
    support: &[T],
    neighbours: &[u32],
    count: &[u32],
    capacity: usize,
    weight: impl WeightFunction,
    factor: &mut [T],
    rung: &mut [u32],
) {
    blocks::for_each_2((factor, FACTOR), (rung, 1), &|block, factor, rung| {
        for first in (0..BLOCK).step_by(T::Pack::LANES) {
            let i = block * BLOCK + first;
            let stencil = Stencil::new(space, position, support, neighbours, count, capacity, i);
            let mut sums = Moments::<T::Pack>::zero();
            stencil.for_each(|_, [x, y], square| sums.add(x, y, weight.weight(square)));
            let (entries, least) = moments::factorise(sums.matrix());
            for (k, entry) in entries.into_iter().enumerate() {
                entry.store(&mut factor[k * BLOCK + first..]);
            }
            for lane in 0..T::Pack::LANES {
                let passed = least.lane(lane) > T::from_f64(PIVOT_THRESHOLD);
                rung[first + lane] = if passed { 0 } else { Rung::FAILED };
            }
        }
    });
}

/// A pack of points with their neighbours, in scaled coordinates.
pub struct Stencil<'a, T: Real, S> {
    space: S,
    position: &'a [T],
    neighbours: &'a [u32],
    own: [T::Pack; 2],
    /// `1 / r_e` of each point.
    pub per_support: T::Pack,
    first: usize,
    rows: usize,
}

impl<'a, T: Real, S: Space<T>> Stencil<'a, T, S> {
    /// The points `i..i + LANES`. Slots past a point's own count hold the point itself and so add nothing to any sum.
    #[inline(always)]
    pub fn new(
        space: S,
        position: &'a [T],
        support: &[T],
        neighbours: &'a [u32],
        count: &[u32],
        capacity: usize,
        i: usize,
    ) -> Self {
        let rows = count[i..i + T::Pack::LANES].iter().copied().max().unwrap_or(0) as usize;
        Self {
            space,
            position,
            neighbours,
            own: T::Pack::load_vectors(&position[2 * i..]),
            per_support: T::Pack::splat(T::from_f64(1.0)) / T::Pack::load(&support[i..]),
            first: blocks::at(i, 0, capacity),
            rows: rows.min(capacity),
        }
    }

    /// Calls `body(indexes, scaled offset, its square)` for every slot.
    #[inline(always)]
    pub fn for_each(&self, mut body: impl FnMut(&[u32], [T::Pack; 2], T::Pack)) {
        for slot in 0..self.rows {
            let start = self.first + slot * BLOCK;
            let index = &self.neighbours[start..start + T::Pack::LANES];
            // SAFETY: every stored neighbour is below the number of points: the search puts nothing else there, and
            // `Fields::write` checks what comes from outside.
            let [x, y] = unsafe { T::Pack::gather_vectors(self.position, index) };
            let [x, y] = self.space.shortest([x - self.own[0], y - self.own[1]]).map(|d| d * self.per_support);
            body(index, [x, y], x * x + y * y);
        }
    }
}

/// Points whose normal matrix failed the pivot test step down the ladder: a wider radius, up to
/// [`Rung::WIDEST`]; then the linear fit; then the nearest value, which is no fit at all.
///
/// Returns how many points stand on each rung: widened, linear, nearest.
pub fn widen_support<T: Real, S: Space<T>>(
    search: Search<T, S>,
    capacity: usize,
    weight: impl WeightFunction,
    support: &mut [T],
    neighbours: &mut [u32],
    count: &mut [u32],
    factor: &mut [T],
    rung: &mut [u32],
) -> [u32; 3] {
    let Search { position, points, space, .. } = search;
    let mut tally = [0; 3];
    let threshold = T::from_f64(PIVOT_THRESHOLD);
    for i in (0..rung.len()).filter(|&i| rung[i] == Rung::FAILED).collect::<Vec<_>>() {
        if i >= points {
            rung[i] = 0;
            (0..FACTOR).for_each(|k| factor[blocks::at(i, k, FACTOR)] = T::zero());
            continue;
        }
        let radius = support[i];
        let offset = |j: u32, per: T| {
            let j = j as usize;
            let d = [position[2 * j] - position[2 * i], position[2 * j + 1] - position[2 * i + 1]];
            space.shortest(d.map(One)).map(|d| d.0 * per)
        };
        let fit = |found: &[u32], radius: T| {
            let per = T::from_f64(1.0) / radius;
            let mut sums = Moments::<One<T>>::zero();
            for &j in found {
                let [x, y] = offset(j, per);
                let (x, y) = (One(x), One(y));
                sums.add(x, y, weight.weight(x * x + y * y));
            }
            sums.matrix()
        };
        let mut reached = None;
        let mut found = Vec::new();
        for (step, wider) in Rung::WIDER.iter().enumerate() {
            let radius = radius * T::from_f64(*wider);
            found.clear();
            search.within(i, radius, |j| found.push(j));
            if found.len() > capacity {
                break;
            }
            let (entries, least) = moments::factorise(fit(&found, radius));
            if least.0 > threshold {
                reached = Some((step as u32 + 1, radius, entries));
                break;
            }
        }
        let (step, radius, entries) = reached.unwrap_or_else(|| {
            found.clear();
            found.extend((0..(count[i] as usize).min(capacity)).map(|slot| neighbours[blocks::at(i, slot, capacity)]));
            let mut matrix = fit(&found, radius);
            matrix[3..].fill(One(T::zero()));
            let (mut entries, _) = moments::factorise(matrix);
            let [xx, xy, yy] = [matrix[0].0, matrix[1].0, matrix[2].0];
            // The factor of a singular matrix is rubbish; its second pivot tells.
            let second = if xx > T::zero() { yy - xy * xy / xx } else { T::zero() };
            let step = if xx > T::zero() && second > threshold * yy {
                entries[3..].fill(One(T::zero()));
                Rung::LINEAR
            } else {
                entries.fill(One(T::zero()));
                Rung::NEAREST
            };
            (step, radius, entries)
        });
        support[i] = radius;
        rung[i] = step;
        tally[if step < Rung::LINEAR { 0 } else { (step - Rung::LINEAR + 1) as usize }] += 1;
        count[i] = found.len() as u32;
        for slot in 0..capacity {
            neighbours[blocks::at(i, slot, capacity)] = found.get(slot).copied().unwrap_or(i as u32);
        }
        for (k, entry) in entries.into_iter().enumerate() {
            factor[blocks::at(i, k, FACTOR)] = entry.0;
        }
    }
    tally
}
