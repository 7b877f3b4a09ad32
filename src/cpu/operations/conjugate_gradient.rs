//! Conjugate gradients for the symmetric pressure equations, preconditioned by the diagonal and, where there is one, a coarse
//! pressure.
//!
//! `K` is symmetric and, where no pressure is prescribed, singular: its null space is the constants, and the right side sums to zero
//! but for rounding, which is taken out. Residuals are recomputed from the solution before they are believed.
//! Source: Hestenes and Stiefel (1952); preconditioned as in Saad, Iterative Methods for Sparse Linear Systems (2003),
//! algorithm 9.1.

use crate::cpu::blocks;
use crate::cpu::operations::coarse::Correction;
use crate::cpu::operations::pressure::{Monitor, Rows, Stop, Verdict, lanes, within};
use crate::cpu::real::{Pack, Real};
use crate::engine::{Outcome, SolveInfo};

/// Vectors of the solver, one entry a point each.
pub struct Work<'a, T> {
    pub residual: &'a mut [T],
    pub direction: &'a mut [T],
    pub product: &'a mut [T],
}

/// Solves `K p = b` from the `pressure` at hand. Postcondition: the recomputed residual is below what `stop` asks for,
/// or the outcome says why not.
pub fn solve<T: Real, C: Correction<T>>(
    matrix: &impl Rows<T>,
    coarse: &mut C,
    diagonal: &[T],
    points: usize,
    source: &[T],
    stop: Stop,
    work: Work<T>,
    pressure: &mut [T],
) -> SolveInfo {
    let Work { residual, direction, product } = work;
    let mut monitor = Monitor::new(stop, points);
    loop {
        // r = b - K p, its mean taken out; d = r / D.
        let [sum] = blocks::sum_over([&mut residual[..]], &|start, [r]| {
            let mut sum = T::Pack::zero();
            matrix.multiply(start..start + r.len(), pressure, |i, product| {
                let value = T::Pack::load(&source[i..]) - product;
                value.store(&mut r[i - start..]);
                sum += value;
            });
            [lanes::<T>(sum)]
        });
        let mean = T::Pack::splat(T::from_f64(if stop.singular { sum / points as f64 } else { 0.0 }));
        let [mut rz, square, scale] = blocks::sum_over([&mut *residual, &mut *direction], &|start, [r, d]| {
            let mut sums = [T::Pack::zero(); 3];
            for k in (0..r.len()).step_by(T::Pack::LANES) {
                let i = start + k;
                let value = within::<T>(T::Pack::load(&r[k..]) - mean, i, points);
                let z = value / T::Pack::load(&diagonal[i..]);
                value.store(&mut r[k..]);
                z.store(&mut d[k..]);
                sums[0] += value * z;
                matrix.measure(i, value, T::Pack::load(&diagonal[i..]) * T::Pack::load(&pressure[i..]), &mut sums[1..]);
            }
            sums.map(|sum| lanes::<T>(sum))
        });
        if monitor.recomputed::<T>(square, scale) == Verdict::Done {
            return monitor.info;
        }
        if C::PRESENT {
            rz += coarse.correct(residual);
            let coarse = &*coarse;
            let [] = blocks::sum_over([&mut *direction], &|start, [d]| {
                for k in (0..d.len()).step_by(T::Pack::LANES) {
                    (T::Pack::load(&d[k..]) + coarse.at(start + k)).store(&mut d[k..]);
                }
                []
            });
        }
        loop {
            let [dq] = blocks::sum_over([&mut *product], &|start, [q]| {
                let mut dq = T::Pack::zero();
                matrix.multiply(start..start + q.len(), direction, |i, value| {
                    value.store(&mut q[i - start..]);
                    dq += value * T::Pack::load(&direction[i..]);
                });
                [lanes::<T>(dq)]
            });
            if dq <= 0.0 || !dq.is_finite() {
                monitor.info.outcome = Outcome::BrokeDown;
                break;
            }
            let alpha = T::Pack::splat(T::from_f64(rz / dq));
            // The product is spent: its place takes z = r / D.
            let arrays = [&mut *residual, &mut *pressure, &mut *product];
            let [mut next, square, scale] = blocks::sum_over(arrays, &|start, [r, p, q]| {
                let mut sums = [T::Pack::zero(); 3];
                for k in (0..r.len()).step_by(T::Pack::LANES) {
                    let i = start + k;
                    let solution = T::Pack::load(&p[k..]) + alpha * T::Pack::load(&direction[i..]);
                    let value = T::Pack::load(&r[k..]) - alpha * T::Pack::load(&q[k..]);
                    let diagonal = T::Pack::load(&diagonal[i..]);
                    let z = value / diagonal;
                    solution.store(&mut p[k..]);
                    value.store(&mut r[k..]);
                    z.store(&mut q[k..]);
                    sums[0] += value * z;
                    matrix.measure(i, value, diagonal * solution, &mut sums[1..]);
                }
                sums.map(|sum| lanes::<T>(sum))
            });
            if C::PRESENT {
                next += coarse.correct(residual);
            }
            let beta = T::Pack::splat(T::from_f64(next / rz));
            rz = next;
            let correction = &*coarse;
            let [] = blocks::sum_over([&mut *direction], &|start, [d]| {
                for k in (0..d.len()).step_by(T::Pack::LANES) {
                    let mut z = T::Pack::load(&product[start + k..]);
                    if C::PRESENT {
                        z += correction.at(start + k);
                    }
                    (z + beta * T::Pack::load(&d[k..])).store(&mut d[k..]);
                }
                []
            });
            if monitor.iterated::<T>(square, scale) != Verdict::Continue {
                break;
            }
        }
    }
}
