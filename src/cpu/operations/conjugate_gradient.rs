//! Jacobi-preconditioned conjugate gradients for the symmetric pressure matrix.
//!
//! `K` is singular: its null space is the constants, and the right side sums to zero but for rounding, which is taken
//! out. The solve works on the correction to the pressure at hand, so that in f32 only differences are rounded.
//! Source: Hestenes & Stiefel (1952); preconditioned as in Saad, Iterative Methods for Sparse Linear Systems (2003), alg. 9.1.

use crate::cpu::blocks;
use crate::cpu::operations::conservative::Faces;
use crate::cpu::real::{Pack, Real};

/// When an iterative solve stops.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stop {
    /// Root mean square of the residual per volume, `r_i / V_i`, at which the solve is done.
    pub residual: f64,
    pub max_iterations: u32,
}

/// What an iterative solve did.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SolveInfo {
    pub iterations: u32,
    /// Root mean square of `r_i / V_i` before the first iteration.
    pub first_residual: f64,
    /// The same at the end, recomputed from the solution.
    pub last_residual: f64,
    pub outcome: Outcome,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Outcome {
    #[default]
    Converged,
    /// The residual stopped falling above what was asked for.
    Stagnated,
    /// A quantity that must be positive was not, or not finite.
    BrokeDown,
}

/// Vectors of the solver, one entry a point each.
#[derive(Debug, Clone, Default)]
pub struct Work<T> {
    pub residual: Vec<T>,
    pub direction: Vec<T>,
    pub product: Vec<T>,
}

pub fn solve<T: Real>(
    faces: Faces<T>,
    diagonal: &[T],
    volume: &[T],
    points: usize,
    source: &[T],
    stop: Stop,
    work: &mut Work<T>,
    pressure: &mut [T],
) -> SolveInfo {
    let length = source.len();
    for vector in [&mut work.residual, &mut work.direction, &mut work.product] {
        vector.resize(length, T::zero());
    }
    let mut info = SolveInfo::default();
    // r = b - K p, its mean taken out.
    let [sum] = blocks::sum_over([&mut work.residual[..]], |start, [r]| {
        let mut sum = T::Pack::zero();
        for k in (0..r.len()).step_by(T::Pack::LANES) {
            let i = start + k;
            let value = T::Pack::load(&source[i..]) - faces.product(i, pressure);
            value.store(&mut r[k..]);
            sum += value;
        }
        [lanes::<T>(sum)]
    });
    let mean = T::from_f64(sum / points as f64);
    let [mut rz, mut square] = {
        let Work { residual, direction, .. } = work;
        blocks::sum_over([&mut residual[..], &mut direction[..]], |start, [r, d]| {
            let (mut rz, mut square) = (T::Pack::zero(), T::Pack::zero());
            for k in (0..r.len()).step_by(T::Pack::LANES) {
                let i = start + k;
                let mut value = T::Pack::load(&r[k..]) - T::Pack::splat(mean);
                if i + T::Pack::LANES > points {
                    value = T::Pack::from_lanes(|lane| if i + lane < points { value.lane(lane) } else { T::zero() });
                }
                let z = value / T::Pack::load(&diagonal[i..]);
                value.store(&mut r[k..]);
                z.store(&mut d[k..]);
                rz += value * z;
                let per_volume = value / T::Pack::load(&volume[i..]);
                square += per_volume * per_volume;
            }
            [lanes::<T>(rz), lanes::<T>(square)]
        })
    };
    let rms = |square: f64| (square / points as f64).sqrt();
    info.first_residual = rms(square);
    info.last_residual = info.first_residual;
    let mut best = info.first_residual;
    let mut since_best = 0;
    while rms(square) > stop.residual && info.iterations < stop.max_iterations {
        let Work { residual, direction, product } = work;
        let [dq] = blocks::sum_over([&mut product[..]], |start, [q]| {
            let mut dq = T::Pack::zero();
            for k in (0..q.len()).step_by(T::Pack::LANES) {
                let value = faces.product(start + k, direction);
                value.store(&mut q[k..]);
                dq += value * T::Pack::load(&direction[start + k..]);
            }
            [lanes::<T>(dq)]
        });
        if !(dq > 0.0) {
            info.outcome = Outcome::BrokeDown;
            break;
        }
        let alpha = T::Pack::splat(T::from_f64(rz / dq));
        let [next_rz, next_square] = blocks::sum_over([&mut residual[..], &mut pressure[..]], |start, [r, p]| {
            let (mut rz, mut square) = (T::Pack::zero(), T::Pack::zero());
            for k in (0..r.len()).step_by(T::Pack::LANES) {
                let i = start + k;
                (T::Pack::load(&p[k..]) + alpha * T::Pack::load(&direction[i..])).store(&mut p[k..]);
                let value = T::Pack::load(&r[k..]) - alpha * T::Pack::load(&product[i..]);
                value.store(&mut r[k..]);
                let z = value / T::Pack::load(&diagonal[i..]);
                rz += value * z;
                let per_volume = value / T::Pack::load(&volume[i..]);
                square += per_volume * per_volume;
            }
            [lanes::<T>(rz), lanes::<T>(square)]
        });
        let beta = T::Pack::splat(T::from_f64(next_rz / rz));
        (rz, square) = (next_rz, next_square);
        let [] = blocks::sum_over([&mut direction[..]], |start, [d]| {
            for k in (0..d.len()).step_by(T::Pack::LANES) {
                let i = start + k;
                let z = T::Pack::load(&residual[i..]) / T::Pack::load(&diagonal[i..]);
                (z + beta * T::Pack::load(&d[k..])).store(&mut d[k..]);
            }
            []
        });
        info.iterations += 1;
        let now = rms(square);
        if now < 0.9 * best {
            (best, since_best) = (now, 0);
        } else {
            since_best += 1;
        }
        if !now.is_finite() {
            info.outcome = Outcome::BrokeDown;
            break;
        }
        if since_best > 200 {
            info.outcome = Outcome::Stagnated;
            break;
        }
    }
    info.last_residual = rms(square);
    info
}

fn lanes<T: Real>(pack: T::Pack) -> f64 {
    (0..T::Pack::LANES).map(|lane| pack.lane(lane).to_f64()).sum()
}
