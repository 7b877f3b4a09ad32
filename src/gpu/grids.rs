//! The levels of the coarse pressure in WGSL: one after the other written out, each with numbers that are constants.

use std::fmt::Write;

use crate::scene::Scene;
use crate::step::aggregates;
use crate::step::coarse::levels;

/// The text behind `#import name`, where it is one of these.
pub(super) fn library(name: &str, scene: &Scene) -> Option<String> {
    let levels = written(scene);
    match name {
        "coarse_grids" => {
            let structure = match scene.aggregates() {
                Some(_) => include_str!("../../shaders/library/aggregates/levels.wgsl"),
                None => include_str!("../../shaders/library/coarse/grids.wgsl"),
            };
            Some(format!("{structure}{}", ends(&levels)))
        }
        "written/coarse_matrix" => Some(matrix(&levels)),
        "written/coarse_cycle" => Some(cycle(&levels)),
        _ => None,
    }
}

/// The levels as constants of a call, finest first.
fn written(scene: &Scene) -> Vec<String> {
    let text = |numbers: &[usize]| {
        let numbers = numbers.iter().map(|number| format!("{number}u")).collect::<Vec<_>>();
        format!("Level({})", numbers.join(", "))
    };
    match scene.aggregates() {
        Some(aggregates) => {
            let numbers = |level: &aggregates::Level| [level.first, level.count, level.slots, level.entries];
            aggregates.levels.iter().map(|level| text(&numbers(level))).collect()
        }
        None => {
            levels(&scene.constants.grid).iter().map(|level| text(&[level.first, level.columns, level.rows])).collect()
        }
    }
}

/// The two finest levels as constants; the second is empty where there is one alone.
fn ends(levels: &[String]) -> String {
    let second = levels.get(1).map_or("Level()", String::as_str);
    format!("const FINEST = {};\nconst SECOND = {second};\n", levels[0])
}

/// The rows of every grid above the finest, each from those of the one below.
fn matrix(levels: &[String]) -> String {
    let mut text = String::from("fn sum_up_all(local: u32) {\n");
    for pair in levels.windows(2) {
        let [fine, coarse] = pair else { continue };
        line(&mut text, format_args!("    sum_up({fine}, {coarse}, local);\n    storageBarrier();"));
    }
    text.push_str("}\n");
    text
}

/// From the second level down to the last and up again.
fn cycle(levels: &[String]) -> String {
    let mut text = String::from("fn go_through_all(local: u32) {\n");
    for pair in levels.windows(2).skip(1) {
        let [fine, coarse] = pair else { continue };
        line(&mut text, format_args!("    go_down({fine}, {coarse}, local);\n    storageBarrier();"));
    }
    for (number, level) in levels.iter().enumerate().skip(1).rev() {
        if let Some(coarse) = levels.get(number + 1) {
            line(&mut text, format_args!("    bring_up({level}, {coarse}, local);\n    storageBarrier();"));
        }
        line(&mut text, format_args!("    smooth_out({level}, local);\n    storageBarrier();"));
    }
    text.push_str("}\n");
    text
}

fn line(text: &mut String, content: std::fmt::Arguments) {
    // Writing to a string cannot fail.
    let _ = writeln!(text, "{content}");
}
