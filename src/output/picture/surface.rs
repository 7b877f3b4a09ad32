//! Fields between their points, fast enough for every pixel: each point carries its value and fitted gradient, and a
//! place blends the straight continuations of the points around it (Shepard's method, modified by Franke and Nielson 1980).

use glam::DVec2;
use rayon::prelude::*;

use crate::case::Case;
use crate::cloud::Sizing;
use crate::measure::{CellList, Images, MeasureError, Sampler};

/// Points up to this far, in spacings, take part in a blend.
const REACH: f64 = 1.35;

/// Closer than this, in pixels, a point's gradient can't be seen.
const DENSE: f64 = 1.5;

/// One field at one point and its straight continuation, held to the values of the points that gave the gradient: beside
/// a singular corner it would lead far off.
#[derive(Debug, Clone, Copy)]
struct Continuation {
    value: f64,
    gradient: DVec2,
    /// Least and largest of those values.
    range: (f64, f64),
}

impl Continuation {
    fn at(&self, d: DVec2) -> f64 {
        (self.value + self.gradient.dot(d)).clamp(self.range.0, self.range.1)
    }
}

/// `M` fields on scattered points.
#[derive(Debug)]
pub struct Surface<'a, const M: usize> {
    images: Images<'a>,
    cells: CellList,
    /// The largest, m.
    reach: f64,
    /// Of a pixel, m.
    pixel: f64,
    /// Where the spacing varies.
    sizing: Option<Sizing>,
    /// Each field at each point.
    point: Vec<[Continuation; M]>,
}

/// `M` values at every pixel of a rectangle, row by row from the top.
#[derive(Debug)]
pub struct Raster<const M: usize> {
    pub width: usize,
    pub height: usize,
    pub value: Vec<[f64; M]>,
}

impl<'a, const M: usize> Surface<'a, M> {
    /// On the points of a case; `pixel` in metres. Every field holds one value a point.
    ///
    /// # Errors
    /// No point, a position that is not finite, or a spacing that is not above zero.
    pub fn of(case: &Case, position: &'a [DVec2], pixel: f64, fields: [&[f64]; M]) -> Result<Self, MeasureError> {
        let sampler = Sampler::of(case, position)?;
        let sizing = Sizing::of(case);
        let surface = Self::with_sampler(&sampler, position, case.cloud.spacing, case.domain.period(), pixel, fields)?;
        Ok(Self { sizing: (!sizing.is_even()).then_some(sizing), ..surface })
    }

    /// `spacing` and `pixel` in metres, and `period` too: the domain's length along an axis that repeats, 0 along another.
    fn with_sampler(
        sampler: &Sampler,
        position: &'a [DVec2],
        spacing: f64,
        period: DVec2,
        pixel: f64,
        fields: [&[f64]; M],
    ) -> Result<Self, MeasureError> {
        let reach = REACH * spacing.max(pixel);
        let images = Images::new(position, period, reach);
        let cells = CellList::new(&images.position, reach)?;
        let flat = |k: usize| {
            fields.map(|field| Continuation { value: field[k], gradient: DVec2::ZERO, range: (field[k], field[k]) })
        };
        let point = if spacing < DENSE * pixel {
            (0..position.len()).map(flat).collect()
        } else {
            (0..position.len())
                .into_par_iter()
                .map(|k| match sampler.gradient(position[k]) {
                    Some((points, [x, y])) => {
                        let sum = |weights: &[f64], field: &[f64]| -> f64 {
                            points.iter().zip(weights).map(|(&j, w)| w * field[j]).sum()
                        };
                        fields.map(|field| Continuation {
                            value: field[k],
                            gradient: DVec2::new(sum(&x, field), sum(&y, field)),
                            range: points
                                .iter()
                                .map(|&j| field[j])
                                .fold((field[k], field[k]), |(low, high), v| (low.min(v), high.max(v))),
                        })
                    }
                    None => flat(k),
                })
                .collect()
        };
        Ok(Self { images, cells, reach, pixel, sizing: None, point })
    }

    /// The fields at a place, m.
    pub fn at(&self, at: DVec2) -> [f64; M] {
        let (mut total, mut sum) = (0.0, [0.0; M]);
        let reach = match &self.sizing {
            Some(sizing) => REACH * sizing.at(at).max(self.pixel),
            None => self.reach,
        };
        self.cells.visit(at, reach, |k| {
            let d = at - self.images.position[k];
            let share = 1.0 - d.length_squared() / (reach * reach);
            if share > 0.0 {
                let weight = share * share;
                total += weight;
                for (sum, one) in sum.iter_mut().zip(&self.point[self.images.point(k)]) {
                    *sum += weight * one.at(d);
                }
            }
        });
        if total > 1e-6 {
            sum.map(|sum| sum / total)
        } else {
            let nearest = self.cells.nearest(&self.images.position, at);
            self.point[self.images.point(nearest)].map(|one| one.value)
        }
    }

    /// The fields over `[0, width] x [0, height]`, m, with `columns` by `rows` pixels (two or more), evaluated at every pixel or, where
    /// points lie many pixels apart, at every few and bilinearly between.
    pub fn raster(&self, domain: DVec2, columns: usize, rows: usize) -> Raster<M> {
        let pixel = domain / DVec2::new(columns as f64, rows as f64);
        let spacing = self.sizing.as_ref().map_or(self.reach / REACH, Sizing::least);
        let stride = ((spacing / pixel.max_element() / 3.0) as usize).clamp(1, 4);
        // Nodes from the first pixel's centre to the last's; as many as pixels where the stride is one.
        let (across, down) = ((columns / stride).max(2), (rows / stride).max(2));
        let step = |pixels: usize, nodes: usize| (pixels - 1) as f64 / (nodes - 1) as f64;
        let (column_step, row_step) = (step(columns, across), step(rows, down));
        let node: Vec<[f64; M]> = (0..across * down)
            .into_par_iter()
            .map(|k| {
                let corner = DVec2::new((k % across) as f64 * column_step, (k / across) as f64 * row_step);
                let at = (corner + 0.5) * pixel;
                self.at(DVec2::new(at.x, domain.y - at.y))
            })
            .collect();
        let split = |pixel: usize, step: f64, nodes: usize| {
            let place = pixel as f64 / step;
            let below = (place as usize).min(nodes - 2);
            (below, place - below as f64)
        };
        let value = (0..rows)
            .into_par_iter()
            .flat_map_iter(|row| {
                let (above, down) = split(row, row_step, down);
                let node = &node;
                (0..columns).map(move |column| {
                    let (left, right) = split(column, column_step, across);
                    let k = above * across + left;
                    let mix = |m: usize, k: usize| node[k][m] * (1.0 - right) + node[k + 1][m] * right;
                    std::array::from_fn(|m| mix(m, k) * (1.0 - down) + mix(m, k + across) * down)
                })
            })
            .collect();
        Raster { width: columns, height: rows, value }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::tests::jittered_cloud;

    impl<'a, const M: usize> Surface<'a, M> {
        fn new(
            position: &'a [DVec2],
            spacing: f64,
            period: DVec2,
            pixel: f64,
            fields: [&[f64]; M],
        ) -> Result<Self, MeasureError> {
            let sampler = Sampler::periodic(position, spacing, period)?;
            Self::with_sampler(&sampler, position, spacing, period, pixel, fields)
        }
    }

    fn largest_error(raster: &Raster<1>, exact: impl Fn(DVec2) -> f64) -> f64 {
        let size = DVec2::new(raster.width as f64, raster.height as f64);
        let error = |(k, value): (usize, &[f64; 1])| {
            let at = DVec2::new((k % raster.width) as f64 + 0.5, (k / raster.width) as f64 + 0.5) / size;
            (value[0] - exact(DVec2::new(at.x, 1.0 - at.y))).abs()
        };
        raster.value.iter().enumerate().map(error).fold(0.0, f64::max)
    }

    #[test]
    fn straight_fields_stay_straight_up_to_the_edges() {
        let cloud = jittered_cloud(20, 0.4, 2);
        let plane = |x: DVec2| 3.0 * x.x - 2.0 * x.y + 1.0;
        let field: Vec<f64> = cloud.iter().map(|&x| plane(x)).collect();
        for (size, limit) in [(40, 4e-3), (70, 4e-3), (400, 4e-3)] {
            let surface = Surface::new(&cloud, 0.05, DVec2::ZERO, 1.0 / size as f64, [&field]).unwrap();
            let raster = surface.raster(DVec2::ONE, size, size);
            let error = largest_error(&raster, plane);
            assert!(error < limit, "{size}: {error}");
        }
    }

    #[test]
    fn curved_fields_are_close_on_few_and_on_many_points() {
        let wave = |x: DVec2| (6.0 * x.x).sin() * (5.0 * x.y).cos();
        for (n, size, limit) in [(16, 200, 0.1), (64, 300, 0.01), (200, 100, 0.06)] {
            let cloud = jittered_cloud(n, 0.4, 2);
            let field: Vec<f64> = cloud.iter().map(|&x| wave(x)).collect();
            let surface = Surface::new(&cloud, 1.0 / n as f64, DVec2::ZERO, 1.0 / size as f64, [&field]).unwrap();
            let error = largest_error(&surface.raster(DVec2::ONE, size, size), wave);
            assert!(error < limit, "{n}: {error}");
        }
    }

    #[test]
    fn beside_a_singular_corner_values_stay_between_those_of_the_points() {
        let cloud = jittered_cloud(40, 0.35, 2);
        let field: Vec<f64> = cloud.iter().map(|x| 0.02 / (x.distance(DVec2::ONE) + 0.002)).collect();
        let (least, most) = field.iter().fold((1.0f64, 0.0f64), |(low, high), &v| (low.min(v), high.max(v)));
        let raster =
            Surface::new(&cloud, 0.025, DVec2::ZERO, 1.0 / 500.0, [&field]).unwrap().raster(DVec2::ONE, 500, 500);
        assert!(raster.value.iter().all(|[v]| (least - 1e-12..=most + 1e-12).contains(v)));
    }

    #[test]
    fn a_hole_in_the_cloud_takes_the_nearest_value() {
        let cloud = [DVec2::ZERO, DVec2::ONE];
        let surface = Surface::new(&cloud, 0.01, DVec2::ZERO, 0.1, [&[2.0, 5.0]]).unwrap();
        assert_eq!((surface.at(DVec2::new(0.5, 0.4)), surface.at(DVec2::splat(0.8))), ([2.0], [5.0]));
    }
}
