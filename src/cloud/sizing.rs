//! How far apart neighbouring points are to be, place by place.
//!
//! `h(x) = min(l0, h_k + g_k d_k(x))` over the refinements `k` of the case: `d_k` is the distance from what `k` is near to, `g_k`
//! its growth. Units: m.

use glam::DVec2;

use super::shape::Shape;
use crate::case::Case;

/// Places along each side at which the spacings are looked at to tell how many points they make.
const SAMPLES: usize = 64;

/// The size function of a case.
#[derive(Debug, Clone, PartialEq)]
pub struct Sizing {
    base: f64,
    size: DVec2,
    refinements: Vec<Refinement>,
}

#[derive(Debug, Clone, PartialEq)]
struct Refinement {
    region: Region,
    spacing: f64,
    growth: f64,
}

#[derive(Debug, Clone, PartialEq)]
enum Region {
    Shape(Shape),
    Box(DVec2, DVec2),
}

impl Region {
    fn distance(&self, place: DVec2) -> f64 {
        match self {
            Region::Shape(shape) => shape.distance(place).max(0.0),
            Region::Box(low, high) => (place - place.clamp(*low, *high)).length(),
        }
    }
}

impl Sizing {
    pub fn of(case: &Case) -> Self {
        let size = DVec2::new(case.domain.width, case.domain.height);
        let region = |name: &str| {
            let side = |low: [f64; 2], high: [f64; 2]| Region::Box(size * DVec2::from(low), size * DVec2::from(high));
            match name {
                "left" => side([0.0, 0.0], [0.0, 1.0]),
                "right" => side([1.0, 0.0], [1.0, 1.0]),
                "bottom" => side([0.0, 0.0], [1.0, 0.0]),
                "top" => side([0.0, 1.0], [1.0, 1.0]),
                name => {
                    let named = case.obstacles.iter().find(|obstacle| obstacle.name == name);
                    // The checks of the case let no other name through.
                    named.map_or(side([0.0; 2], [1.0; 2]), |obstacle| Region::Shape(Shape::of(obstacle)))
                }
            }
        };
        let refinements = case.cloud.refine.iter().map(|refine| Refinement {
            region: match (&refine.near, refine.corners) {
                (None, Some([one, other])) => {
                    let (one, other) = (DVec2::from_array(one), DVec2::from_array(other));
                    Region::Box(one.min(other), one.max(other))
                }
                (near, _) => region(near.as_deref().unwrap_or_default()),
            },
            spacing: refine.spacing,
            growth: refine.growth,
        });
        Self { base: case.cloud.spacing, size, refinements: refinements.collect() }
    }

    /// The spacing at a place, m.
    pub fn at(&self, place: DVec2) -> f64 {
        let of = |refinement: &Refinement| refinement.spacing + refinement.growth * refinement.region.distance(place);
        self.refinements.iter().map(of).fold(self.base, f64::min)
    }

    /// The largest, `l0`, m.
    pub fn base(&self) -> f64 {
        self.base
    }

    /// The least, m.
    pub fn least(&self) -> f64 {
        self.refinements.iter().map(|refinement| refinement.spacing).fold(self.base, f64::min)
    }

    /// About how many points fill the rectangle with these spacings.
    pub fn points(&self) -> f64 {
        let piece = self.size / SAMPLES as f64;
        let middles =
            (0..SAMPLES * SAMPLES).map(|k| DVec2::new((k % SAMPLES) as f64 + 0.5, (k / SAMPLES) as f64 + 0.5));
        middles.map(|middle| piece.element_product() / self.at(middle * piece).powi(2)).sum()
    }

    /// True where the spacing is `l0` everywhere.
    pub fn is_even(&self) -> bool {
        self.refinements.is_empty()
    }

    /// Width and height of the rectangle, m.
    pub fn size(&self) -> DVec2 {
        self.size
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::cloud::Cloud;

    #[test]
    fn a_graded_cloud_has_about_as_many_points_as_it_says() {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/cavity_re1000_graded.toml");
        let case = Case::load(&path, &["cloud.spacing=0.125".to_owned()]).expect("a case");
        let (said, made) = (Cloud::estimate(&case), Cloud::build(&case).expect("a cloud").len() as f64);
        assert!((said / made - 1.0).abs() < 0.1, "{said} points said, {made} made");
    }
}
