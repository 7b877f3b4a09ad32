//! The value of a scattered field anywhere: a cubic least-squares fit of the points around the place.

use glam::DVec2;

use super::{CellList, Degree, Fit, Images, MeasureError};
use crate::case::Case;
use crate::cloud::Sizing;

/// The ladder of fits, best first: degree, radius in spacings. At walls and corners the circle is cut, so the cubic
/// fit gets wider circles before the degree is lowered.
const LADDER: [(Degree, f64); 6] = [
    (Degree::Cubic, 3.2),
    (Degree::Cubic, 4.0),
    (Degree::Cubic, 5.0),
    (Degree::Quadratic, 3.2),
    (Degree::Quadratic, 5.0),
    (Degree::Linear, 5.0),
];

/// A fit whose weights' magnitudes sum to more than this magnifies the points' errors: take the next rung.
const LARGEST_AMPLIFICATION: f64 = 3.0;

/// The sum over points that evaluates any field at one place.
#[derive(Debug, Clone, PartialEq)]
pub struct Stencil {
    pub points: Vec<usize>,
    pub weights: Vec<f64>,
    /// Degree of the polynomials it reproduces; `None` is the nearest point's value.
    pub degree: Option<Degree>,
}

impl Stencil {
    /// The field's value at the stencil's place, in the field's unit.
    pub fn apply(&self, field: &[f64]) -> f64 {
        self.points.iter().zip(&self.weights).map(|(&point, weight)| weight * field[point]).sum()
    }
}

/// Evaluates fields that live on scattered points.
#[derive(Debug, Clone)]
pub struct Sampler<'a> {
    images: Images<'a>,
    cells: CellList,
    /// The least where it varies, m.
    spacing: f64,
    /// Where the spacing varies.
    sizing: Option<Sizing>,
}

impl<'a> Sampler<'a> {
    /// On the points of a case.
    ///
    /// # Errors
    /// As [`Sampler::new`].
    pub fn of(case: &Case, position: &'a [DVec2]) -> Result<Self, MeasureError> {
        let sizing = Sizing::of(case);
        let mut sampler = Self::periodic(position, sizing.least(), case.domain.period())?;
        sampler.sizing = (!sizing.is_even()).then_some(sizing);
        Ok(sampler)
    }

    /// `position` in metres; `spacing` is the mean distance of neighbouring points, m.
    ///
    /// # Errors
    /// No point, a position that is not finite, or a spacing that is not above zero.
    pub fn new(position: &'a [DVec2], spacing: f64) -> Result<Self, MeasureError> {
        Self::periodic(position, spacing, DVec2::ZERO)
    }

    /// The same in a domain that repeats after `period`, m; 0 along an axis that does not.
    ///
    /// # Errors
    /// As [`Sampler::new`].
    pub fn periodic(position: &'a [DVec2], spacing: f64, period: DVec2) -> Result<Self, MeasureError> {
        if !(spacing.is_finite() && spacing > 0.0) {
            return Err(MeasureError::Spacing(spacing));
        }
        let widest = LADDER.iter().map(|(_, radius)| radius * spacing).fold(0.0, f64::max);
        let images = Images::new(position, period, widest);
        Ok(Self { cells: CellList::new(&images.position, 1.6 * spacing)?, images, spacing, sizing: None })
    }

    pub fn points(&self) -> usize {
        self.images.points()
    }

    /// The least spacing, m.
    pub fn spacing(&self) -> f64 {
        self.spacing
    }

    /// The spacing around a place, m.
    fn spacing_at(&self, at: DVec2) -> f64 {
        self.sizing.as_ref().map_or(self.spacing, |sizing| sizing.at(at))
    }

    /// The point nearest to a place.
    pub fn nearest(&self, at: DVec2) -> usize {
        self.images.point(self.cells.nearest(&self.images.position, at))
    }

    /// The stencil that evaluates a field at a place, m: cubic where the points allow it.
    pub fn stencil(&self, at: DVec2) -> Stencil {
        let spacing = self.spacing_at(at);
        for (degree, radius) in LADDER {
            let radius = radius * spacing;
            let (points, offset) = self.neighbours(at, radius);
            if let Some(fit) = Fit::new(&offset, radius, degree) {
                let weights = fit.value();
                if weights.iter().map(|w| w.abs()).sum::<f64>() <= LARGEST_AMPLIFICATION {
                    return Stencil { points, weights, degree: Some(degree) };
                }
            }
        }
        Stencil { points: vec![self.nearest(at)], weights: vec![1.0], degree: None }
    }

    /// A field's value at a place; `field` holds one value a point.
    pub fn value(&self, at: DVec2, field: &[f64]) -> f64 {
        self.stencil(at).apply(field)
    }

    /// Points and weights that sum a field to its derivatives along x and y at a place, 1/m: exact for quadratics.
    /// `None` where the points around it don't hold a gradient.
    pub fn gradient(&self, at: DVec2) -> Option<(Vec<usize>, [Vec<f64>; 2])> {
        self.fitted(at, &[(Degree::Quadratic, 2.3), (Degree::Quadratic, 3.2), (Degree::Linear, 3.2)])
    }

    /// The same on a wall, where all points lie on one side: exact for cubics where the points hold one.
    pub fn slope(&self, at: DVec2) -> Option<(Vec<usize>, [Vec<f64>; 2])> {
        self.fitted(at, &LADDER)
    }

    fn fitted(&self, at: DVec2, ladder: &[(Degree, f64)]) -> Option<(Vec<usize>, [Vec<f64>; 2])> {
        let spacing = self.spacing_at(at);
        ladder.iter().find_map(|&(degree, radius)| {
            let (points, offset) = self.neighbours(at, radius * spacing);
            Fit::new(&offset, radius * spacing, degree).map(|fit| (points, fit.gradient()))
        })
    }

    fn neighbours(&self, at: DVec2, radius: f64) -> (Vec<usize>, Vec<DVec2>) {
        let (mut points, mut offset) = (Vec::with_capacity(64), Vec::with_capacity(64));
        self.cells.visit(at, radius, |entry| {
            let d = self.images.position[entry] - at;
            if d.length_squared() < radius * radius {
                points.push(self.images.point(entry));
                offset.push(d);
            }
        });
        (points, offset)
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use rand_core::{Rng, SeedableRng};
    use rand_xoshiro::Xoshiro256PlusPlus;

    /// Points spread evenly over the unit square by chance alone.
    pub(crate) fn random_cloud(count: usize, seed: u64) -> Vec<DVec2> {
        let mut source = Xoshiro256PlusPlus::seed_from_u64(seed);
        let mut next = move || (source.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
        (0..count).map(|_| DVec2::new(next(), next())).collect()
    }

    /// `(n + 1)^2` points on the unit square, the interior ones displaced by up to `jitter` spacings.
    pub(crate) fn jittered_cloud(n: usize, jitter: f64, seed: u64) -> Vec<DVec2> {
        let noise = random_cloud((n + 1) * (n + 1), seed);
        let l0 = 1.0 / n as f64;
        (0..=n)
            .flat_map(|j| (0..=n).map(move |i| (i, j)))
            .zip(noise)
            .map(|((i, j), noise)| {
                let inside = DVec2::new(f64::from(i > 0 && i < n), f64::from(j > 0 && j < n));
                DVec2::new(i as f64, j as f64) * l0 + inside * (2.0 * noise - 1.0) * jitter * l0
            })
            .collect()
    }

    /// Points along the walls and darts inside, no two closer than 0.7 spacings of `1 / n`.
    fn dart_cloud(n: usize, seed: u64) -> Vec<DVec2> {
        let apart = 0.7 / n as f64;
        let wall = |x: &DVec2| x.x.min(x.y) == 0.0 || x.x.max(x.y) == 1.0;
        let mut cloud: Vec<DVec2> = jittered_cloud(n, 0.0, 1).into_iter().filter(wall).collect();
        for dart in random_cloud(60 * n * n, seed) {
            if cloud.len() < (n + 1) * (n + 1) && cloud.iter().all(|x| x.distance(dart) > apart) {
                cloud.push(dart);
            }
        }
        cloud
    }

    fn cubic(x: DVec2) -> f64 {
        let (x, y) = (x.x - 0.3, x.y - 0.6);
        1.0 + 2.0 * x - y + 3.0 * x * x - x * y + 0.5 * y * y + 4.0 * x.powi(3) - 2.0 * x * x * y + x * y * y
            - y.powi(3)
    }

    #[test]
    fn cubics_are_exact_inside_at_walls_and_in_corners() {
        for cloud in [
            jittered_cloud(20, 0.0, 1),
            jittered_cloud(20, 0.45, 1),
            jittered_cloud(20, 0.45, 2),
            dart_cloud(20, 3),
            dart_cloud(20, 7),
        ] {
            let sampler = Sampler::new(&cloud, 0.05).unwrap();
            let field: Vec<f64> = cloud.iter().map(|&x| cubic(x)).collect();
            let mut cubics = 0;
            for k in 0..=200 {
                let s = f64::from(k) / 200.0;
                for at in [DVec2::new(s, 0.37), DVec2::new(0.0, s), DVec2::new(s, 1.0), DVec2::splat(s)] {
                    let stencil = sampler.stencil(at);
                    if stencil.degree == Some(Degree::Cubic) {
                        cubics += 1;
                        assert!((stencil.apply(&field) - cubic(at)).abs() < 1e-11, "at {at}");
                    }
                }
            }
            assert!(cubics > 795, "{cubics} of 804 places were fitted by a cubic");
        }
    }

    #[test]
    fn lattices_and_jittered_clouds_are_cubic_everywhere() {
        for jitter in [0.0, 0.45] {
            let cloud = jittered_cloud(16, jitter, 4);
            let sampler = Sampler::new(&cloud, 1.0 / 16.0).unwrap();
            for at in jittered_cloud(37, 0.3, 9) {
                assert_eq!(sampler.stencil(at).degree, Some(Degree::Cubic), "at {at}");
            }
        }
    }

    #[test]
    fn error_falls_with_the_fourth_power_of_the_spacing() {
        let f = |x: DVec2| (5.0 * x.x).sin() * (4.0 * x.y).cos();
        let error = |n: usize| {
            let cloud = jittered_cloud(n, 0.4, 3);
            let field: Vec<f64> = cloud.iter().map(|&x| f(x)).collect();
            let sampler = Sampler::new(&cloud, 1.0 / n as f64).unwrap();
            let places = random_cloud(300, 8);
            (places.iter().map(|&x| (sampler.value(x, &field) - f(x)).powi(2)).sum::<f64>() / 300.0).sqrt()
        };
        let order = (error(20) / error(40)).log2();
        assert!((3.5..5.0).contains(&order), "order {order}");
    }

    #[test]
    fn scale_does_not_matter() {
        let cloud = jittered_cloud(12, 0.4, 6);
        let small: Vec<DVec2> = cloud.iter().map(|&x| x * 1e-6).collect();
        let at = DVec2::new(0.41, 0.03);
        let large = Sampler::new(&cloud, 1.0 / 12.0).unwrap().stencil(at);
        let small = Sampler::new(&small, 1e-6 / 12.0).unwrap().stencil(at * 1e-6);
        let difference = |(a, b): (&f64, &f64)| (a - b).abs();
        assert!(large.weights.iter().zip(&small.weights).map(difference).all(|d| d < 1e-9));
    }

    #[test]
    fn too_few_points_step_down_the_ladder() {
        let pair = [DVec2::ZERO, DVec2::X];
        let sampler = Sampler::new(&pair, 1.0).unwrap();
        let stencil = sampler.stencil(DVec2::new(0.9, 0.2));
        assert_eq!((stencil.degree, stencil.apply(&[3.0, 5.0])), (None, 5.0));

        let few: Vec<DVec2> = jittered_cloud(2, 0.2, 1);
        let stencil = Sampler::new(&few, 0.5).unwrap().stencil(DVec2::splat(0.4));
        assert_eq!(stencil.degree, Some(Degree::Quadratic));
    }
}
