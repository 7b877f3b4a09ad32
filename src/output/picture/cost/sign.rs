//! Marks that are told apart by colour and by shape.

use glam::DVec2;

use super::super::canvas::Canvas;
use super::super::colour::Rgb;

/// Colour and shape of the settings that belong together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sign {
    pub colour: Rgb,
    shape: Shape,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Shape {
    Disc,
    Square,
    Up,
    Diamond,
    Down,
    Cross,
}

/// Of Okabe and Ito's palette, which the colour-blind tell apart, those that stand out on white.
const COLOURS: [Rgb; 7] = [Rgb::BLUE, Rgb::VERMILION, Rgb::GREEN, Rgb::PURPLE, Rgb::ORANGE, Rgb::SKY, Rgb([60; 3])];
const SHAPES: [Shape; 6] = [Shape::Disc, Shape::Square, Shape::Up, Shape::Diamond, Shape::Down, Shape::Cross];
/// Half the size of a mark, pixels.
const SIZE: f64 = 8.0;

impl Sign {
    /// Six and seven have no common factor: the first 42 differ as pairs.
    pub fn new(index: usize) -> Self {
        Self { colour: COLOURS[index % COLOURS.len()], shape: SHAPES[index % SHAPES.len()] }
    }

    /// A mark with a white edge.
    pub fn draw(self, canvas: &mut Canvas, at: DVec2) {
        self.shape(canvas, at, Rgb::WHITE, 2.0);
        self.shape(canvas, at, self.colour, 0.0);
    }

    fn shape(self, canvas: &mut Canvas, at: DVec2, colour: Rgb, margin: f64) {
        let mut polygon = |corners: &[(f64, f64)]| {
            let corners: Vec<DVec2> = corners.iter().map(|&corner| at + SIZE * DVec2::from(corner)).collect();
            canvas.polygon(&corners, margin, colour, 1.0);
        };
        match self.shape {
            Shape::Disc => canvas.disc(at, 0.95 * SIZE + margin, colour),
            Shape::Square => polygon(&[(-0.85, -0.85), (0.85, -0.85), (0.85, 0.85), (-0.85, 0.85)]),
            Shape::Up => polygon(&[(0.0, -1.15), (1.05, 0.75), (-1.05, 0.75)]),
            Shape::Down => polygon(&[(0.0, 1.15), (-1.05, -0.75), (1.05, -0.75)]),
            Shape::Diamond => polygon(&[(0.0, -1.25), (1.05, 0.0), (0.0, 1.25), (-1.05, 0.0)]),
            Shape::Cross => {
                let arm = 0.8 * SIZE * DVec2::ONE;
                for arm in [arm, arm.perp()] {
                    canvas.line(at - arm, at + arm, 4.5 + 2.0 * margin, colour, 1.0);
                }
            }
        }
    }

    /// A mark on a piece of its line, as legends have it.
    pub fn draw_in_legend(self, canvas: &mut Canvas, start: DVec2) {
        canvas.line(start, start + 34.0 * DVec2::X, 2.4, self.colour, 1.0);
        self.draw(canvas, start + 17.0 * DVec2::X);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dozens_of_signs_differ() {
        let signs: Vec<Sign> = (0..42).map(Sign::new).collect();
        assert!((0..42).all(|k| !signs[..k].contains(&signs[k])));
    }

    #[test]
    fn every_shape_draws_something_else() {
        let drawn = |shape| {
            let mut canvas = Canvas::new(40, 40);
            Sign { colour: Rgb::BLACK, shape }.draw(&mut canvas, DVec2::splat(20.0));
            (0..1600).map(|k| canvas.pixel(k % 40, k / 40)).collect::<Vec<_>>()
        };
        let all = SHAPES.map(drawn);
        assert!((0..all.len()).all(|k| all[k].contains(&[0; 3]) && !all[..k].contains(&all[k])));
    }
}
