//! A weighted least-squares polynomial around a place, kept as the sums over neighbours that evaluate it.
//!
//! Minimise `sum_j w_j (P(d_j) - f_j)^2` over the monomials `P` of the scaled distance `d = (x_j - x) / r_e`. With
//! `sqrt(W) M = Q R` the k-th coefficient is `sum_j c_j f_j`, `c = sqrt(W) Q R^-T e_k`: weights that belong to the
//! points alone, so one fit serves every field. Weight `w = (1 - r/r_e)^2`.

use glam::DVec2;

/// Degree of the polynomial.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Degree {
    Linear,
    Quadratic,
    Cubic,
}

const LARGEST: usize = 10;

impl Degree {
    /// Number of coefficients, the constant's included.
    pub const fn terms(self) -> usize {
        match self {
            Self::Linear => 3,
            Self::Quadratic => 6,
            Self::Cubic => LARGEST,
        }
    }
}

/// 1, x, y, x^2, xy, y^2, x^3, x^2 y, x y^2, y^3
fn monomials(d: DVec2) -> [f64; LARGEST] {
    let (x, y) = (d.x, d.y);
    [1.0, x, y, x * x, x * y, y * y, x * x * x, x * x * y, x * y * y, y * y * y]
}

/// A column keeps less than this of its length once the columns before it are taken out: the points do not tell the
/// monomials apart.
const PIVOT: f64 = 1e-3;

/// The factored fit of one place.
#[derive(Debug, Clone)]
pub struct Fit {
    terms: usize,
    radius: f64,
    /// Square roots of the weights.
    root: Vec<f64>,
    /// Orthonormal columns, one after another.
    q: Vec<f64>,
    /// Columns of the upper triangle.
    r: [[f64; LARGEST]; LARGEST],
}

impl Fit {
    /// Fits around the origin of `offset`, m; points at `radius` metres and farther carry no weight.
    ///
    /// `None` where the points are too few or lie so that the monomials can't be told apart.
    pub fn new(offset: &[DVec2], radius: f64, degree: Degree) -> Option<Self> {
        let (rows, terms) = (offset.len(), degree.terms());
        if rows < terms {
            return None;
        }
        let root: Vec<f64> = offset.iter().map(|d| (1.0 - d.length() / radius).max(0.0)).collect();
        let mut q = vec![0.0; rows * terms];
        for (j, &d) in offset.iter().enumerate() {
            for (k, value) in monomials(d / radius).into_iter().take(terms).enumerate() {
                q[k * rows + j] = root[j] * value;
            }
        }
        let mut r = [[0.0; LARGEST]; LARGEST];
        for (k, upper) in r.iter_mut().enumerate().take(terms) {
            let (done, rest) = q.split_at_mut(k * rows);
            let column = &mut rest[..rows];
            let length = norm(column);
            // Gram-Schmidt twice is orthogonal to rounding (Giraud et al. 2005, doi:10.1007/s00211-005-0615-4).
            for _ in 0..2 {
                for (i, earlier) in done.chunks_exact(rows).enumerate() {
                    let along: f64 = earlier.iter().zip(&*column).map(|(a, b)| a * b).sum();
                    column.iter_mut().zip(earlier).for_each(|(value, e)| *value -= along * e);
                    upper[i] += along;
                }
            }
            let left = norm(column);
            if left.is_nan() || left <= PIVOT * length {
                return None;
            }
            column.iter_mut().for_each(|value| *value /= left);
            upper[k] = left;
        }
        Some(Self { terms, radius, root, q, r })
    }

    /// Weights that sum neighbours' values to the polynomial's value at the place.
    pub fn value(&self) -> Vec<f64> {
        self.coefficient(0)
    }

    /// Weights that sum neighbours' values to the polynomial's derivatives along x and y at the place, 1/m.
    pub fn gradient(&self) -> [Vec<f64>; 2] {
        [1, 2].map(|k| self.coefficient(k).into_iter().map(|c| c / self.radius).collect())
    }

    /// `sqrt(W) Q R^-T e_k`
    fn coefficient(&self, k: usize) -> Vec<f64> {
        let mut z = [0.0; LARGEST];
        for i in k..self.terms {
            let below: f64 = (k..i).map(|j| self.r[i][j] * z[j]).sum();
            z[i] = (f64::from(i == k) - below) / self.r[i][i];
        }
        let rows = self.root.len();
        let mut weights = vec![0.0; rows];
        for (column, z) in self.q.chunks_exact(rows).zip(z) {
            weights.iter_mut().zip(column).for_each(|(w, q)| *w += q * z);
        }
        weights.iter_mut().zip(&self.root).for_each(|(w, root)| *w *= root);
        weights
    }
}

fn norm(column: &[f64]) -> f64 {
    column.iter().map(|x| x * x).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lattice(n: i32) -> Vec<DVec2> {
        (-n..=n).flat_map(|j| (-n..=n).map(move |i| DVec2::new(f64::from(i), f64::from(j)))).collect()
    }

    #[test]
    fn gradient_of_a_cubic_is_exact() {
        let offset: Vec<DVec2> = lattice(3).into_iter().map(|d| d + DVec2::new(0.21, -0.4)).collect();
        let fit = Fit::new(&offset, 4.0, Degree::Cubic).unwrap();
        let f = |d: DVec2| 2.0 - 3.0 * d.x + 0.5 * d.y + d.x * d.x * d.y - 0.3 * d.y.powi(3);
        let sum = |w: &[f64]| w.iter().zip(&offset).map(|(w, &d)| w * f(d)).sum::<f64>();
        let [x, y] = fit.gradient();
        assert!((sum(&fit.value()) - 2.0).abs() < 1e-12);
        assert!((sum(&x) + 3.0).abs() < 1e-11 && (sum(&y) - 0.5).abs() < 1e-11);
    }

    #[test]
    fn points_on_a_line_or_too_few_are_refused() {
        let line: Vec<DVec2> = (0..12).map(|i| DVec2::new(0.1 * f64::from(i) - 0.5, 0.0)).collect();
        assert!(Fit::new(&line, 1.0, Degree::Linear).is_none());
        assert!(Fit::new(&lattice(1), 4.0, Degree::Cubic).is_none());
        // Three columns of points can't tell x^3 from x, but hold a quadratic.
        let strip: Vec<DVec2> = lattice(5).into_iter().filter(|d| d.x.abs() < 1.5).collect();
        assert!(Fit::new(&strip, 6.0, Degree::Cubic).is_none());
        assert!(Fit::new(&strip, 6.0, Degree::Quadratic).is_some());
    }
}
