//! Local least squares: the 5x5 normal equations of one pack of points.
//!
//! Continuous: `phi(x) ~ phi_i + grad phi . d + (1/2) d . H d`.
//! Discrete:   `phi_j - phi_i = a1 x + a2 y + a3 x^2 + a4 xy + a5 y^2` in the least-squares sense over the neighbours,
//! with `(x, y) = d / r_e` and weight `w(r)`: the paper's (2.5), its derivatives (2.6).
//! Shapes: 15 factor entries a point, row by row below the diagonal: l00, l10, l11, l20, ... l44; the diagonal holds
//! reciprocals. A coefficient left out has zeros in its row, so that it comes out as zero.

use crate::cpu::real::{Pack, Real};

/// Coefficients of the full fit.
pub const COEFFICIENTS: usize = 5;
/// Entries of the factor of its normal matrix.
pub const FACTOR: usize = 15;
/// Least pivot of the factorisation, relative to the diagonal entry it came from.
pub const PIVOT_THRESHOLD: f64 = 1e-5;

/// Weight of a neighbour at scaled distance `q = r / r_e`.
pub trait WeightFunction: Copy + Send + Sync {
    fn weight<T: Real, P: Pack<T>>(self, scaled_square: P) -> P;
}

/// 1.
#[derive(Clone, Copy)]
pub struct NoWeight;

/// `(1 - q)^2`.
#[derive(Clone, Copy)]
pub struct QuadraticWeight;

/// `(1 - q^2)^4`.
#[derive(Clone, Copy)]
pub struct SmoothWeight;

impl WeightFunction for NoWeight {
    #[inline(always)]
    fn weight<T: Real, P: Pack<T>>(self, _: P) -> P {
        P::splat(T::from_f64(1.0))
    }
}

impl WeightFunction for QuadraticWeight {
    #[inline(always)]
    fn weight<T: Real, P: Pack<T>>(self, scaled_square: P) -> P {
        let rest = (P::splat(T::from_f64(1.0)) - scaled_square.sqrt()).max(P::zero());
        rest * rest
    }
}

impl WeightFunction for SmoothWeight {
    #[inline(always)]
    fn weight<T: Real, P: Pack<T>>(self, scaled_square: P) -> P {
        let rest = (P::splat(T::from_f64(1.0)) - scaled_square).max(P::zero());
        let square = rest * rest;
        square * square
    }
}

/// Calls `$body` with `$weight` bound to the weight function that `$which` names.
#[macro_export]
#[doc(hidden)]
macro_rules! with_weight {
    ($which:expr, $weight:ident => $body:expr) => {
        match $which {
            $crate::case::Weight::None => {
                let $weight = $crate::cpu::operations::moments::NoWeight;
                $body
            }
            $crate::case::Weight::Quadratic => {
                let $weight = $crate::cpu::operations::moments::QuadraticWeight;
                $body
            }
            $crate::case::Weight::Smooth => {
                let $weight = $crate::cpu::operations::moments::SmoothWeight;
                $body
            }
        }
    };
}

/// `(x, y, x^2, xy, y^2)`.
#[inline(always)]
pub fn basis<T: Real, P: Pack<T>>(x: P, y: P) -> [P; COEFFICIENTS] {
    [x, y, x * x, x * y, y * y]
}

/// The twelve sums `sum w x^a y^b`, `2 <= a + b <= 4`, that make up the normal matrix.
pub struct Moments<P> {
    second: [P; 3],
    third: [P; 4],
    fourth: [P; 5],
}

impl<P: Copy> Moments<P> {
    #[inline(always)]
    pub fn zero<T: Real>() -> Self
    where
        P: Pack<T>,
    {
        Self { second: [P::zero(); 3], third: [P::zero(); 4], fourth: [P::zero(); 5] }
    }

    /// Adds one neighbour at scaled offset `(x, y)`.
    #[inline(always)]
    pub fn add<T: Real>(&mut self, x: P, y: P, weight: P)
    where
        P: Pack<T>,
    {
        let [xx, xy, yy] = [x * x, x * y, y * y];
        let [wx, wy] = [weight * x, weight * y];
        let [wxx, wxy, wyy] = [wx * x, wx * y, wy * y];
        let third = [(wxx, x), (wxx, y), (wyy, x), (wyy, y)];
        let fourth = [(wxx, xx), (wxx, xy), (wxx, yy), (wyy, xy), (wyy, yy)];
        for (k, term) in [wxx, wxy, wyy].into_iter().enumerate() {
            self.second[k] += term;
        }
        for (k, (a, b)) in third.into_iter().enumerate() {
            self.third[k] = a.mul_add(b, self.third[k]);
        }
        for (k, (a, b)) in fourth.into_iter().enumerate() {
            self.fourth[k] = a.mul_add(b, self.fourth[k]);
        }
    }

    /// Lower triangle of the normal matrix, row by row.
    #[inline(always)]
    pub fn matrix(&self) -> [P; FACTOR] {
        let ([a, b, c], [d, e, f, g], [h, i, j, k, l]) = (self.second, self.third, self.fourth);
        [a, b, c, d, e, h, e, f, i, j, f, g, j, k, l]
    }
}

/// Cholesky factor with reciprocal diagonal, and the least relative pivot met.
#[inline(always)]
pub fn factorise<T: Real, P: Pack<T>>(matrix: [P; FACTOR]) -> ([P; FACTOR], P) {
    let tiny = P::splat(T::from_f64(1e-30));
    let one = P::splat(T::from_f64(1.0));
    let mut factor = matrix;
    let mut least = one;
    for row in 0..COEFFICIENTS {
        let start = row * (row + 1) / 2;
        for column in 0..=row {
            let other = column * (column + 1) / 2;
            let mut entry = factor[start + column];
            for k in 0..column {
                entry -= factor[start + k] * factor[other + k];
            }
            if column < row {
                factor[start + column] = entry * factor[other + column];
            } else {
                let relative = entry / matrix[start + row].max(tiny);
                least = least - (least - relative).max(P::zero());
                factor[start + column] = one / entry.max(tiny).sqrt();
            }
        }
    }
    (factor, least)
}

/// Solves the normal equations for one right side.
#[inline(always)]
pub fn solve<T: Real, P: Pack<T>>(factor: &[P; FACTOR], right: [P; COEFFICIENTS]) -> [P; COEFFICIENTS] {
    let mut a = right;
    for row in 0..COEFFICIENTS {
        let start = row * (row + 1) / 2;
        for k in 0..row {
            a[row] -= factor[start + k] * a[k];
        }
        a[row] = a[row] * factor[start + row];
    }
    for row in (0..COEFFICIENTS).rev() {
        for k in row + 1..COEFFICIENTS {
            a[row] -= factor[k * (k + 1) / 2 + row] * a[k];
        }
        a[row] = a[row] * factor[row * (row + 1) / 2 + row];
    }
    a
}
