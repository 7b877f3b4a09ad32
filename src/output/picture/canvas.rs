//! A picture in memory, with shapes drawn by their distance functions: the edge pixel's share is its distance from the
//! outline, which is all the anti-aliasing that lines, discs and arrows need.

use std::collections::BTreeMap;
use std::path::Path;

use glam::DVec2;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ImageEncoder, RgbImage};

use super::colour::Rgb;
use crate::output::OutputError;
use crate::output::file::write_whole;

/// Pixel coordinates have their origin at the upper left corner; the centre of the first pixel is (0.5, 0.5).
#[derive(Debug, Clone)]
pub struct Canvas {
    image: RgbImage,
}

impl Canvas {
    /// A white picture, sides in pixels.
    pub fn new(width: u32, height: u32) -> Self {
        Self { image: RgbImage::from_pixel(width, height, image::Rgb([255; 3])) }
    }

    /// Covers a share of one pixel, `alpha` in 0 to 1; pixels outside the picture are left out.
    pub fn blend(&mut self, x: i64, y: i64, colour: Rgb, alpha: f64) {
        let (Ok(x), Ok(y)) = (u32::try_from(x), u32::try_from(y)) else { return };
        if let Some(pixel) = self.image.get_pixel_mut_checked(x, y) {
            for (below, above) in pixel.0.iter_mut().zip(colour.0) {
                let mixed = f64::from(*below) + (f64::from(above) - f64::from(*below)) * alpha.clamp(0.0, 1.0);
                *below = mixed.round() as u8;
            }
        }
    }

    /// Colours one pixel of the picture; one outside is left out.
    pub fn set(&mut self, x: u32, y: u32, colour: Rgb) {
        if let Some(pixel) = self.image.get_pixel_mut_checked(x, y) {
            pixel.0 = colour.0;
        }
    }

    fn size(&self) -> DVec2 {
        DVec2::new(f64::from(self.image.width()), f64::from(self.image.height()))
    }

    /// Fills where `distance` (pixels, negative inside) is below zero, within the box from `low` to `high`.
    fn fill(&mut self, low: DVec2, high: DVec2, colour: Rgb, alpha: f64, distance: impl Fn(DVec2) -> f64) {
        cover(self.size(), low, high, distance, |x, y, share| self.blend(x, y, colour, alpha * share));
    }

    /// A straight line with round ends.
    pub fn line(&mut self, from: DVec2, to: DVec2, width: f64, colour: Rgb, alpha: f64) {
        segment(self.size(), from, to, width, |x, y, share| self.blend(x, y, colour, alpha * share));
    }

    /// Lines from point to point, as one shape: where the soft edges of short lines overlap, they don't add up.
    pub fn polyline(&mut self, points: &[DVec2], width: f64, colour: Rgb) {
        let mut cover = BTreeMap::<(i64, i64), f64>::new();
        for pair in points.windows(2) {
            let size = self.size();
            segment(size, pair[0], pair[1], width, |x, y, share| {
                let most = cover.entry((y, x)).or_insert(0.0);
                *most = most.max(share);
            });
        }
        for ((y, x), share) in cover {
            self.blend(x, y, colour, share);
        }
    }

    pub fn disc(&mut self, centre: DVec2, radius: f64, colour: Rgb) {
        self.fill(centre - radius, centre + radius, colour, 1.0, |at| at.distance(centre) - radius);
    }

    /// A convex polygon, its corners in either sense of rotation, grown by `margin` pixels on every side.
    pub fn polygon(&mut self, corners: &[DVec2], margin: f64, colour: Rgb, alpha: f64) {
        let next = |k: usize| corners[(k + 1) % corners.len()];
        let area: f64 = (0..corners.len()).map(|k| corners[k].perp_dot(next(k))).sum();
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for &corner in corners {
            (low, high) = (low.min(corner), high.max(corner));
        }
        self.fill(low - margin, high + margin, colour, alpha, |at| {
            let outside = |k: usize| {
                let side = next(k) - corners[k];
                (at - corners[k]).perp_dot(side) * area.signum() / side.length().max(f64::MIN_POSITIVE)
            };
            (0..corners.len()).map(outside).fold(f64::NEG_INFINITY, f64::max) - margin
        });
    }

    /// Width and height in pixels, and the three bytes of each.
    pub fn raw(&self) -> (u32, u32, &[u8]) {
        (self.image.width(), self.image.height(), self.image.as_raw())
    }

    /// Writes the picture as PNG.
    ///
    /// # Errors
    /// Errors of the file system.
    pub fn save(&self, path: &Path) -> Result<(), OutputError> {
        write_whole(path, |file| {
            let (width, height) = self.image.dimensions();
            PngEncoder::new_with_quality(file, CompressionType::Default, FilterType::NoFilter)
                .write_image(self.image.as_raw(), width, height, image::ExtendedColorType::Rgb8)
                .map_err(|source| OutputError::Image { path: path.to_owned(), source })
        })
    }

    #[cfg(test)]
    pub fn pixel(&self, x: u32, y: u32) -> [u8; 3] {
        self.image.get_pixel(x, y).0
    }
}

/// Calls `paint` with each pixel of a picture of this size that a shape covers, and the share it covers.
fn cover(size: DVec2, low: DVec2, high: DVec2, distance: impl Fn(DVec2) -> f64, mut paint: impl FnMut(i64, i64, f64)) {
    let (low, high) = ((low - 1.0).max(DVec2::ZERO), (high + 1.0).min(size));
    for y in low.y.floor() as i64..high.y.ceil() as i64 {
        for x in low.x.floor() as i64..high.x.ceil() as i64 {
            let share = 0.5 - distance(DVec2::new(x as f64 + 0.5, y as f64 + 0.5));
            if share > 0.0 {
                paint(x, y, share.min(1.0));
            }
        }
    }
}

/// The pixels of a straight line with round ends.
fn segment(size: DVec2, from: DVec2, to: DVec2, width: f64, paint: impl FnMut(i64, i64, f64)) {
    let half = 0.5 * width;
    let along = to - from;
    let scale = 1.0 / along.length_squared().max(f64::MIN_POSITIVE);
    let distance = |at: DVec2| {
        let share = ((at - from).dot(along) * scale).clamp(0.0, 1.0);
        at.distance(from + share * along) - half
    };
    cover(size, from.min(to) - half, from.max(to) + half, distance, paint);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ink(canvas: &Canvas) -> f64 {
        canvas.image.pixels().map(|p| 1.0 - f64::from(p.0[1]) / 255.0).sum()
    }

    #[test]
    fn shapes_cover_their_area() {
        let centre = DVec2::new(30.3, 31.7);
        let area = |draw: &dyn Fn(&mut Canvas)| {
            let mut canvas = Canvas::new(64, 64);
            draw(&mut canvas);
            ink(&canvas)
        };
        let disc = area(&|c| c.disc(centre, 10.0, Rgb::BLACK));
        assert!((disc - std::f64::consts::PI * 100.0).abs() < 3.0, "{disc}");
        let line = area(&|c| c.line(DVec2::new(10.2, 12.0), DVec2::new(40.2, 52.0), 3.0, Rgb::BLACK, 1.0));
        assert!((line - 150.0 - std::f64::consts::PI * 2.25).abs() < 3.0, "{line}");
        let ends = (DVec2::new(10.2, 12.0), DVec2::new(40.2, 52.0));
        let many: Vec<DVec2> = (0..=2000).map(|k| ends.0.lerp(ends.1, f64::from(k) / 2000.0)).collect();
        let curve = area(&|c| c.polyline(&many, 3.0, Rgb::BLACK));
        assert!((curve - line).abs() < 1.0, "{curve}");
        for corners in [[(10.0, 10.0), (50.0, 12.0), (20.0, 40.0)], [(20.0, 40.0), (50.0, 12.0), (10.0, 10.0)]] {
            let corners = corners.map(|(x, y)| DVec2::new(x, y));
            let triangle = area(&|c| c.polygon(&corners, 0.0, Rgb::BLACK, 1.0));
            assert!((triangle - 590.0).abs() < 6.0, "{triangle}");
        }
    }

    #[test]
    fn shapes_outside_the_picture_draw_nothing() {
        let mut canvas = Canvas::new(16, 16);
        canvas.disc(DVec2::new(-20.0, 8.0), 5.0, Rgb::BLACK);
        canvas.line(DVec2::new(40.0, 1e6), DVec2::new(50.0, 1e6), 3.0, Rgb::BLACK, 1.0);
        canvas.blend(16, 0, Rgb::BLACK, 1.0);
        assert_eq!(ink(&canvas), 0.0);
    }
}
