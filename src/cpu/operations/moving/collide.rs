//! The collision guard of MPS: two points that are too close and still approach bounce.
//!
//! Discrete: of the velocity with which they approach, each takes off `(1 + restitution) / 2`, all of it `(1 + restitution)`
//! beside a wall; places change by the same over the step. Momentum is kept between points of the fluid. Units: m/s, m.
//! Source: Koshizuka, Nobe and Oka, Int. J. Numer. Meth. Fluids 26 (1998) 751-769.

use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::operations::lists::Lists;
use crate::cpu::real::{Pack, Real};

/// Distance below which points bounce, in spacings: of MPS, and of shifted points, which stand more evenly.
pub const DISTANCE: f64 = 0.5;
pub const SHIFTED_DISTANCE: f64 = 0.8;
/// Part of the approach that comes back.
pub const RESTITUTION: f64 = 0.2;

/// The changes of velocity below `interior`, into `change`.
pub fn impulses<T: Real>(position: &[T], velocity: &[T], lists: Lists, distance: T, interior: usize, change: &mut [T]) {
    let whole = T::from_f64(1.0 + RESTITUTION);
    let half = T::from_f64(0.5) * whole;
    let bound = T::Pack::splat(distance * distance);
    blocks::for_each(change, 2, &|block, out| {
        out.fill(T::zero());
        let all = blocks::packs::<T>(block, interior).flat_map(|first| {
            let close = close_ones(position, lists, bound, first);
            (0..T::Pack::LANES).filter(move |lane| close >> lane & 1 != 0).map(move |lane| first + lane)
        });
        for i in all.filter(|&i| i < interior) {
            let mut sum = [T::zero(); 2];
            for slot in 0..(lists.count[i] as usize).min(lists.capacity) {
                let j = lists.neighbours[blocks::at(i, slot, lists.capacity)] as usize;
                let d = [0, 1].map(|axis| position[2 * j + axis] - position[2 * i + axis]);
                let square = d[0] * d[0] + d[1] * d[1];
                if square < distance * distance && square > T::zero() {
                    let approach =
                        d[0] * (velocity[2 * i] - velocity[2 * j]) + d[1] * (velocity[2 * i + 1] - velocity[2 * j + 1]);
                    if approach > T::zero() {
                        let share = if j < interior { half } else { whole } * approach / square;
                        sum = [sum[0] - share * d[0], sum[1] - share * d[1]];
                    }
                }
            }
            let lane = 2 * (i - block * BLOCK);
            out[lane..lane + 2].copy_from_slice(&sum);
        }
    });
}

/// Which of the points `i..i + LANES` have a neighbour nearer than the root of `bound`, a bit each.
#[inline(always)]
fn close_ones<T: Real>(position: &[T], lists: Lists, bound: T::Pack, i: usize) -> u32 {
    let [x, y] = T::Pack::load_vectors(&position[2 * i..]);
    let mut least = bound;
    lists.for_each::<T>(i, |_, index| {
        // SAFETY: every stored neighbour is below the number of points.
        let there = unsafe { T::Pack::gather_vectors(position, index) };
        let (dx, dy) = (there[0] - x, there[1] - y);
        let square = dx * dx + dy * dy;
        // Unused slots hold the point itself.
        least = least.min(square.select_above(T::Pack::zero(), square, bound));
    });
    bound.above(least)
}

/// Adds them to the velocity, and `dt` times them to the places.
pub fn bounce<T: Real>(change: &[T], dt: T, interior: usize, position: &mut [T], velocity: &mut [T]) {
    blocks::for_each_2((position, 2), (velocity, 2), &|block, position, velocity| {
        let first = 2 * block * BLOCK;
        for k in 0..(2 * BLOCK).min((2 * interior).saturating_sub(first)) {
            velocity[k] += change[first + k];
            position[k] += dt * change[first + k];
        }
    });
}
