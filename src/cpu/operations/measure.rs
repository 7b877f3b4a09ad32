//! Sums over the points for a row of diagnostics.

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
    let norm = |x: T, y: T| x.to_f64().hypot(y.to_f64());
    let mut most = [0.0_f64; 2];
    for i in 0..points {
        let (u, v) = (velocity[2 * i], velocity[2 * i + 1]);
        most[0] = most[0].max(norm(u, v));
        most[1] = most[1].max(norm(u - reported[2 * i], v - reported[2 * i + 1]));
    }
    blocks::for_each(reported, 2, &|block, out| {
        let first = 2 * block * BLOCK;
        out.copy_from_slice(&velocity[first..first + out.len()]);
    });
    Measurement { kinetic_energy, max_speed: most[0], divergence: 0.0, change: most[1] / elapsed }
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
