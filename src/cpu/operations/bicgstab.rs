//! BiCGStab for a pressure matrix of either form, singular ones too, preconditioned by the diagonal and, of points that move, a
//! coarse pressure.
//!
//! Solves `(A + c v 1^T / N) p = b`, `v` 1 in the rows that are shifted and 0 in the others: a Lagrange multiplier on the mean
//! pressure, which makes the system regular unless the left null vector is at right angles to `v`. Source: van der Vorst (1992);
//! preconditioned as in Saad, Iterative Methods for Sparse Linear Systems (2003), section 7.4.2.

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
    pub shadow: &'a mut [T],
    pub stabilised: &'a mut [T],
    pub stabilised_product: &'a mut [T],
    /// The vector that a product is taken of, preconditioned.
    pub preconditioned: &'a mut [T],
}

/// The rank-one shift of a singular matrix.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shift {
    /// `c`: as large as the matrix's diagonal, and of its sign; 0 where the matrix is regular.
    pub factor: f64,
    /// Rows that are shifted, the first ones.
    pub rows: usize,
}

impl Shift {
    /// What it adds to a row that is shifted, of a vector with that sum.
    fn of<T: Real>(self, sum: f64, points: usize) -> T::Pack {
        T::Pack::splat(T::from_f64(self.factor / points as f64 * sum))
    }
}

/// Solves from the `pressure` at hand. Postcondition as for conjugate gradients.
pub fn solve<T: Real, C: Correction<T>>(
    matrix: &impl Rows<T>,
    coarse: &mut C,
    diagonal: &[T],
    points: usize,
    shift: Shift,
    source: &[T],
    stop: Stop,
    work: Work<T>,
    pressure: &mut [T],
) -> SolveInfo {
    let Work { residual, direction, product, shadow, stabilised, stabilised_product, preconditioned: scaled } = work;
    let mut monitor = Monitor::new(stop, points);
    let load = |values: &[T], i: usize| T::Pack::load(&values[i..]);
    loop {
        let constant = shift.of::<T>(total(pressure), points);
        let [square, scale, mut rho] = blocks::sum_over([&mut *residual, &mut *shadow], &|start, [r, s]| {
            let mut sums = [T::Pack::zero(); 3];
            matrix.multiply(start..start + r.len(), pressure, |i, product| {
                let value = load(source, i) - product - within::<T>(constant, i, shift.rows);
                let value = within::<T>(value, i, points);
                value.store(&mut r[i - start..]);
                value.store(&mut s[i - start..]);
                matrix.measure(i, value, load(diagonal, i) * load(pressure, i), &mut sums[..2]);
                sums[2] += value * value;
            });
            sums.map(|sum| lanes::<T>(sum))
        });
        if monitor.recomputed::<T>(square, scale) == Verdict::Done {
            return monitor.info;
        }
        direction.copy_from_slice(residual);
        loop {
            // product = (A + shift) M^-1 direction.
            shifted_product(matrix, coarse, diagonal, points, shift, direction, scaled, product);
            let [sv] = dots([(shadow, product)]);
            if sv == 0.0 || rho == 0.0 || !sv.is_finite() {
                monitor.info.outcome = Outcome::BrokeDown;
                break;
            }
            let alpha = T::Pack::splat(T::from_f64(rho / sv));
            // The first half of the iteration: p += alpha M^-1 d.
            let [] = blocks::sum_over([&mut *stabilised, &mut *pressure], &|start, [s, p]| {
                for k in (0..s.len()).step_by(T::Pack::LANES) {
                    let i = start + k;
                    (load(residual, i) - alpha * load(product, i)).store(&mut s[k..]);
                    (load(p, k) + alpha * load(scaled, i)).store(&mut p[k..]);
                }
                []
            });
            shifted_product(matrix, coarse, diagonal, points, shift, stabilised, scaled, stabilised_product);
            let [ts, tt] = dots([(stabilised_product, stabilised), (stabilised_product, stabilised_product)]);
            // A zero here means that the first half of the iteration has already arrived.
            let omega = T::from_f64(if tt > 0.0 { ts / tt } else { 0.0 });
            let omega_pack = T::Pack::splat(omega);
            let [square, scale, next] = blocks::sum_over([&mut *residual, &mut *pressure], &|start, [r, p]| {
                let mut sums = [T::Pack::zero(); 3];
                for k in (0..r.len()).step_by(T::Pack::LANES) {
                    let i = start + k;
                    let diagonal = load(diagonal, i);
                    let solution = load(p, k) + omega_pack * load(scaled, i);
                    let value = load(stabilised, i) - omega_pack * load(stabilised_product, i);
                    solution.store(&mut p[k..]);
                    value.store(&mut r[k..]);
                    matrix.measure(i, value, diagonal * solution, &mut sums[..2]);
                    sums[2] += load(shadow, i) * value;
                }
                sums.map(|sum| lanes::<T>(sum))
            });
            let verdict = monitor.iterated::<T>(square, scale);
            if verdict != Verdict::Continue {
                break;
            }
            if omega == T::zero() || next == 0.0 {
                // Begin again from the residual at hand, with a new shadow.
                break;
            }
            let beta = T::Pack::splat(T::from_f64(next / rho * (rho / sv) / omega.to_f64()));
            rho = next;
            let [] = blocks::sum_over([&mut *direction], &|start, [d]| {
                for k in (0..d.len()).step_by(T::Pack::LANES) {
                    let i = start + k;
                    let kept = load(d, k) - omega_pack * load(product, i);
                    (load(residual, i) + beta * kept).store(&mut d[k..]);
                }
                []
            });
        }
    }
}

/// `scaled = M^-1 x`, `out = (A + c v 1^T / N) M^-1 x`.
fn shifted_product<T: Real, C: Correction<T>>(
    matrix: &impl Rows<T>,
    coarse: &mut C,
    diagonal: &[T],
    points: usize,
    shift: Shift,
    x: &[T],
    scaled: &mut [T],
    out: &mut [T],
) {
    if C::PRESENT {
        coarse.correct(x);
    }
    let coarse = &*coarse;
    let load = |values: &[T], i: usize| T::Pack::load(&values[i..]);
    let [sum] = blocks::sum_over([&mut *scaled], &|start, [z]| {
        let mut sum = T::Pack::zero();
        for k in (0..z.len()).step_by(T::Pack::LANES) {
            let i = start + k;
            let mut value = load(x, i) / load(diagonal, i);
            if C::PRESENT {
                value += coarse.at(i);
            }
            value.store(&mut z[k..]);
            sum += value;
        }
        [lanes::<T>(sum)]
    });
    let constant = shift.of::<T>(sum, points);
    let [] = blocks::sum_over([out], &|start, [q]| {
        matrix.multiply(start..start + q.len(), scaled, |i, product| {
            within::<T>(product + within::<T>(constant, i, shift.rows), i, points).store(&mut q[i - start..]);
        });
        []
    });
}

fn dots<T: Real, const M: usize>(pairs: [(&[T], &[T]); M]) -> [f64; M] {
    let length = pairs.first().map_or(0, |(a, _)| a.len());
    blocks::sum_ranges(length, &|range| {
        let mut sums = [T::Pack::zero(); M];
        for i in range.step_by(T::Pack::LANES) {
            for (sum, (a, b)) in sums.iter_mut().zip(&pairs) {
                *sum += T::Pack::load(&a[i..]) * T::Pack::load(&b[i..]);
            }
        }
        sums.map(|sum| lanes::<T>(sum))
    })
}

fn total<T: Real>(values: &[T]) -> f64 {
    let [sum] = blocks::sum_ranges(values.len(), &|range| {
        let mut sum = T::Pack::zero();
        for i in range.step_by(T::Pack::LANES) {
            sum += T::Pack::load(&values[i..]);
        }
        [lanes::<T>(sum)]
    });
    sum
}
