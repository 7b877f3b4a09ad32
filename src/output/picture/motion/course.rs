//! Courses in time: one plot of lines, with published points where there are any.

use glam::DVec2;

use super::super::canvas::Canvas;
use super::super::centreline::range;
use super::super::colour::Rgb;
use super::super::frame::{Axis, BELOW, Frame, LEGEND, draw_title, title_height};
use super::super::text::{Anchor, Direction, Text};

const WIDTH: f64 = 1100.0;
const PLOT: f64 = 520.0;
const EDGE: f64 = 20.0;
const ROW: f64 = 1.45 * LEGEND;
const SIGN: f64 = 46.0;
const COLOURS: [Rgb; 6] = [Rgb::BLUE, Rgb::VERMILION, Rgb::GREEN, Rgb::PURPLE, Rgb::ORANGE, Rgb::SKY];

/// A line, or points where `published`.
#[derive(Debug, Clone)]
pub struct Course {
    pub words: String,
    pub published: bool,
    /// Time, s, and value.
    pub places: Vec<DVec2>,
}

/// Draws them against time; `name` and `unit` are the values'.
pub fn draw(text: &Text, title: &str, (name, unit): (&str, &str), courses: &[Course]) -> Canvas {
    let places = || courses.iter().flat_map(|course| &course.places);
    let end = places().map(|place| place.x).fold(0.0, f64::max);
    let (low, high) = range(places().map(|place| place.y));
    let x = Axis::new(0.0, if end > 0.0 { end } else { 1.0 }, 7, "t", "s");
    let y = Axis::new(low, high, 6, name, unit);
    let left = (EDGE + y.left_room(text)).ceil();
    let words = WIDTH - left - SIGN - EDGE;
    let legend: Vec<Vec<String>> = courses.iter().map(|course| text.wrap(&course.words, LEGEND, words)).collect();
    let lines = legend.iter().map(Vec::len).sum::<usize>() as f64;
    let top = title_height(text, title, WIDTH);
    let mut canvas = Canvas::new(WIDTH as u32, (top + PLOT + BELOW + 8.0 + lines * ROW + EDGE).ceil() as u32);
    draw_title(&mut canvas, text, title, WIDTH);
    let corner = DVec2::new(left, top).round();
    let frame = Frame { low: corner, high: DVec2::new(WIDTH - EDGE - 14.0, corner.y + PLOT), x, y };
    frame.draw_grid(&mut canvas);
    let mut at = frame.high.y + BELOW + 8.0 + 0.5 * ROW;
    let mut colours = COLOURS.into_iter().cycle();
    for (course, lines) in courses.iter().zip(&legend) {
        let places: Vec<DVec2> = course.places.iter().map(|place| frame.place(place.x, place.y)).collect();
        if course.published {
            places.iter().for_each(|&place| circle(&mut canvas, place));
            circle(&mut canvas, DVec2::new(left + 17.0, at));
        } else {
            let colour = colours.next().unwrap_or(Rgb::BLACK);
            canvas.polyline(&places, 2.4, colour);
            canvas.line(DVec2::new(left, at), DVec2::new(left + 34.0, at), 2.6, colour, 1.0);
        }
        for line in lines {
            text.draw(&mut canvas, line, DVec2::new(left + SIGN, at), LEGEND, Anchor::Start, Direction::Rightwards);
            at += ROW;
        }
    }
    frame.draw(&mut canvas, text);
    canvas
}

fn circle(canvas: &mut Canvas, at: DVec2) {
    canvas.disc(at, 6.5, Rgb::BLACK);
    canvas.disc(at, 4.4, Rgb::WHITE);
}
