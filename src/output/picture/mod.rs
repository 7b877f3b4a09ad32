//! The pictures of a run, drawn from its last snapshot.

mod bar;
mod canvas;
mod carried;
mod centreline;
mod colour;
mod cost;
mod frame;
mod map;
mod panels;
mod pressure;
mod scale;
mod speed;
mod surface;
mod text;
mod ticks;

use std::collections::BTreeMap;
use std::path::PathBuf;

pub use cost::draw_cost;
pub use ticks::short;

use canvas::Canvas;
use panels::Shown;

use super::file::check;
use super::{OutputError, RunFolder};
use crate::case::{Case, Problem};
use crate::comparison::Panel;
use crate::known::Known;
use crate::measure::Profile;
use crate::snapshot::Snapshot;

/// Draws `pressure.png`, and of a flow `speed.png`, `centreline.png` and a picture of each field that it carries, into a run's folder and returns their paths. `profiles` holds
/// the published profiles by the name of their expectation; one that is missing is left out of the picture.
///
/// # Errors
/// A snapshot without points or with a value that is not finite, errors of the file system.
pub fn draw_all(
    folder: &RunFolder,
    case: &Case,
    snapshot: &Snapshot,
    profiles: &BTreeMap<String, Profile>,
) -> Result<Vec<PathBuf>, OutputError> {
    check(snapshot)?;
    let text = text::Text::new()?;
    let time = format!(", t = {} s", ticks::short(snapshot.time, 4));
    let title = format!("{}{}", case.title, if case.problem() == Problem::Flow { &time } else { "" });
    let mut drawn = vec![(folder.pressure_picture(), pressure::draw(&text, case, snapshot, &title)?)];
    if case.problem() == Problem::Flow {
        for (name, values) in &snapshot.carried {
            drawn.push((folder.carried_picture(name), carried::draw(&text, case, snapshot, (name, values), &title)?));
        }
        drawn.push((folder.speed_picture(), speed::draw(&text, case, snapshot, &title)?));
        drawn.push((folder.centreline_picture(), centreline::draw(&text, case, snapshot, profiles, &title)?));
    }
    save_all(drawn)
}

/// Draws `gradient.png` and `laplacian.png` of a known field, both families of operators side by side.
///
/// # Errors
/// Errors of the file system.
pub fn draw_comparison(
    folder: &RunFolder,
    case: &Case,
    known: &Known,
    panels: &[Panel],
) -> Result<Vec<PathBuf>, OutputError> {
    let text = text::Text::new()?;
    let places = panels.iter().flat_map(|panel| &panel.position);
    let slopes: Vec<f64> = places.clone().map(|&place| known.gradient(place).x).collect();
    let mut drawn = vec![(folder.gradient_picture(), panels::draw(&text, case, panels, Shown::Gradient, &slopes))];
    if panels.iter().all(|panel| panel.laplacian_error.is_some()) {
        let exact: Vec<f64> = places.map(|&place| known.laplacian(place)).collect();
        drawn.push((folder.laplacian_picture(), panels::draw(&text, case, panels, Shown::Laplacian, &exact)));
    }
    save_all(drawn)
}

fn save_all(drawn: impl IntoIterator<Item = (PathBuf, Canvas)>) -> Result<Vec<PathBuf>, OutputError> {
    let save = |(path, canvas): (PathBuf, Canvas)| canvas.save(&path).map(|()| path);
    drawn.into_iter().map(save).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::tests::jittered_cloud;
    use glam::DVec2;
    use image::ImageReader;

    const CASE: &str = "title = 'A swirl'\n[cloud]\narrangement = 'regular'\nspacing = 0.1\n[fluid]\ndensity = 1.0\n\
        [time]\nend = 1.0\n[expect.a]\ncomponent = 'p'\nline = { x = 0.2 }\nmeasure = 'profile'\ntolerance = 0.1\n\
        source = 'a paper with a long title that has to be broken into several lines below its plot'\n";

    fn swirl(width: f64, height: f64) -> (Case, Snapshot) {
        let size = DVec2::new(width, height);
        let case = toml::from_str(&format!("{CASE}[domain]\nwidth = {width:?}\nheight = {height:?}\n")).unwrap();
        let cloud = jittered_cloud(10, 0.3, 4);
        let snapshot = Snapshot {
            time: 0.5,
            velocity: cloud.iter().map(|x| DVec2::new(x.y - 0.5, 0.5 - x.x)).collect(),
            pressure: cloud.iter().map(|x| x.distance(DVec2::splat(0.5)) - 0.3).collect(),
            position: cloud.into_iter().map(|x| x * size).collect(),
            ..Snapshot::default()
        };
        (case, snapshot)
    }

    /// The bytes of pressure.png, speed.png and centreline.png, and their sizes.
    fn drawn(case: &Case, snapshot: &Snapshot, profiles: &BTreeMap<String, Profile>) -> Vec<(Vec<u8>, (u32, u32))> {
        let root = tempfile::tempdir().unwrap();
        let folder = RunFolder::create(root.path(), false).unwrap();
        let paths = draw_all(&folder, case, snapshot, profiles).unwrap();
        let names: Vec<_> = paths.iter().filter_map(|p| p.file_name()?.to_str()).collect();
        assert_eq!(names, ["pressure.png", "speed.png", "centreline.png"]);
        paths
            .iter()
            .map(|path| {
                let image = ImageReader::open(path).unwrap().decode().unwrap();
                (std::fs::read(path).unwrap(), (image.width(), image.height()))
            })
            .collect()
    }

    #[test]
    fn each_picture_shows_its_own_field() {
        let (case, snapshot) = swirl(1.0, 1.0);
        let none = BTreeMap::new();
        let first = drawn(&case, &snapshot, &none);
        assert_eq!(first, drawn(&case, &snapshot, &none), "the same snapshot gives the same pictures");
        let changes = |case: &Case, snapshot: &Snapshot, profiles: &BTreeMap<String, Profile>| {
            let again = drawn(case, snapshot, profiles);
            [0, 1, 2].map(|k| first[k].0 != again[k].0)
        };
        let mut other = snapshot.clone();
        other.pressure[60] += 0.4;
        assert_eq!(changes(&case, &other, &none)[..2], [true, false]);
        let mut other = snapshot.clone();
        other.velocity[60] *= 3.0;
        assert_eq!(changes(&case, &other, &none), [false, true, true]);
        let profile = Profile { coordinate: vec![0.4], value: vec![0.1] };
        assert_eq!(changes(&case, &snapshot, &BTreeMap::from([("a".to_owned(), profile)])), [false, false, true]);
        assert_eq!(changes(&Case { title: "Another".into(), ..case }, &snapshot, &none), [true; 3]);
    }

    #[test]
    fn any_shape_of_domain_fits() {
        for (width, height) in [(4.0, 1.0), (1.0, 4.0), (1e-3, 1e-3), (50.0, 1.0)] {
            let (mut case, snapshot) = swirl(width, height);
            case.cloud.spacing = 0.1 * f64::sqrt(width * height);
            for (_, (columns, rows)) in drawn(&case, &snapshot, &BTreeMap::new()) {
                assert!((400..1300).contains(&columns) && (250..1600).contains(&rows), "{columns} x {rows}");
            }
        }
    }

    #[test]
    fn a_fluid_at_rest_has_pictures_and_one_that_blew_up_has_none() {
        let (case, mut snapshot) = swirl(1.0, 1.0);
        snapshot.velocity.fill(DVec2::ZERO);
        snapshot.pressure.fill(0.0);
        drawn(&case, &snapshot, &BTreeMap::new());

        snapshot.velocity[5].x = f64::NAN;
        let root = tempfile::tempdir().unwrap();
        let folder = RunFolder::open(root.path()).unwrap();
        let error = draw_all(&folder, &case, &snapshot, &BTreeMap::new()).unwrap_err();
        assert!(matches!(error, OutputError::PointNotFinite { ref field, point: 5, .. } if field == "u"), "{error}");
        let nothing = draw_all(&folder, &case, &Snapshot::default(), &BTreeMap::new());
        assert!(matches!(nothing, Err(OutputError::Measure(_))));
    }
}
