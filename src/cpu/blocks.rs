//! Loops over blocks of points, on one core or on all, with the same bits either way.
//!
//! The bodies are called through `dyn`: a call a block costs nothing beside 32 points of work, and each operation is
//! compiled once, not once for every way to loop.

use std::ops::Range;

use rayon::prelude::*;

use crate::cpu::real::{Pack, Real};

pub use crate::step::BLOCK;

/// Below this many points a loop runs on the calling thread: waking the others costs more than it saves.
const SERIAL_BELOW: usize = 24 * 1024;
/// Blocks that one thread takes at a time, and points over which one partial sum runs.
const BLOCKS_A_TASK: usize = 32;
const CHUNK: usize = BLOCK * BLOCKS_A_TASK;

/// Number of blocks that hold `points` points.
pub fn count(points: usize) -> usize {
    points.div_ceil(BLOCK)
}

/// Points rounded up to whole blocks: the length of every per-point array.
pub fn padded(points: usize) -> usize {
    count(points) * BLOCK
}

/// Where component `slot` of `slots` stands for the first point of the pack that begins at `point`.
#[inline(always)]
pub fn at(point: usize, slot: usize, slots: usize) -> usize {
    (point / BLOCK) * BLOCK * slots + slot * BLOCK + point % BLOCK
}

/// First points of the packs of a block that hold a point below `end`.
#[inline(always)]
pub fn packs<T: Real>(block: usize, end: usize) -> impl Iterator<Item = usize> {
    (block * BLOCK..((block + 1) * BLOCK).min(end)).step_by(T::Pack::LANES)
}

/// Adds to the interleaved vectors of points `i..` in `out`, whose first vector is that of point `start`, as far as `end`.
#[inline(always)]
pub fn add_vectors<T: Real>(out: &mut [T], start: usize, i: usize, end: usize, [x, y]: [T::Pack; 2]) {
    for lane in 0..T::Pack::LANES.min(end.saturating_sub(i)) {
        out[2 * (i - start + lane)] += x.lane(lane);
        out[2 * (i - start + lane) + 1] += y.lane(lane);
    }
}

/// The same in place of what was there.
#[inline(always)]
pub fn set_vectors<T: Real>(out: &mut [T], start: usize, i: usize, end: usize, [x, y]: [T::Pack; 2]) {
    for lane in 0..T::Pack::LANES.min(end.saturating_sub(i)) {
        out[2 * (i - start + lane)] = x.lane(lane);
        out[2 * (i - start + lane) + 1] = y.lane(lane);
    }
}

/// Runs `body(block, values)` for every block of an array with `slots` entries a point.
pub fn for_each<R: Send>(out: &mut [R], slots: usize, body: &(dyn Fn(usize, &mut [R]) + Sync)) {
    let width = slots * BLOCK;
    if out.len() < SERIAL_BELOW * slots {
        out.chunks_mut(width).enumerate().for_each(|(block, values)| body(block, values));
    } else {
        out.par_chunks_mut(width)
            .with_min_len(BLOCKS_A_TASK)
            .enumerate()
            .for_each(|(block, values)| body(block, values));
    }
}

/// The same for two arrays at once.
pub fn for_each_2<R: Send, S: Send>(
    first: (&mut [R], usize),
    second: (&mut [S], usize),
    body: &(dyn Fn(usize, &mut [R], &mut [S]) + Sync),
) {
    let ((first, slots), (second, others)) = (first, second);
    if first.len() < SERIAL_BELOW * slots {
        let pairs = first.chunks_mut(slots * BLOCK).zip(second.chunks_mut(others * BLOCK));
        pairs.enumerate().for_each(|(block, (a, b))| body(block, a, b));
    } else {
        first
            .par_chunks_mut(slots * BLOCK)
            .zip(second.par_chunks_mut(others * BLOCK))
            .with_min_len(BLOCKS_A_TASK)
            .enumerate()
            .for_each(|(block, (a, b))| body(block, a, b));
    }
}

type Body3<'a, R, S, Q> = dyn Fn(usize, &mut [R], &mut [S], &mut [Q]) + Sync + 'a;

/// The same for three arrays at once.
pub fn for_each_3<R: Send, S: Send, Q: Send>(
    (first, slots): (&mut [R], usize),
    (second, others): (&mut [S], usize),
    (third, more): (&mut [Q], usize),
    body: &Body3<'_, R, S, Q>,
) {
    let serial = first.len() < SERIAL_BELOW * slots;
    if serial {
        let pairs = first.chunks_mut(slots * BLOCK).zip(second.chunks_mut(others * BLOCK));
        let triples = pairs.zip(third.chunks_mut(more * BLOCK));
        triples.enumerate().for_each(|(block, ((a, b), c))| body(block, a, b, c));
    } else {
        let pairs = first.par_chunks_mut(slots * BLOCK).zip(second.par_chunks_mut(others * BLOCK));
        let triples = pairs.zip(third.par_chunks_mut(more * BLOCK)).with_min_len(BLOCKS_A_TASK);
        triples.enumerate().for_each(|(block, ((a, b), c))| body(block, a, b, c));
    }
}

type Body4<'a, R, S> = dyn Fn(usize, &mut [R], &mut [S], &mut [S], &mut [S]) + Sync + 'a;

/// The same for four arrays at once, the last three of the same kind.
pub fn for_each_4<R: Send, S: Send>(
    (first, slots): (&mut [R], usize),
    [(second, others), (third, more), (fourth, most)]: [(&mut [S], usize); 3],
    body: &Body4<'_, R, S>,
) {
    let serial = first.len() < SERIAL_BELOW * slots;
    if serial {
        let pairs = first.chunks_mut(slots * BLOCK).zip(second.chunks_mut(others * BLOCK));
        let more = third.chunks_mut(more * BLOCK).zip(fourth.chunks_mut(most * BLOCK));
        pairs.zip(more).enumerate().for_each(|(block, ((a, b), (c, d)))| body(block, a, b, c, d));
    } else {
        let pairs = first.par_chunks_mut(slots * BLOCK).zip(second.par_chunks_mut(others * BLOCK));
        let more = third.par_chunks_mut(more * BLOCK).zip(fourth.par_chunks_mut(most * BLOCK));
        let all = pairs.zip(more).with_min_len(BLOCKS_A_TASK);
        all.enumerate().for_each(|(block, ((a, b), (c, d)))| body(block, a, b, c, d));
    }
}

/// Runs `body(first point, values)` over chunks of per-point arrays and adds up what it returns. The chunks are the
/// same on any number of threads, and their sums are added in order: same bits.
pub fn sum_over<R: Send, const N: usize, const M: usize>(
    arrays: [&mut [R]; N],
    body: &(dyn Fn(usize, [&mut [R]; N]) -> [f64; M] + Sync),
) -> [f64; M] {
    let length = arrays.first().map_or(0, |array| array.len());
    let mut rest = arrays;
    let mut tasks: Vec<(usize, [&mut [R]; N])> = Vec::with_capacity(length.div_ceil(CHUNK));
    let mut start = 0;
    while start < length {
        let width = CHUNK.min(length - start);
        let mut taken: [&mut [R]; N] = std::array::from_fn(|_| Default::default());
        for (taken, rest) in taken.iter_mut().zip(rest.iter_mut()) {
            let (head, tail) = std::mem::take(rest).split_at_mut(width);
            (*taken, *rest) = (head, tail);
        }
        tasks.push((start, taken));
        start += width;
    }
    let partial: Vec<[f64; M]> = if length < SERIAL_BELOW {
        tasks.into_iter().map(|(start, chunk)| body(start, chunk)).collect()
    } else {
        tasks.into_par_iter().map(|(start, chunk)| body(start, chunk)).collect()
    };
    partial.into_iter().fold([0.0; M], |sum, part| std::array::from_fn(|m| sum[m] + part[m]))
}

/// What `body` returns for consecutive ranges of `0..length`; the same ranges and order on any number of threads.
pub fn map_ranges<R: Send>(length: usize, body: &(dyn Fn(Range<usize>) -> R + Sync)) -> Vec<R> {
    let range = |task: usize| task * CHUNK..((task + 1) * CHUNK).min(length);
    let tasks = length.div_ceil(CHUNK);
    if length < SERIAL_BELOW {
        (0..tasks).map(|task| body(range(task))).collect()
    } else {
        (0..tasks).into_par_iter().map(|task| body(range(task))).collect()
    }
}

/// The sum of that.
pub fn sum_ranges<const M: usize>(length: usize, body: &(dyn Fn(Range<usize>) -> [f64; M] + Sync)) -> [f64; M] {
    let parts = map_ranges(length, body);
    parts.into_iter().fold([0.0; M], |sum, part| std::array::from_fn(|m| sum[m] + part[m]))
}
