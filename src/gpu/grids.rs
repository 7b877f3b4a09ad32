//! The grids of the coarse pressure in WGSL: one after the other written out, each with numbers that are constants.

use std::fmt::Write;

use crate::scene::Scene;
use crate::step::coarse::{Level, levels};

/// The text behind `#import name`, where it is one of these.
pub(super) fn library(name: &str, scene: &Scene) -> Option<String> {
    let levels = levels(&scene.constants.grid);
    match name {
        "coarse_grids" => Some(ends(&levels)),
        "written/coarse_matrix" => Some(matrix(&levels)),
        "written/coarse_cycle" => Some(cycle(&levels)),
        _ => None,
    }
}

/// A grid as the constants of a call.
fn grid(level: Level) -> String {
    format!("Grid({}u, {}u, {}u)", level.first, level.columns, level.rows)
}

/// The two finest grids as constants; the second is empty where the first is a single cell.
fn ends(levels: &[Level]) -> String {
    let none = Level { first: 0, columns: 0, rows: 0 };
    let second = levels.get(1).copied().unwrap_or(none);
    let structure = include_str!("../../shaders/library/coarse/grids.wgsl");
    format!("{structure}const FINEST = {};\nconst SECOND = {};\n", grid(levels[0]), grid(second))
}

/// The rows of every grid above the finest, each from those of the one below.
fn matrix(levels: &[Level]) -> String {
    let mut text = String::from("fn sum_up_all(local: u32) {\n");
    for pair in levels.windows(2) {
        let (fine, coarse) = (grid(pair[0]), grid(pair[1]));
        line(&mut text, format_args!("    sum_up({fine}, {coarse}, local);\n    storageBarrier();"));
    }
    text.push_str("}\n");
    text
}

/// From the second grid down to the last and up again.
fn cycle(levels: &[Level]) -> String {
    let mut text = String::from("fn go_through_all(local: u32) {\n");
    for pair in levels.windows(2).skip(1) {
        let (fine, coarse) = (grid(pair[0]), grid(pair[1]));
        line(&mut text, format_args!("    go_down({fine}, {coarse}, local);\n    storageBarrier();"));
    }
    for (number, &level) in levels.iter().enumerate().skip(1).rev() {
        if let Some(&coarse) = levels.get(number + 1) {
            let (fine, coarse) = (grid(level), grid(coarse));
            line(&mut text, format_args!("    bring_up({fine}, {coarse}, local);\n    storageBarrier();"));
        }
        line(&mut text, format_args!("    smooth_out({}, local);\n    storageBarrier();", grid(level)));
    }
    text.push_str("}\n");
    text
}

fn line(text: &mut String, content: std::fmt::Arguments) {
    // Writing to a string cannot fail.
    let _ = writeln!(text, "{content}");
}
