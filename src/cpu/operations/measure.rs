//! Sums over the points for a row of diagnostics.

use std::ops::{Range, RangeInclusive};

use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::real::{Pack, Real};
use crate::engine::Measurement;

/// Points that are looked at side by side, in f64 whatever the engine computes in.
type Lanes = <f64 as Real>::Pack;
const LANES: usize = <Lanes as Pack<f64>>::LANES;

/// Kinetic energy `sum V |u|^2 / 2`, largest speed, and largest rate of change since `reported`, which becomes `velocity`.
pub fn speeds<T: Real>(velocity: &[T], volume: &[T], reported: &mut [T], points: usize, elapsed: f64) -> Measurement {
    let (now, then) = (&velocity.as_chunks().0[..points], &reported.as_chunks().0[..points]);
    let part = |range: Range<usize>| sums(&now[range.clone()], &then[range.clone()], &volume[range]);
    let parts = blocks::map_ranges(points, &part);
    let twice: f64 = parts.iter().map(|[energy, ..]| energy).sum();
    let [speed, change] = [1, 2].map(|k| parts.iter().map(|part| part[k]).fold(0.0, f64::max));
    let velocities = now.iter().map(|u| u.map(T::to_f64));
    let changes = velocities.clone().zip(then).map(|([u, v], &[a, b])| [u - a.to_f64(), v - b.to_f64()]);
    let (max_speed, change) = (root(speed, velocities), root(change, changes));
    blocks::for_each(reported, 2, &|block, out| {
        let first = 2 * block * BLOCK;
        out.copy_from_slice(&velocity[first..first + out.len()]);
    });
    Measurement { kinetic_energy: 0.5 * twice, max_speed, divergence: 0.0, change: change / elapsed }
}

/// `sum V |u|^2`, the largest `|u|^2` and the largest `|u - u_then|^2`; a square that is no number is not the largest.
fn sums<T: Real>(now: &[[T; 2]], then: &[[T; 2]], volume: &[T]) -> [f64; 3] {
    let (now, rest) = now.as_chunks::<LANES>();
    let (then, rest_then) = then.as_chunks::<LANES>();
    let (volume, rest_volume) = volume.as_chunks::<LANES>();
    let mut lanes = [Lanes::zero(); 3];
    let mut add = |now: &[[T; 2]; LANES], then: &[[T; 2]; LANES], volume: &[T; LANES]| {
        let [[u, v], [a, b]] =
            [now, then].map(|vectors| [0, 1].map(|axis| Lanes::from_lanes(|lane| vectors[lane][axis].to_f64())));
        let (speed, change) = (u * u + v * v, (u - a) * (u - a) + (v - b) * (v - b));
        lanes[0] += Lanes::from_lanes(|lane| volume[lane].to_f64()) * speed;
        lanes[1] = speed.select_above(lanes[1], speed, lanes[1]);
        lanes[2] = change.select_above(lanes[2], change, lanes[2]);
    };
    now.iter().zip(then).zip(volume).for_each(|((now, then), volume)| add(now, then, volume));
    // Points that are not there have no volume and no velocity.
    let (mut ends, mut volumes) = ([[[T::zero(); 2]; LANES]; 2], [T::zero(); LANES]);
    ends[0][..rest.len()].copy_from_slice(rest);
    ends[1][..rest.len()].copy_from_slice(rest_then);
    volumes[..rest.len()].copy_from_slice(rest_volume);
    add(&ends[0], &ends[1], &volumes);
    let across = |k: usize| (0..LANES).map(move |lane| lanes[k].lane(lane));
    [across(0).sum(), across(1).fold(0.0, f64::max), across(2).fold(0.0, f64::max)]
}

/// Squares that are compared as they are: neither nothing nor beyond all numbers.
const SQUARES: RangeInclusive<f64> = 1e-280..=1e280;

/// Length of the longest of some vectors, whose square is at hand.
fn root(square: f64, vectors: impl Iterator<Item = [f64; 2]> + Clone) -> f64 {
    if SQUARES.contains(&square) {
        return square.sqrt();
    }
    let most = vectors.clone().flatten().fold(0.0, |most: f64, part| most.max(part.abs()));
    if most == 0.0 || most.is_infinite() {
        return most;
    }
    let parts = vectors.map(|vector| vector.map(|part| part / most));
    most * parts.map(|[u, v]| u * u + v * v).fold(0.0, f64::max).sqrt()
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Whatever the count, and with padding behind the points that is no part of it.
    #[test]
    fn speeds_are_those_of_every_point() {
        for points in [1, 3, 4, 31, 1025, 2050] {
            let mut velocity: Vec<f64> = (0..2 * points + 64).map(|k| (1.7 * k as f64).sin()).collect();
            velocity[2 * points..].fill(9.0);
            // The fastest, and what changes most, are the last.
            velocity[2 * points - 1] = 3.0;
            let volume: Vec<f64> = (0..points + 32).map(|k| 1.0 + (0.3 * k as f64).cos()).collect();
            let begun: Vec<f64> = (0..velocity.len()).map(|k| (0.9 * k as f64).cos()).collect();
            let mut reported = begun.clone();
            let found = speeds(&velocity, &volume, &mut reported, points, 0.5);
            let energy = |k: usize| 0.5 * volume[k] * (velocity[2 * k].powi(2) + velocity[2 * k + 1].powi(2));
            let expected: f64 = (0..points).map(energy).sum();
            assert!((found.kinetic_energy / expected - 1.0).abs() < 1e-13, "{points}: {}", found.kinetic_energy);
            let longest =
                |of: &dyn Fn(usize) -> f64| (0..points).map(|k| of(2 * k).hypot(of(2 * k + 1))).fold(0.0, f64::max);
            let (speed, change) = (longest(&|k| velocity[k]), longest(&|k| velocity[k] - begun[k]) / 0.5);
            assert!((found.max_speed / speed - 1.0).abs() < 1e-14, "{points}: {}", found.max_speed);
            assert!((found.change / change - 1.0).abs() < 1e-14, "{points}: {}", found.change);
            assert_eq!(reported, velocity);
        }
    }

    #[test]
    fn speeds_whose_squares_no_number_holds_are_found() {
        for size in [1e200, 1e-200] {
            let (velocity, mut reported) = ([0.0, 0.0, 3.0 * size, 4.0 * size], [0.0; 4]);
            let found = speeds(&velocity, &[1.0, 1.0], &mut reported, 2, 1.0);
            assert!(
                (found.max_speed / (5.0 * size) - 1.0).abs() < 1e-14 && found.change == found.max_speed,
                "{found:?}"
            );
        }
        let still = speeds(&[2.0, 0.0], &[1.0], &mut [2.0, 0.0], 1, 1.0);
        assert_eq!((still.max_speed, still.change), (2.0, 0.0));
        let found = speeds(&[0.0, f64::INFINITY], &[1.0], &mut [0.0; 2], 1, 1.0);
        assert!(found.max_speed == f64::INFINITY && found.kinetic_energy == f64::INFINITY);
        let found = speeds(&[0.0, f64::NAN], &[1.0], &mut [0.0; 2], 1, 1.0);
        assert!(found.kinetic_energy.is_nan());
    }
}
