//! Local least squares of any order: the normal equations of one pack of points.
//!
//! Continuous: Taylor's polynomial of degree `p`. Discrete, for `p = 2`:
//! `phi_j - phi_i = a1 x + a2 y + a3 x^2 + a4 xy + a5 y^2` in the least-squares sense over the neighbours, with
//! `(x, y) = d / r_e` and weight `w(r)`: the paper's (2.5), its derivatives (2.6). Orders 1 to 4 have 2, 5, 9 and 14
//! coefficients, degree by degree, powers of x falling.
//! Shapes: `N` coefficients, `F` factor entries a point, row by row below the diagonal: l00, l10, l11, l20, ...; the
//! diagonal holds reciprocals. A coefficient left out has zeros in its row, so that it comes out as zero. `M` moments.

use crate::case::Weight;
use crate::cpu::real::{Pack, Real};
use crate::cpu::unrolled::unrolled;

/// Most coefficients: those of order 4.
const MOST: usize = coefficients(LARGEST_ORDER);
pub const LARGEST_ORDER: usize = 4;
/// Least pivot of the factorisation, relative to the diagonal entry it came from.
pub const PIVOT_THRESHOLD: f64 = 1e-5;

/// Coefficients of a fit of this order: all monomials up to its degree but the constant.
pub const fn coefficients(order: usize) -> usize {
    start(order + 1)
}

/// Entries of the factor of a normal matrix with this many rows.
pub const fn entries(coefficients: usize) -> usize {
    coefficients * (coefficients + 1) / 2
}

/// Sums that make up the normal matrix of this order: monomials of degree 2 to twice the order.
pub const fn moments(order: usize) -> usize {
    start(2 * order + 1) - start(2)
}

/// Place of the first monomial of a degree among the coefficients.
pub const fn start(degree: usize) -> usize {
    degree * (degree + 1) / 2 - 1
}

/// Degree and power of y of each monomial.
pub const MONOMIALS: [(usize, usize); MOST] = {
    let mut all = [(1, 0); MOST];
    let mut k = 1;
    while k < MOST {
        let (degree, power) = all[k - 1];
        all[k] = if power < degree { (degree, power + 1) } else { (degree + 1, 0) };
        k += 1;
    }
    all
};

/// Calls `$body` with the numbers of coefficients, factor entries and moments of `$order` as constants.
#[macro_export]
#[doc(hidden)]
macro_rules! with_order {
    (@one $order:literal, $n:ident, $f:ident, $m:ident, $body:expr) => {{
        #[allow(dead_code, reason = "not every body names all three")]
        const $n: usize = $crate::cpu::operations::moments::coefficients($order);
        #[allow(dead_code, reason = "as above")]
        const $f: usize = $crate::cpu::operations::moments::entries($n);
        #[allow(dead_code, reason = "as above")]
        const $m: usize = $crate::cpu::operations::moments::moments($order);
        $body
    }};
    ($order:expr, [$n:ident, $f:ident, $m:ident] => $body:expr) => {
        match $order {
            1 => with_order!(@one 1, $n, $f, $m, $body),
            2 => with_order!(@one 2, $n, $f, $m, $body),
            3 => with_order!(@one 3, $n, $f, $m, $body),
            _ => with_order!(@one 4, $n, $f, $m, $body),
        }
    };
}

/// Weight of a neighbour at the scaled distance `q = r / r_e`, from `q^2`.
#[inline(always)]
pub fn weight<T: Real, P: Pack<T>>(which: Weight, square: P) -> P {
    let one = P::splat(T::from_f64(1.0));
    match which {
        Weight::None => one,
        Weight::Quadratic => {
            let rest = (one - square.sqrt()).max(P::zero());
            rest * rest
        }
        Weight::Smooth => {
            let rest = (one - square).max(P::zero());
            let square = rest * rest;
            square * square
        }
    }
}

/// `x, y, x^2, xy, y^2, ...`
#[inline(always)]
pub fn basis<T: Real, P: Pack<T>, const N: usize>(x: P, y: P) -> [P; N] {
    let mut monomials = [x; N];
    monomials[1] = y;
    unrolled!(below < LARGEST_ORDER - 1 => {
        let degree = below + 2;
        let (previous, first) = (start(degree - 1), start(degree));
        if first < N {
            for k in 0..degree {
                monomials[first + k] = x * monomials[previous + k];
            }
            monomials[first + degree] = y * monomials[first - 1];
        }
    });
    monomials
}

/// The sums `sum w x^a y^b` that make up the normal matrix.
pub struct Moments<P, const M: usize>([P; M]);

impl<P: Copy, const M: usize> Moments<P, M> {
    #[inline(always)]
    pub fn zero<T: Real>() -> Self
    where
        P: Pack<T>,
    {
        Self([P::zero(); M])
    }

    /// Adds one neighbour at scaled offset `(x, y)`.
    #[inline(always)]
    pub fn add<T: Real>(&mut self, x: P, y: P, weight: P)
    where
        P: Pack<T>,
    {
        // The weighted monomials of one degree after the other.
        let mut terms = [weight * x; 2 * LARGEST_ORDER + 1];
        terms[1] = weight * y;
        unrolled!(below < 2 * LARGEST_ORDER - 1 => {
            let degree = below + 2;
            let first = start(degree) - start(2);
            if first < M {
                for (sum, term) in self.0[first..].iter_mut().zip(&terms[..degree]) {
                    *sum = term.mul_add(x, *sum);
                }
                self.0[first + degree] = terms[degree - 1].mul_add(y, self.0[first + degree]);
                if first + degree + 1 < M {
                    terms[degree] = terms[degree - 1] * y;
                    for term in &mut terms[..degree] {
                        *term = *term * x;
                    }
                }
            }
        });
    }

    /// Lower triangle of the normal matrix, row by row.
    #[inline(always)]
    pub fn matrix<const F: usize>(&self) -> [P; F] {
        let mut matrix = [self.0[0]; F];
        unrolled!(row < MOST => {
            unrolled!(column < row + 1 => {
                let place = entries(row) + column;
                if place < F {
                    let [(degree, power), (other, its)] = [MONOMIALS[row], MONOMIALS[column]];
                    matrix[place] = self.0[start(degree + other) - start(2) + power + its];
                }
            });
        });
        matrix
    }
}

/// Cholesky factor with reciprocal diagonal, and every pivot relative to the diagonal entry it came from. The leading rows
/// are the factor of the fits of lower order. A coefficient whose pivot fails is left out.
#[inline(always)]
pub fn factorise<T: Real, P: Pack<T>, const N: usize, const F: usize>(matrix: [P; F]) -> ([P; F], [P; N]) {
    let tiny = P::splat(T::from_f64(1e-30));
    let one = P::splat(T::from_f64(1.0));
    let threshold = P::splat(T::from_f64(PIVOT_THRESHOLD));
    let mut factor = matrix;
    let mut pivots = [one; N];
    unrolled!(row < N => {
        let start = entries(row);
        unrolled!(column < row + 1 => {
            let other = entries(column);
            let mut entry = factor[start + column];
            for k in 0..column {
                entry -= factor[start + k] * factor[other + k];
            }
            if column < row {
                factor[start + column] = entry * factor[other + column];
            } else {
                let relative = entry / matrix[start + row].max(tiny);
                let reciprocal = one / entry.max(tiny).sqrt();
                pivots[row] = relative;
                factor[start + column] = relative.select_above(threshold, reciprocal, P::zero());
            }
        });
    });
    (factor, pivots)
}

/// The least of these pivots and 1.
#[inline(always)]
pub fn least<T: Real, P: Pack<T>>(pivots: &[P]) -> P {
    let one = P::splat(T::from_f64(1.0));
    pivots.iter().fold(one, |least, &pivot| least - (least - pivot).max(P::zero()))
}

/// Solves the normal equations for one right side.
#[inline(always)]
pub fn solve<T: Real, P: Pack<T>, const N: usize, const F: usize>(factor: &[P; F], right: [P; N]) -> [P; N] {
    let mut a = right;
    unrolled!(row < N => {
        let start = entries(row);
        for k in 0..row {
            a[row] -= factor[start + k] * a[k];
        }
        a[row] = a[row] * factor[start + row];
    });
    unrolled!(above < N => {
        let row = N - 1 - above;
        for k in row + 1..N {
            a[row] -= factor[entries(k) + row] * a[k];
        }
        a[row] = a[row] * factor[entries(row) + row];
    });
    a
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cpu::real::One;

    #[test]
    fn orders_have_the_numbers_of_the_textbook() {
        assert_eq!([1, 2, 3, 4].map(coefficients), [2, 5, 9, 14]);
        assert_eq!([1, 2, 3, 4].map(|order| entries(coefficients(order))), [3, 15, 45, 105]);
        assert_eq!([1, 2, 3, 4].map(moments), [3, 12, 25, 42]);
        assert_eq!(MONOMIALS[..6], [(1, 0), (1, 1), (2, 0), (2, 1), (2, 2), (3, 0)]);
    }

    /// The normal matrix, entry by entry as it is defined, and its factor multiplied out again.
    #[test]
    fn the_matrix_is_the_sum_of_products_and_the_factor_multiplies_back_to_it() {
        fn check<const N: usize, const F: usize, const M: usize>() {
            let mut sums = Moments::<One<f64>, M>::zero();
            let mut expected = [0.0; F];
            for k in 0..40 {
                let (x, y, w) = ((1.7 * f64::from(k)).sin(), (2.3 * f64::from(k)).cos(), 0.5 + 0.01 * f64::from(k));
                sums.add(One(x), One(y), One(w));
                let b: [f64; N] = std::array::from_fn(|n| {
                    x.powi((MONOMIALS[n].0 - MONOMIALS[n].1) as i32) * y.powi(MONOMIALS[n].1 as i32)
                });
                let found: [One<f64>; N] = basis(One(x), One(y));
                (0..N).for_each(|n| assert!((found[n].0 - b[n]).abs() < 1e-14));
                (0..N).for_each(|r| (0..=r).for_each(|c| expected[entries(r) + c] += w * b[r] * b[c]));
            }
            let matrix: [One<f64>; F] = sums.matrix();
            (0..F).for_each(|k| assert!((matrix[k].0 - expected[k]).abs() < 1e-12 * expected[0], "entry {k} of {F}"));
            let (factor, pivots): (_, [One<f64>; N]) = factorise(matrix);
            assert!(least(&pivots).0 > 1e-3);
            let lower =
                |r: usize, c: usize| if r == c { 1.0 / factor[entries(r) + c].0 } else { factor[entries(r) + c].0 };
            for r in 0..N {
                for c in 0..=r {
                    let product: f64 = (0..=c).map(|k| lower(r, k) * lower(c, k)).sum();
                    assert!((product - expected[entries(r) + c]).abs() < 1e-11 * expected[0], "({r}, {c}) of {N}");
                }
            }
            let right: [One<f64>; N] = std::array::from_fn(|n| One(1.0 + n as f64));
            let a = solve(&factor, right);
            for r in 0..N {
                let row: f64 = (0..N).map(|c| expected[entries(r.max(c)) + r.min(c)] * a[c].0).sum();
                assert!((row - right[r].0).abs() < 1e-9, "row {r} of {N}");
            }
        }
        check::<2, 3, 3>();
        check::<5, 15, 12>();
        check::<9, 45, 25>();
        check::<14, 105, 42>();
    }
}
