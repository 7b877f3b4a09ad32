//! Viscosity taken of the velocity that is looked for: the middle of the kick.
//!
//! Continuous: `(u_m - b) / h = nu lap u_m`, `b` the velocity after every other force of the kick, `h` its length.
//! Discrete:   `(V_i + h nu sum_j w_ij) u_i - h nu sum_j w_ij u_j = V_i b_i` inside, the walls' velocities given; then
//! `kick += u_m - b`. The Laplacian goes through the faces of the Voronoi cells, as that of heat does: the matrix is symmetric and
//! positive definite, whatever the step. Where the kick is half a step and is done twice, this is the implicit midpoint rule,
//! where it is a whole one backward Euler.
//! Both components are one system: Jacobi-preconditioned conjugate gradients, as for the pressure. A residual counts as
//! `r_i / V_i`, an error of the velocity, m/s.
//! Source: Hestenes and Stiefel (1952); finite volumes on Voronoi cells: Eymard, Gallouet and Herbin, Handbook of Numerical
//! Analysis VII, 2000, chapter 3.
//!
//! The kick `G` of the mean pressure `P` of the last steps is in `b`, so that a steady state does not depend on the step:
//!
//! ```text
//! b   = -(rho / h) V div (u_m + theta G)                            predict, conservative.rs
//! d   = -(h / rho) (b - theta K P) / V,    b += (1 - theta) K P      add_mean_pressure
//! u   = u_m + G - (h / rho) grad p,    K p = b
//! P  += (p - P - rho nu d) / 2,    G = (h / rho) grad P              relax_pressure; derivative.rs or conservative.rs
//! ```
//!
//! In a steady state `d = 0` and `p = P`. `rho nu d` is what a long step needs to find the pressure as soon as a short one does: the
//! rotational form of incremental projection, Timmermans, Minev and van de Vosse, Int. J. Numer. Methods Fluids 22 (1996) 673-688.
//! `theta = 1 / (1 + 8 h nu / l0^2)` is ours. The gradient that corrects is not the one inside `K`: of a kick `G` the projection leaves
//! a part that grows with its length, and that holds back pressures which `grad` does not see. It is to be as large as in a step at the
//! explicit limit, whatever the step. With `theta = 1` steps of 50 times that limit give 4% of error and 35 m/s in a corner under a
//! lid that moves with 1 m/s.

use crate::cpu::blocks;
use crate::cpu::operations::conservative::{Conservative, Faces};
use crate::cpu::operations::pressure::{Monitor, Rows, Stop, Verdict, lanes, within};
use crate::cpu::real::{Pack, Real};
use crate::engine::{Outcome, SolveInfo};
use crate::step::PRESSURE_RELAXATION;

/// Most iterations of a solve. More are asked for by steps so long that the viscous time across the domain is nothing beside them.
pub const MOST_ITERATIONS: u32 = 10_000;

/// The matrix `V + h nu K`.
#[derive(Clone, Copy)]
pub struct Matrix<'a, T> {
    pub faces: Faces<'a, T>,
    /// `sum_j w_ij`
    pub face_sum: &'a [T],
    /// m^2
    pub volume: &'a [T],
    /// `1 / V_i`, 1/m^2.
    pub per_volume: &'a [T],
    /// `h nu`, m^2.
    pub diffusion: T,
    /// Points whose velocity is looked for: the first ones.
    pub interior: usize,
}

/// Vectors of the solver, interleaved.
pub struct Work<'a, T> {
    pub residual: &'a mut [T],
    pub direction: &'a mut [T],
    pub product: &'a mut [T],
}

impl<T: Real> Matrix<'_, T> {
    /// Of the points `i..i + LANES`; those on walls have none.
    #[inline(always)]
    fn product(&self, i: usize, x: &[T]) -> [T::Pack; 2] {
        let own = T::Pack::load_vectors(&x[2 * i..]);
        let mut sum = [T::Pack::zero(); 2];
        self.faces.for_each(i, |index, weight| {
            // SAFETY: every stored face neighbour is below the number of points.
            let [u, v] = unsafe { T::Pack::gather_vectors(x, index) };
            sum = [weight.mul_add(own[0] - u, sum[0]), weight.mul_add(own[1] - v, sum[1])];
        });
        let (volume, diffusion) = (T::Pack::load(&self.volume[i..]), T::Pack::splat(self.diffusion));
        [0, 1].map(|k| self.inside(i, volume * own[k] + diffusion * sum[k]))
    }

    #[inline(always)]
    fn diagonal(&self, i: usize) -> T::Pack {
        T::Pack::load(&self.volume[i..]) + T::Pack::splat(self.diffusion) * T::Pack::load(&self.face_sum[i..])
    }

    /// Zero in the lanes of walls and beyond.
    #[inline(always)]
    fn inside(&self, i: usize, value: T::Pack) -> T::Pack {
        if i >= self.interior { T::Pack::zero() } else { within::<T>(value, i, self.interior) }
    }

    /// Adds the squares of a residual and of the diagonal's product with a solution, both as velocities.
    #[inline(always)]
    fn measure(&self, i: usize, residual: [T::Pack; 2], solution: [T::Pack; 2], sums: &mut [T::Pack]) {
        let (per_volume, diagonal) = (T::Pack::load(&self.per_volume[i..]), self.diagonal(i));
        for k in 0..2 {
            let (residual, size) = (residual[k] * per_volume, self.inside(i, diagonal * solution[k] * per_volume));
            sums[0] += residual * residual;
            sums[1] += size * size;
        }
    }
}

/// Solves for `middle` from what it holds, its walls as they are; `before` is `b`. Postcondition: the recomputed residual is below
/// what `stop` asks for, or the outcome says why not.
pub fn solve<T: Real>(
    matrix: Matrix<T>,
    points: usize,
    before: &[T],
    stop: Stop,
    work: Work<T>,
    middle: &mut [T],
) -> SolveInfo {
    let Work { residual, direction, product } = work;
    let mut monitor = Monitor::new(stop, points);
    let width = 2 * T::Pack::LANES;
    let load = |values: &[T], entry: usize| T::Pack::load_vectors(&values[entry..]);
    loop {
        // r = V b - (V + h nu K) u; d = r / D.
        let [mut rz, square, scale] = blocks::sum_over([&mut *residual, &mut *direction], &|start, [r, d]| {
            let mut sums = [T::Pack::zero(); 3];
            for k in (0..r.len()).step_by(width) {
                let i = (start + k) / 2;
                let volume = T::Pack::load(&matrix.volume[i..]);
                let (source, taken) = (load(before, 2 * i), matrix.product(i, middle));
                let value = [0, 1].map(|k| matrix.inside(i, volume * source[k]) - taken[k]);
                let diagonal = matrix.diagonal(i);
                let z = value.map(|value| matrix.inside(i, value / diagonal));
                T::Pack::store_vectors(value, &mut r[k..]);
                T::Pack::store_vectors(z, &mut d[k..]);
                sums[0] += value[0] * z[0] + value[1] * z[1];
                matrix.measure(i, value, load(middle, 2 * i), &mut sums[1..]);
            }
            sums.map(|sum| lanes::<T>(sum))
        });
        if monitor.recomputed::<T>(square, scale) == Verdict::Done {
            return monitor.info;
        }
        loop {
            let [dq] = blocks::sum_over([&mut *product], &|start, [q]| {
                let mut dq = T::Pack::zero();
                for k in (0..q.len()).step_by(width) {
                    let i = (start + k) / 2;
                    let (value, own) = (matrix.product(i, direction), load(direction, 2 * i));
                    T::Pack::store_vectors(value, &mut q[k..]);
                    dq += value[0] * own[0] + value[1] * own[1];
                }
                [lanes::<T>(dq)]
            });
            if dq <= 0.0 || !dq.is_finite() {
                monitor.info.outcome = Outcome::BrokeDown;
                break;
            }
            let alpha = T::Pack::splat(T::from_f64(rz / dq));
            let arrays = [&mut *residual, &mut *middle];
            let [next, square, scale] = blocks::sum_over(arrays, &|start, [r, u]| {
                let mut sums = [T::Pack::zero(); 3];
                for k in (0..r.len()).step_by(width) {
                    let i = (start + k) / 2;
                    let (way, taken) = (load(direction, 2 * i), load(product, 2 * i));
                    let (own, left) = (load(u, k), load(r, k));
                    let solution = [0, 1].map(|c| own[c] + alpha * way[c]);
                    let value = [0, 1].map(|c| left[c] - alpha * taken[c]);
                    T::Pack::store_vectors(solution, &mut u[k..]);
                    T::Pack::store_vectors(value, &mut r[k..]);
                    let diagonal = matrix.diagonal(i);
                    sums[0] += matrix.inside(i, (value[0] * value[0] + value[1] * value[1]) / diagonal);
                    matrix.measure(i, value, solution, &mut sums[1..]);
                }
                sums.map(|sum| lanes::<T>(sum))
            });
            let beta = T::Pack::splat(T::from_f64(next / rz));
            rz = next;
            let [] = blocks::sum_over([&mut *direction], &|start, [d]| {
                for k in (0..d.len()).step_by(width) {
                    let i = (start + k) / 2;
                    let (left, own, diagonal) = (load(residual, 2 * i), load(d, k), matrix.diagonal(i));
                    let next = [0, 1].map(|c| matrix.inside(i, left[c] / diagonal) + beta * own[c]);
                    T::Pack::store_vectors(next, &mut d[k..]);
                }
                []
            });
            if monitor.iterated::<T>(square, scale) != Verdict::Continue {
                break;
            }
        }
    }
}

/// `kick += u_m - b` inside.
pub fn add_kick<T: Real>(middle: &[T], before: &[T], interior: usize, kick: &mut [T]) {
    blocks::for_each(kick, 2, &|block, out| {
        let first = 2 * block * blocks::BLOCK;
        let inside = (2 * interior).saturating_sub(first).min(out.len());
        for (k, out) in out[..inside].iter_mut().enumerate() {
            *out += middle[first + k] - before[first + k];
        }
    });
}

/// `u_m + theta G`, with the kick `G` of the mean pressure; on walls, where that is balanced, with the `kick` of the other forces.
pub fn predict<T: Real>(middle: &[T], mean: &[T], kick: &[T], share: T, interior: usize, predicted: &mut [T]) {
    blocks::for_each(predicted, 2, &|block, out| {
        let first = 2 * block * blocks::BLOCK;
        for (k, out) in out.iter_mut().enumerate() {
            let pushed = if first + k < 2 * interior { mean } else { kick };
            *out = middle[first + k] + share * pushed[first + k];
        }
    });
}

/// `d = -(h / rho) (b - theta K P) / V`, then `b += (1 - theta) K P`, with the mean pressure `P`; `scale` is `-h / rho`.
pub fn add_mean_pressure<T: Real>(
    matrix: Conservative<T>,
    mean: &[T],
    share: T,
    scale: T,
    source: &mut [T],
    dilation: &mut [T],
) {
    let (share, scale) = (T::Pack::splat(share), T::Pack::splat(scale));
    blocks::for_each_2((source, 1), (dilation, 1), &|block, source, dilation| {
        let packs = (0..blocks::BLOCK).step_by(T::Pack::LANES);
        for (first, sum) in packs.zip(matrix.products(block, mean)) {
            let (i, before) = (block * blocks::BLOCK + first, T::Pack::load(&source[first..]));
            let seen = before - share * sum;
            (scale * seen * T::Pack::load(&matrix.per_volume[i..])).store(&mut dilation[first..]);
            (seen + sum).store(&mut source[first..]);
        }
    });
}

/// `P += (p - P - rho nu d) / 2`.
pub fn relax_pressure<T: Real>(pressure: &[T], dilation: &[T], dynamic: T, mean: &mut [T]) {
    let share = T::from_f64(PRESSURE_RELAXATION);
    blocks::for_each(mean, 1, &|block, out| {
        let first = block * blocks::BLOCK;
        for (k, out) in out.iter_mut().enumerate() {
            *out += share * (pressure[first + k] - *out - dynamic * dilation[first + k]);
        }
    });
}
