//! The normal equations of every point, factorised, and the ladder for points whose equations are too weak.

use crate::case::Weight;
use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::operations::lists::Lists;
use crate::cpu::operations::moments::{self, LARGEST_ORDER, Moments, PIVOT_THRESHOLD};
use crate::cpu::operations::neighbours::Search;
use crate::cpu::operations::space::Space;
use crate::cpu::real::{One, Pack, Real};
use crate::step::Rung;

/// Forms and factorises the normal matrix of every point.
///
/// `rung` becomes 0 where every pivot passed, else [`Rung::FAILED`]: those points are left to [`widen_support`].
pub fn factorise<T: Real, S: Space<T>, const N: usize, const F: usize, const M: usize>(
    space: S,
    position: &[T],
    support: &[T],
    lists: Lists,
    weight: Weight,
    factor: &mut [T],
    rung: &mut [u32],
) {
    blocks::for_each_2((factor, F), (rung, 1), &|block, factor, rung| {
        for first in (0..BLOCK).step_by(T::Pack::LANES) {
            let stencil = Stencil::new(space, position, support, lists, block * BLOCK + first);
            let mut sums = Moments::<T::Pack, M>::zero();
            stencil.for_each(|_, _, [x, y], square| sums.add(x, y, moments::weight(weight, square)));
            let (entries, pivots): (_, [T::Pack; N]) = moments::factorise(sums.matrix::<F>());
            for (k, entry) in entries.into_iter().enumerate() {
                entry.store(&mut factor[k * BLOCK + first..]);
            }
            let passed = moments::least(&pivots).above(T::Pack::splat(T::from_f64(PIVOT_THRESHOLD)));
            for lane in 0..T::Pack::LANES {
                rung[first + lane] = if passed >> lane & 1 != 0 { 0 } else { Rung::FAILED };
            }
        }
    });
}

/// A pack of points with their neighbours, in scaled coordinates.
pub struct Stencil<'a, T: Real, S> {
    space: S,
    position: &'a [T],
    lists: Lists<'a>,
    i: usize,
    own: [T::Pack; 2],
    /// `1 / r_e` of each point.
    pub per_support: T::Pack,
}

impl<'a, T: Real, S: Space<T>> Stencil<'a, T, S> {
    /// The points `i..i + LANES`. Slots past a point's own count hold the point itself and so add nothing to any sum.
    #[inline(always)]
    pub fn new(space: S, position: &'a [T], support: &[T], lists: Lists<'a>, i: usize) -> Self {
        let own = T::Pack::load_vectors(&position[2 * i..]);
        let per_support = T::Pack::splat(T::from_f64(1.0)) / T::Pack::load(&support[i..]);
        Self { space, position, lists, i, own, per_support }
    }

    /// Calls `body(slot, indexes, scaled offset, its square)` for every slot.
    #[inline(always)]
    pub fn for_each(&self, mut body: impl FnMut(usize, &[u32], [T::Pack; 2], T::Pack)) {
        self.lists.for_each::<T>(self.i, |slot, index| {
            // SAFETY: every stored neighbour is below the number of points: the search puts nothing else there, and
            // `Fields::write` checks what comes from outside.
            let [x, y] = unsafe { T::Pack::gather_vectors(self.position, index) };
            let [x, y] = self.space.shortest([x - self.own[0], y - self.own[1]]).map(|d| d * self.per_support);
            body(slot, index, [x, y], x * x + y * y);
        });
    }
}

/// Points whose normal matrix failed the pivot test step down the ladder: a wider radius, up to the last of
/// [`Rung::WIDER`]; then fits of lower orders, down to the linear one; then the nearest value, which is no fit at all.
pub fn widen_support<T: Real, S: Space<T>, const N: usize, const F: usize, const M: usize>(
    search: Search<T, S>,
    capacity: usize,
    weight: Weight,
    support: &mut [T],
    neighbours: &mut [u32],
    count: &mut [u32],
    factor: &mut [T],
    rung: &mut [u32],
) {
    let Search { position, points, space, .. } = search;
    for i in (0..rung.len()).filter(|&i| rung[i] == Rung::FAILED).collect::<Vec<_>>() {
        if i >= points {
            rung[i] = 0;
            (0..F).for_each(|k| factor[blocks::at(i, k, F)] = T::zero());
            continue;
        }
        let offset = |j: u32, per: T| {
            let j = j as usize;
            let d = [position[2 * j] - position[2 * i], position[2 * j + 1] - position[2 * i + 1]];
            space.shortest(d.map(One)).map(|d| d.0 * per)
        };
        let fit = |found: &[u32], radius: T| -> ([One<T>; F], [One<T>; N]) {
            let per = T::from_f64(1.0) / radius;
            let mut sums = Moments::<One<T>, M>::zero();
            for &j in found {
                let [x, y] = offset(j, per).map(One);
                sums.add(x, y, moments::weight(weight, x * x + y * y));
            }
            moments::factorise(sums.matrix())
        };
        let passed = |pivots: &[One<T>]| moments::least(pivots).0 > T::from_f64(PIVOT_THRESHOLD);
        let mut reached = None;
        let mut found = Vec::new();
        for (step, wider) in Rung::WIDER.iter().enumerate() {
            let radius = support[i] * T::from_f64(*wider);
            found.clear();
            search.within(i, radius, |j| found.push(j));
            if found.len() > capacity {
                break;
            }
            let (entries, pivots) = fit(&found, radius);
            if passed(&pivots) {
                reached = Some((step as u32 + 1, radius, entries));
                break;
            }
        }
        let (step, radius, entries) = reached.unwrap_or_else(|| {
            found.clear();
            search.within(i, support[i], |j| found.push(j));
            found.truncate(capacity);
            let (mut entries, pivots) = fit(&found, support[i]);
            let lower = (1..=LARGEST_ORDER).rev().map(|order| (order, moments::coefficients(order)));
            let carried = lower.into_iter().find(|&(_, kept)| kept < N && passed(&pivots[..kept]));
            let (step, kept) = carried.map_or((Rung::NEAREST, 0), |(order, kept)| (Rung::lowered(order as u32), kept));
            entries[moments::entries(kept)..].fill(One(T::zero()));
            (step, support[i], entries)
        });
        support[i] = radius;
        rung[i] = step;
        count[i] = found.len() as u32;
        for slot in 0..capacity {
            neighbours[blocks::at(i, slot, capacity)] = found.get(slot).copied().unwrap_or(i as u32);
        }
        for (k, entry) in entries.into_iter().enumerate() {
            factor[blocks::at(i, k, F)] = entry.0;
        }
    }
}
