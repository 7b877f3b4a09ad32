//! The shipped cases of points that move: the paper's interpolation form diverges and is noticed, shifted points do not.

use std::path::Path;
use std::sync::Arc;

use stillpoint::case::Case;
use stillpoint::cpu;
use stillpoint::motion::Row;
use stillpoint::scene::Scene;
use stillpoint::simulation::{Diagnostics, Observer, Outcome, Stop, Trouble, simulate};

/// Keeps the rows about the points.
#[derive(Default)]
struct Watch(Vec<Row>);

impl Observer for Watch {
    fn report(&mut self, _: &Diagnostics) {}

    fn moved(&mut self, row: &Row) {
        self.0.push(row.clone());
    }

    fn stop_requested(&self) -> bool {
        false
    }
}

fn run(name: &str, overrides: &[&str]) -> (Scene, Outcome, Vec<Row>) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(name);
    let overrides: Vec<String> = overrides.iter().map(|&given| given.to_owned()).collect();
    let case = Case::load(&path, &overrides).expect("a shipped case");
    let scene = Scene::build(&case).expect("a scene");
    let shared = Arc::new(scene.clone());
    let mut watch = Watch::default();
    let outcome = simulate(&shared, cpu::double(&shared).expect("an engine").as_mut(), &mut watch).expect("a run");
    (scene, outcome, watch.0)
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
