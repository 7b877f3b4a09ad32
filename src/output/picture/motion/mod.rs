//! The pictures of points that move: each point a disc where it stands, at the end and on the way.

mod animation;
mod course;
mod sheet;

use std::path::{Path, PathBuf};

use glam::DVec2;

use super::canvas::Canvas;
use super::colour::Rgb;
use super::scale::ColourScale;
use super::text::Text;
use super::ticks::short;
use super::{map, save_all};
use crate::case::{Case, Measure, Profile};
use crate::motion::Row;
use crate::output::file::check;
use crate::output::motion::Frames;
use crate::output::{OutputError, RunFolder};
use crate::snapshot::Snapshot;
use course::Course;
use sheet::{Cell, DISC, Sheet, View, discs};

/// Frames of a sheet, and how many stand side by side.
const CHOSEN: usize = 6;
const COLUMNS: usize = 3;
/// Width of a cell, pixels: of a sheet, of one with a column a run, of the animation.
const CELL: f64 = 400.0;
const ANIMATED: f64 = 560.0;
/// Width that the cells of a row take together at most, and the tallest map, pixels.
const ROW: f64 = 1350.0;
const TALLEST: f64 = 520.0;

/// A run as its pictures take it.
#[derive(Debug, Clone, Copy)]
pub struct Film<'a> {
    pub case: &'a Case,
    /// Time reached, s.
    pub time: f64,
    pub rows: &'a [Row],
    pub frames: &'a Frames,
    /// The published course of its front, in its own units.
    pub front: Option<&'a Profile>,
}

/// Draws the pictures of a run into its folder: of its last state, and of its frames and courses where it has them.
///
/// # Errors
/// A state without points or with a value that is not finite, errors of the file system.
pub fn draw_film(folder: &RunFolder, film: &Film, last: &Snapshot) -> Result<Vec<PathBuf>, OutputError> {
    check(last)?;
    let text = Text::new()?;
    let case = film.case;
    let title = format!("{}, t = {} s", case.title, short(last.time, 4));
    let speed: Vec<f64> = last.velocity.iter().map(|u| u.length()).collect();
    let mut drawn = vec![
        (folder.pressure_picture(), state(&text, case, last, &last.pressure, ("p", "Pa"), &title)),
        (folder.speed_picture(), state(&text, case, last, &speed, ("|u|", "m/s"), &title)),
    ];
    drawn.extend(courses(&text, folder.path(), std::slice::from_ref(film), &[], &case.title));
    let mut paths = save_all(drawn)?;
    if film.frames.count() > 0 {
        paths.extend(filmed(&text, folder, film)?);
    }
    Ok(paths)
}

/// sheet.png, heights.png and animation.png.
fn filmed(text: &Text, folder: &RunFolder, film: &Film) -> Result<Vec<PathBuf>, OutputError> {
    let (case, frames) = (film.case, film.frames);
    let cell = |number: usize| -> Result<Cell, OutputError> {
        let state = frames.read(number)?;
        Ok(Cell { words: at(state.time), state: Some(state), spacing: case.cloud.spacing })
    };
    let chosen = chosen(frames.count()).into_iter().map(cell).collect::<Result<Vec<Cell>, OutputError>>()?;
    let scale = scale(&chosen);
    let domain = DVec2::new(case.domain.width, case.domain.height);
    let columns = COLUMNS.min(chosen.len());
    let sheet = |view, width, columns| Sheet {
        title: &case.title,
        domain,
        view,
        scale: &scale,
        headings: &[],
        columns,
        width: fitted(width, domain),
    };
    let drawn = [
        (folder.sheet_picture(), sheet(View::Map, CELL, columns).draw(text, &chosen)),
        (folder.heights_picture(), sheet(View::Heights, CELL, columns).draw(text, &chosen)),
    ];
    let mut paths = save_all(drawn)?;
    let one = sheet(View::Map, ANIMATED, 1);
    let path = folder.animation();
    animation::write(&path, frames.count(), |number| Ok(one.draw(text, &[cell(number)?])))?;
    paths.push(path);
    Ok(paths)
}

/// Draws runs side by side into a folder: `sheet.png` and `heights.png` with a row a time and a column a run, `front.png` and
/// `sensors.png` with a line a run. `names` head the columns.
///
/// # Errors
/// Errors of the file system.
pub fn draw_films(folder: &Path, films: &[Film], names: &[String]) -> Result<Vec<PathBuf>, OutputError> {
    let text = Text::new()?;
    let Some(longest) = films.iter().max_by(|a, b| a.frames.count().cmp(&b.frames.count())) else {
        return Ok(Vec::new());
    };
    let times: Vec<f64> = chosen(longest.frames.count()).into_iter().map(|k| longest.frames.time(k)).collect();
    let mut cells = Vec::new();
    for &time in &times {
        for film in films {
            let spacing = film.case.cloud.spacing;
            cells.push(match film.frames.near(time) {
                Some(number) => {
                    let state = film.frames.read(number)?;
                    Cell { words: at(state.time), state: Some(state), spacing }
                }
                None => Cell { words: format!("ended at {} s", short(film.time, 4)), state: None, spacing },
            });
        }
    }
    let (scale, case) = (scale(&cells), longest.case);
    let domain = DVec2::new(case.domain.width, case.domain.height);
    let width = fitted((ROW / films.len() as f64).min(CELL), domain);
    let title = format!("{} runs at the same times", films.len());
    let columns = films.len();
    let sheet = |view| Sheet { title: &title, domain, view, scale: &scale, headings: names, columns, width };
    let mut drawn = vec![
        (folder.join("sheet.png"), sheet(View::Map).draw(&text, &cells)),
        (folder.join("heights.png"), sheet(View::Heights).draw(&text, &cells)),
    ];
    drawn.extend(courses(&text, folder, films, names, &title));
    save_all(drawn)
}

/// front.png where a front was published, and sensors.png where there are sensors.
fn courses(text: &Text, folder: &Path, films: &[Film], names: &[String], title: &str) -> Vec<(PathBuf, Canvas)> {
    let named = |k: usize, words: &str| match names.get(k) {
        Some(name) if words.is_empty() => name.clone(),
        Some(name) => format!("{name}: {words}"),
        None if words.is_empty() => "computed".to_owned(),
        None => words.to_owned(),
    };
    let line = |film: &Film, of: &dyn Fn(&Row) -> f64| -> Vec<DVec2> {
        film.rows.iter().map(|row| DVec2::new(row.time, of(row))).collect()
    };
    let mut drawn = Vec::new();
    let published: Vec<Course> = films.iter().find_map(published).into_iter().collect();
    if !published.is_empty() {
        let computed = films.iter().enumerate().map(|(k, film)| Course {
            words: named(k, ""),
            published: false,
            places: line(film, &|row| row.front),
        });
        let all: Vec<Course> = computed.chain(published).collect();
        let canvas = course::draw(text, &format!("{title}: front"), ("x", "m"), &all);
        drawn.push((folder.join("front.png"), canvas));
    }
    let sensors = films.iter().enumerate().flat_map(|(k, film)| {
        film.case.output.sensors.keys().enumerate().map(move |(sensor, name)| (k, film, sensor, name))
    });
    let all: Vec<Course> = sensors
        .map(|(k, film, sensor, name)| Course {
            words: named(k, name),
            published: false,
            places: line(film, &|row| row.sensors.get(sensor).copied().unwrap_or(0.0)),
        })
        .collect();
    if !all.is_empty() {
        let canvas = course::draw(text, &format!("{title}: pressure at the sensors"), ("p", "Pa"), &all);
        drawn.push((folder.join("sensors.png"), canvas));
    }
    drawn
}

/// The published front of a run in seconds and metres on the run's clock.
fn published(film: &Film) -> Option<Course> {
    let expected = film.case.expect.values().find(|row| row.measure == Measure::Front)?;
    let (length, duration) = (expected.length?, expected.duration?);
    let profile = film.front?;
    let time = |at: f64| (at - expected.delay.unwrap_or(0.0)) * duration;
    let places = profile.coordinate.iter().zip(&profile.value).map(|(&at, &z)| DVec2::new(time(at), z * length));
    Some(Course { words: expected.source.clone(), published: true, places: places.filter(|at| at.x >= 0.0).collect() })
}

/// A map of one state.
fn state(text: &Text, case: &Case, last: &Snapshot, values: &[f64], bar: (&str, &str), title: &str) -> Canvas {
    let scale = if bar.0 == "p" { ColourScale::signed(values) } else { ColourScale::magnitude(values) };
    let domain = DVec2::new(case.domain.width, case.domain.height);
    let pixels = map::size(&case.domain).0 as f64 / case.domain.width;
    let points = |canvas: &mut Canvas, low: DVec2| {
        discs(canvas, last, values, &scale, (low, pixels, domain), DISC * case.cloud.spacing);
    };
    map::draw(text, &case.domain, title, &scale, bar, |_, _| Rgb::WHITE, points)
}

/// One scale for all of them.
fn scale(cells: &[Cell]) -> ColourScale {
    let pressure = cells.iter().filter_map(|cell| cell.state.as_ref()).flat_map(|state| state.pressure.iter().copied());
    ColourScale::signed(&pressure.collect::<Vec<f64>>())
}

/// Numbers of frames, evenly chosen, the first and the last among them.
fn chosen(count: usize) -> Vec<usize> {
    let most = CHOSEN.min(count);
    (0..most).map(|k| if most == 1 { 0 } else { (k * (count - 1) + (most - 1) / 2) / (most - 1) }).collect()
}

/// A cell of a tall domain is narrower.
fn fitted(width: f64, domain: DVec2) -> f64 {
    width.min(TALLEST * domain.x / domain.y).max(120.0)
}

fn at(time: f64) -> String {
    format!("t = {} s", short(time, 4))
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;
    use std::fs;

    use image::ImageReader;

    use super::*;
    use crate::output::MotionWriter;

    /// A run of a block that slides along the floor; `shift` moves it, `press` adds to its pressure.
    fn left_by(folder: &Path, shift: f64, press: f64) -> BTreeMap<String, Vec<u8>> {
        let case: Case = toml::from_str(
            "title = 't'\ndomain = { width = 2.0, height = 1.0 }\ncloud = { arrangement = 'regular', spacing = 0.1 }\n\
             fluid.density = 1.0\noutput = { frame_every = 0.5, sensors = { a = { at = [0.0, 0.0] } } }\n[expect.a]\n\
             measure = 'front'\nlength = 1.0\nduration = 1.0\ntolerance = 0.1\nsource = 'a paper'\n",
        )
        .unwrap();
        let state = |time: f64| {
            let block = (0..25).map(|k| DVec2::new(0.1 * (k % 5) as f64 + time + shift, 0.1 * (k / 5) as f64));
            let position: Vec<DVec2> = block.collect();
            let pressure = position.iter().map(|place| 1.0 - place.y + press * time).collect();
            Snapshot { time, velocity: vec![DVec2::X; 25], pressure, position, ..Snapshot::default() }
        };
        let folder = RunFolder::create(folder, true).unwrap();
        let mut writer = MotionWriter::create(&folder, &case).unwrap();
        let row = |time: f64| Row { time, front: time + shift, sensors: vec![press * time], ..Row::default() };
        let rows = [0.0, 0.5, 1.0].map(row);
        for row in &rows {
            writer.append(row).unwrap();
            writer.keep(&state(row.time)).unwrap();
        }
        let frames = Frames::open(&folder.frames()).unwrap();
        let profile = Profile { coordinate: vec![0.2, 0.8], value: vec![0.3, 0.9] };
        let film = Film { case: &case, time: 1.0, rows: &rows, frames: &frames, front: Some(&profile) };
        let mut paths = draw_film(&folder, &film, &state(1.0)).unwrap();
        let compared = folder.path().join("compared");
        fs::create_dir_all(&compared).unwrap();
        let short = Film { rows: &rows[..1], time: 0.2, ..film };
        paths.extend(draw_films(&compared, &[film, short], &["one".to_owned(), "two".to_owned()]).unwrap());
        let name = |path: &PathBuf| path.strip_prefix(folder.path()).unwrap().display().to_string();
        paths.iter().map(|path| (name(path), fs::read(path).unwrap())).collect()
    }

    #[test]
    fn each_picture_shows_where_the_points_are_or_what_presses_on_them() {
        let root = tempfile::tempdir().unwrap();
        let first = left_by(root.path(), 0.0, 0.0);
        let all =
            ["animation.png", "front.png", "heights.png", "pressure.png", "sensors.png", "sheet.png", "speed.png"];
        let compared = ["front.png", "heights.png", "sensors.png", "sheet.png"].map(|name| format!("compared/{name}"));
        assert_eq!(first.keys().filter(|name| !name.contains('/')).collect::<Vec<_>>(), all);
        assert_eq!(first.keys().filter(|name| name.contains('/')).collect::<Vec<_>>(), compared.each_ref());
        assert_eq!(first, left_by(root.path(), 0.0, 0.0), "the same run gives the same pictures");
        let changed = |other: BTreeMap<String, Vec<u8>>| {
            let same = first.iter().filter(|(name, bytes)| other[*name] == **bytes).map(|(name, _)| name.clone());
            same.collect::<Vec<String>>()
        };
        assert_eq!(changed(left_by(root.path(), 0.05, 0.0)), ["compared/sensors.png", "sensors.png"]);
        assert_eq!(changed(left_by(root.path(), 0.0, 3.0)), ["compared/front.png", "front.png", "speed.png"]);
    }

    #[test]
    fn the_animation_has_every_frame_and_is_for_ever() {
        let root = tempfile::tempdir().unwrap();
        let bytes = &left_by(root.path(), 0.0, 0.0)["animation.png"];
        let control = bytes.windows(4).position(|name| name == b"acTL").expect("the chunk of an animation") + 4;
        let number = |at: usize| u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap());
        assert_eq!((number(control), number(control + 4)), (3, 0));
        assert_eq!(bytes.windows(4).filter(|name| name == b"fcTL").count(), 3);
        ImageReader::open(root.path().join("animation.png")).unwrap().decode().unwrap();
    }

    #[test]
    fn frames_are_chosen_evenly_with_both_ends() {
        assert_eq!(chosen(31), [0, 6, 12, 18, 24, 30]);
        assert_eq!(chosen(8), [0, 1, 3, 4, 6, 7]);
        assert_eq!((chosen(1), chosen(2), chosen(0)), (vec![0], vec![0, 1], vec![]));
    }
}
