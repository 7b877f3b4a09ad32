//! Text in the built-in font, DejaVu Sans (its licence lies beside it in `assets`).

use ab_glyph::{Font, FontRef, PxScale, ScaleFont, point};
use glam::DVec2;

use super::canvas::Canvas;
use super::colour::Rgb;
use crate::output::OutputError;

static FONT: &[u8] = include_bytes!("../../../assets/dejavu_sans_subset.ttf");

/// Height of a capital letter over the size of the font.
const CAPITAL: f64 = 0.73;

/// Which end of the text stands at the place given; texts are centred on it across the line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    Start,
    Middle,
    End,
}

/// Which way the text runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Direction {
    Rightwards,
    Upwards,
}

/// The font; sizes are in pixels per em.
#[derive(Debug)]
pub struct Text {
    font: FontRef<'static>,
}

impl Text {
    /// # Errors
    /// A built-in font that can't be read.
    pub fn new() -> Result<Self, OutputError> {
        Ok(Self { font: FontRef::try_from_slice(FONT).map_err(|_| OutputError::Font)? })
    }

    fn scale(&self, size: f64) -> PxScale {
        let em = self.font.units_per_em().unwrap_or(self.font.height_unscaled());
        PxScale::from(size as f32 * self.font.height_unscaled() / em)
    }

    /// Width of a line of text, pixels.
    pub fn width(&self, text: &str, size: f64) -> f64 {
        let font = self.font.as_scaled(self.scale(size));
        let mut previous = None;
        let mut width = 0.0;
        for glyph in text.chars().map(|c| font.glyph_id(c)) {
            width += previous.map_or(0.0, |p| font.kern(p, glyph)) + font.h_advance(glyph);
            previous = Some(glyph);
        }
        f64::from(width)
    }

    /// Breaks a text into lines no wider than `width` pixels, between words; a longer word stays whole.
    pub fn wrap(&self, text: &str, size: f64, width: f64) -> Vec<String> {
        let mut lines: Vec<String> = Vec::new();
        for word in text.split_whitespace() {
            if let Some(line) = lines.last_mut() {
                let longer = format!("{line} {word}");
                if self.width(&longer, size) <= width {
                    *line = longer;
                    continue;
                }
            }
            lines.push(word.to_owned());
        }
        lines
    }

    /// The text, or as much of its beginning as is no wider than `width` pixels with an ellipsis behind.
    pub fn cut(&self, text: &str, size: f64, width: f64) -> String {
        let ends = text.char_indices().map(|(end, _)| end).chain([text.len()]).rev();
        let shorter =
            |end: usize| if end == text.len() { text.to_owned() } else { format!("{}...", text[..end].trim_end()) };
        ends.map(shorter).find(|text| self.width(text, size) <= width).unwrap_or_default()
    }

    /// Draws one line of text in black.
    pub fn draw(&self, canvas: &mut Canvas, text: &str, at: DVec2, size: f64, anchor: Anchor, direction: Direction) {
        let font = self.font.as_scaled(self.scale(size));
        let mut along = match anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => -0.5 * self.width(text, size),
            Anchor::End => -self.width(text, size),
        };
        let baseline = (0.5 * CAPITAL * size).round();
        let mut previous = None;
        for glyph in text.chars().map(|c| font.glyph_id(c)) {
            along += f64::from(previous.map_or(0.0, |p| font.kern(p, glyph)));
            previous = Some(glyph);
            // The part below a whole pixel goes to the rasteriser, which places glyphs exactly.
            let (start, across) = match direction {
                Direction::Rightwards => (at.x + along, at.y.round() + baseline),
                Direction::Upwards => (at.y - along, at.x.round() + baseline),
            };
            let whole = start.floor();
            let offset = if direction == Direction::Upwards { whole + 1.0 - start } else { start - whole };
            let placed = glyph.with_scale_and_position(font.scale(), point(offset as f32, 0.0));
            if let Some(outline) = self.font.outline_glyph(placed) {
                let corner = outline.px_bounds().min;
                outline.draw(|x, y, cover| {
                    let right = i64::from(x) + corner.x as i64;
                    let down = i64::from(y) + corner.y as i64;
                    let (x, y) = match direction {
                        Direction::Rightwards => (whole as i64 + right, across as i64 + down),
                        Direction::Upwards => (across as i64 + down, whole as i64 - right),
                    };
                    canvas.blend(x, y, Rgb::BLACK, f64::from(cover));
                });
            }
            along += f64::from(font.h_advance(glyph));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_sign_that_figures_use_is_in_the_font() {
        let text = Text::new().unwrap();
        for sign in "0123456789.−⁰¹²³⁴⁵⁶⁷⁸⁹⁻[]|/=xyuvptmsPaé&–’×%,:;()@_".chars() {
            assert_ne!(text.font.glyph_id(sign).0, 0, "{sign} is missing");
        }
    }

    #[test]
    fn lines_are_no_wider_than_asked() {
        let text = Text::new().unwrap();
        let long = "Botella and Peyret, Benchmark spectral results on the lid-driven cavity flow";
        let lines = text.wrap(long, 18.0, 240.0);
        assert!(lines.len() > 2 && lines.iter().all(|line| text.width(line, 18.0) <= 240.0));
        assert_eq!(lines.join(" "), long);
    }

    #[test]
    fn what_is_too_wide_is_cut() {
        let text = Text::new().unwrap();
        let long = "collocated, random, courant 0.4";
        assert_eq!(text.cut(long, 18.0, 600.0), long);
        let cut = text.cut(long, 18.0, 120.0);
        assert!(cut.starts_with("colloc") && cut.ends_with("..."), "{cut}");
        assert!(text.width(&cut, 18.0) <= 120.0 && text.width(&cut, 18.0) > 100.0);
        assert_eq!(text.cut(long, 18.0, 1.0), "");
    }

    #[test]
    fn anchors_and_directions_place_the_ink() {
        let text = Text::new().unwrap();
        let ink = |anchor, direction| {
            let mut canvas = Canvas::new(200, 200);
            text.draw(&mut canvas, "HHHH", DVec2::new(100.0, 100.0), 20.0, anchor, direction);
            let dark: Vec<(u32, u32)> = (0..200)
                .flat_map(|y| (0..200).map(move |x| (x, y)))
                .filter(|&(x, y)| canvas.pixel(x, y)[0] < 128)
                .collect();
            let range = |of: fn(&(u32, u32)) -> u32| (dark.iter().map(of).min(), dark.iter().map(of).max());
            (range(|p| p.0), range(|p| p.1))
        };
        let (x, y) = ink(Anchor::Start, Direction::Rightwards);
        assert!(x.0 >= Some(100) && y.0 >= Some(91) && y.1 <= Some(109), "{x:?} {y:?}");
        let (x, _) = ink(Anchor::End, Direction::Rightwards);
        assert!(x.1 <= Some(100) && x.0 >= Some(30), "{x:?}");
        let (x, y) = ink(Anchor::Start, Direction::Upwards);
        assert!(y.1 <= Some(100) && x.0 >= Some(91) && x.1 <= Some(109), "{x:?} {y:?}");
    }
}
