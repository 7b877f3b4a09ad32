//! The shipped cases of points that move: the paper's interpolation form diverges and is noticed, shifted points do not.

use std::path::Path;
use std::sync::Arc;

use glam::DVec2;
use stillpoint::case::Case;
use stillpoint::cpu;
use stillpoint::motion::{self, Row};
use stillpoint::scene::Scene;
use stillpoint::simulation::{Outcome, Stop, Trouble, simulate};

use crate::rows::Rows;

fn run(name: &str, overrides: &[&str]) -> (Scene, Outcome, Vec<Row>) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(name);
    let overrides: Vec<String> = overrides.iter().map(|&given| given.to_owned()).collect();
    let case = Case::load(&path, &overrides).expect("a shipped case");
    let scene = Scene::build(&case).expect("a scene");
    let shared = Arc::new(scene.clone());
    let mut rows = Rows::default();
    let outcome = simulate(&shared, cpu::double(&shared).expect("an engine").as_mut(), &mut rows).expect("a run");
    (scene, outcome, rows.moved)
}

/// Kinetic and potential energy, m^4/s^2.
fn energy(row: &Row) -> f64 {
    row.kinetic_energy + row.potential_energy
}

#[test]
fn the_papers_interpolation_form_diverges_and_is_noticed_while_all_is_finite() {
    let (_, outcome, rows) = run("dam_break_interpolation.toml", &[]);
    let Stop::Trouble { trouble: Trouble::Diverged(reason), step } = &outcome.stop else {
        panic!("{:?}", outcome.stop)
    };
    assert!(!reason.is_empty() && *step > 100);
    let last = rows.last().expect("rows");
    assert!(last.time > 0.05 && last.time < 0.3, "{last:?}");
    // Nothing holds the density: points have clustered.
    assert!(last.nearest[0] < 0.3 && rows[0].nearest[0] > 0.9, "{last:?}");
    let snapshot = &outcome.snapshot;
    assert!(snapshot.velocity.iter().chain(&snapshot.position).all(|value| value.is_finite()));
    assert!(snapshot.pressure.iter().all(|p| p.is_finite()));
}

#[test]
fn shifted_points_run_the_collapse_to_the_wall_evenly_and_without_gaining_energy() {
    let (scene, outcome, rows) = run("dam_break_shifted.toml", &["time.end=0.22"]);
    assert_eq!(outcome.stop, Stop::End);
    assert!(rows.iter().all(|row| energy(row) < 1.05 * energy(&rows[0]) && row.lost == 0));
    // Evenly: until the front meets the wall.
    let before = rows.iter().filter(|row| row.time > 0.0 && row.time < 0.18);
    assert!(before.clone().all(|row| row.nearest[0] > 0.4), "{:?}", before.map(|row| row.nearest).collect::<Vec<_>>());
    let size = scene.constants.size;
    let inside = |place: &glam::DVec2| place.x >= 0.0 && place.x <= size.x && place.y >= 0.0 && place.y <= size.y;
    assert!(outcome.snapshot.position.iter().all(inside));
}

/// What is done in a second to keep them even does not depend on the step: with half of the usual one no energy comes in.
#[test]
fn shifted_points_run_the_collapse_with_half_the_step_as_well() {
    for courant in ["time.courant=0.2", "time.courant=0.1"] {
        let (_, outcome, rows) = run("dam_break_shifted.toml", &["cloud.spacing=0.005715", courant]);
        assert_eq!(outcome.stop, Stop::End);
        assert!(rows.iter().all(|row| energy(row) < 1.02 * energy(&rows[0])), "{courant}");
    }
}

/// `sum x (y' of the velocity)` about the middle of the patch, m^2/s: the angular momentum over the mass of a point.
fn turning(position: &[glam::DVec2], velocity: &[glam::DVec2]) -> f64 {
    let middle = glam::DVec2::splat(1.5);
    position.iter().zip(velocity).map(|(&place, &velocity)| (place - middle).perp_dot(velocity)).sum()
}

#[test]
fn a_square_that_rotates_is_held_together_by_its_pressure_and_keeps_what_it_has() {
    let (scene, outcome, rows) = run("rotating_square.toml", &["cloud.spacing=0.05", "time.end=1.0"]);
    assert_eq!(outcome.stop, Stop::End);
    // Colagrossi (2005): lap p = 2 rho omega^2 and p = 0 on the sides of a unit square, as a double sine series in its middle.
    let odd = || (0..200).map(|k| f64::from(2 * k + 1));
    let term = |m: f64, n: f64| {
        let sign = if ((m + n) / 2.0) as i64 % 2 == 0 { -1.0 } else { 1.0 };
        sign * 32.0 / (m * n * (m * m + n * n) * std::f64::consts::PI.powi(4))
    };
    let expected = -1000.0 * odd().flat_map(|m| odd().map(move |n| term(m, n))).sum::<f64>();
    assert!((expected + 147.34).abs() < 0.01, "{expected}");
    assert!((rows[0].sensors[0] / expected - 1.0).abs() < 0.03, "{:?}, {expected}", rows[0].sensors);
    // It pulls on, no row peels off, and nothing is gained.
    let last = rows.last().expect("rows");
    assert!(last.sensors[0] < -80.0 && last.area < 1.1, "{last:?}");
    assert!(rows.iter().all(|row| (energy(row) / energy(&rows[0]) - 1.0).abs() < 0.02 && row.lost == 0));
    // No push is bounded where nothing splashes.
    assert!(rows.iter().all(|row| row.bounded == 0));
    let snapshot = &outcome.snapshot;
    let begun = turning(&scene.cloud.position, &scene.initial_velocity());
    let ended = turning(&snapshot.position, &snapshot.velocity);
    assert!((ended / begun - 1.0).abs() < 0.02, "{begun} {ended}");
    // The corners have grown into arms.
    let reach = |position: &[glam::DVec2]| {
        position.iter().map(|place| (*place - glam::DVec2::splat(1.5)).length()).fold(0.0, f64::max)
    };
    assert!(reach(&snapshot.position) > 1.3 * reach(&scene.cloud.position));
}

#[test]
fn water_at_rest_keeps_its_pressure_and_its_level() {
    let (_, outcome, rows) = run("hydrostatic_shifted.toml", &["time.end=1.5"]);
    assert_eq!(outcome.stop, Stop::End);
    // rho g h on the bottom of the shipped tank.
    let expected = 1000.0 * 9.81 * 0.25;
    for row in rows.iter().filter(|row| row.time > 0.3) {
        assert!((row.sensors[0] / expected - 1.0).abs() < 0.02 && (row.area - 1.0).abs() < 0.01, "{row:?}");
    }
    assert!(rows.iter().all(|row| row.bounded == 0));
}

#[test]
fn mps_runs_the_collapse_and_counts_every_point() {
    let (scene, outcome, rows) = run("dam_break_mps.toml", &["time.end=0.15"]);
    assert_eq!(outcome.stop, Stop::End);
    assert_eq!(outcome.snapshot.position.len(), scene.sizes.interior);
    assert!(rows.iter().all(|row| energy(row) < 1.05 * energy(&rows[0])));
    // Noisier than shifted points: closer ones too, held apart by the collision guard.
    assert!(
        rows.iter().all(|row| row.nearest[0] > 0.3),
        "{:?}",
        rows.iter().map(|row| row.nearest[0]).collect::<Vec<_>>()
    );
}

/// Mean, over `rho g h`, and root mean square about the mean of the pressure on the bottom once the water has settled.
fn on_the_bottom(rows: &[Row], depth: f64) -> [f64; 2] {
    let late = rows.iter().filter(|row| row.time > 0.5);
    let pressure: Vec<f64> = late.map(|row| row.sensors[0] / (1000.0 * 9.81 * depth)).collect();
    let mean = pressure.iter().sum::<f64>() / pressure.len() as f64;
    [mean, (pressure.iter().map(|p| (p - mean).powi(2)).sum::<f64>() / pressure.len() as f64).sqrt()]
}

#[test]
fn mps_bears_the_weight_of_the_water_by_the_corrected_gradient_and_not_by_the_plain_one() {
    let shallow = ["time.end=1.5", "domain.width=0.2", "domain.height=0.15", "cloud.fill.to=[0.2, 0.1]"];
    let (scene, outcome, rows) = run("hydrostatic_mps.toml", &shallow);
    assert_eq!(outcome.stop, Stop::End);
    let [mean, noise] = on_the_bottom(&rows, 0.1);
    assert!((mean - 1.0).abs() < 0.02 && noise < 0.03, "{mean} {noise}");
    // Within a spacing of level, and as much of it as before.
    let level = |row: &&Row| (row.column - 0.1).abs() < scene.constants.spacing && (row.area - 1.0).abs() < 0.01;
    let settled: Vec<&Row> = rows.iter().filter(|row| row.time > 0.5).collect();
    assert!(settled.iter().all(level) && settled.iter().all(|row| row.lost == 0));

    // Half of a gradient at the surface: a spacing's weight too much below it, one of twenty.
    let (_, outcome, rows) =
        run("hydrostatic_mps.toml", &[&shallow[..], &["effects.pressure.gradient=least"]].concat());
    assert_eq!(outcome.stop, Stop::End);
    let [plain, noisier] = on_the_bottom(&rows, 0.1);
    assert!((plain - 1.05).abs() < 0.02 && noisier > 2.0 * noise, "{plain} {noisier}");
}

#[test]
fn a_lost_point_is_named_by_its_number_in_the_cloud() {
    // A turn that throws points of the outer columns through the walls in the one step.
    let step = 0.001;
    let (scene, outcome, rows) =
        run("hydrostatic_mps.toml", &["initial.rotation=48.0", "time.end=0.001", "output.report_every=1", "expect={}"]);
    assert_eq!(outcome.stop, Stop::End);
    let last = rows.last().expect("rows");
    assert!(last.lost > 4 && last.lost == last.outside.len() as u64, "{last:?}");
    for (point, place) in outcome.snapshot.position.iter().enumerate() {
        let named = last.outside.iter().find(|lost| lost.point == point);
        assert_eq!(named.is_some(), motion::lost(&scene, *place), "point {point}");
        assert!(named.is_none_or(|lost| lost.place == place.to_array()));
        // The point of this number in the cloud is the one that was thrown there; those beside it are a spacing away.
        let thrown = scene.cloud.position[point] + step * scene.initial_velocity()[point];
        if thrown.x < -0.05 * scene.constants.spacing {
            let near =
                |lost: &motion::Lost| (thrown - DVec2::from(lost.place)).length() < 0.5 * scene.constants.spacing;
            assert!(named.is_some_and(near), "point {point} {named:?}");
        }
    }
}
