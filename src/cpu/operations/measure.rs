//! Sums over the points for a row of diagnostics.

use std::ops::RangeInclusive;

use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::real::Real;
use crate::engine::Measurement;

/// Kinetic energy `sum V |u|^2 / 2`, largest speed, and largest rate of change since `reported`, which becomes `velocity`.
pub fn speeds<T: Real>(velocity: &[T], volume: &[T], reported: &mut [T], points: usize, elapsed: f64) -> Measurement {
    let length = volume.len();
    let [kinetic_energy] = blocks::sum_ranges(length, &|range| {
        let term = |i: usize| {
            let (u, v) = (velocity[2 * i].to_f64(), velocity[2 * i + 1].to_f64());
            0.5 * volume[i].to_f64() * (u * u + v * v)
        };
        [range.filter(|&i| i < points).map(term).sum()]
    });
    let now = velocity[..2 * points].as_chunks().0.iter();
    let changes = now.clone().zip(reported.as_chunks().0).map(|(&[u, v], &[a, b])| [u - a, v - b]);
    let (max_speed, change) = (longest(now.copied()), longest(changes));
    blocks::for_each(reported, 2, &|block, out| {
        let first = 2 * block * BLOCK;
        out.copy_from_slice(&velocity[first..first + out.len()]);
    });
    Measurement { kinetic_energy, max_speed, divergence: 0.0, change: change / elapsed }
}

/// Squares that are compared as they are: neither nothing nor beyond all numbers.
const SQUARES: RangeInclusive<f64> = 1e-280..=1e280;

/// Length of the longest of some vectors.
fn longest<T: Real>(vectors: impl Iterator<Item = [T; 2]> + Clone) -> f64 {
    let vectors = vectors.map(|vector| vector.map(T::to_f64));
    let square = vectors.clone().map(|[u, v]| u * u + v * v).fold(0.0, f64::max);
    match SQUARES.contains(&square) {
        true => square.sqrt(),
        false => vectors.map(|[u, v]| u.hypot(v)).fold(0.0, f64::max),
    }
}

/// Root mean square over the points of `flux / volume`.
pub fn rms_density<T: Real>(flux: &[T], volume: &[T], points: usize) -> f64 {
    let [square] =
        blocks::sum_ranges(points, &|range| [range.map(|i| (flux[i].to_f64() / volume[i].to_f64()).powi(2)).sum()]);
    (square / points as f64).sqrt()
}

/// Root mean square over the points.
pub fn rms<T: Real>(values: &[T], points: usize) -> f64 {
    let [square] = blocks::sum_ranges(points, &|range| [range.map(|i| values[i].to_f64().powi(2)).sum()]);
    (square / points as f64).sqrt()
}
