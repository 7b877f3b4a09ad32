//! Whole runs: how they end, what they leave, and which steps they take.

use std::sync::Arc;

use glam::DVec2;
use stillpoint::case::Case;
use stillpoint::cpu;
use stillpoint::engine::{Advance, Data};
use stillpoint::scene::Scene;
use stillpoint::simulation::{Diagnostics, Observer, Outcome, SimulationError, Stop, Trouble, simulate};
use stillpoint::step::Buffer;

use crate::bench::most;
use crate::cases::{cavity, cavity_of};
use crate::spoiled::Spoiled;

/// Keeps the rows; asks for an end after so many.
struct Watch {
    rows: Vec<Diagnostics>,
    enough: usize,
}

impl Observer for Watch {
    fn report(&mut self, row: &Diagnostics) {
        self.rows.push(row.clone());
    }

    fn stop_requested(&self) -> bool {
        self.rows.len() >= self.enough
    }
}

fn watched(case: &Case, enough: usize) -> (Outcome, Vec<Diagnostics>) {
    let scene = Arc::new(Scene::build(case).expect("a scene"));
    let mut engine = cpu::double(&scene).expect("an engine");
    let mut watch = Watch { rows: Vec::new(), enough };
    let outcome = simulate(&scene, engine.as_mut(), &mut watch).expect("a run");
    (outcome, watch.rows)
}

fn run(case: &Case) -> (Outcome, Vec<Diagnostics>) {
    watched(case, usize::MAX)
}

#[test]
fn a_number_that_is_none_stops_the_run_names_its_place_and_keeps_the_last_good_state() {
    for splitting in ["time.splitting=reflection", "time.splitting=projection"] {
        for pressure in ["conservative", "collocated", "none"] {
            let mut case = cavity(&[splitting, "output.report_every=25", "time.end=20.0", "guard.retries=0"]);
            match (pressure, &mut case.effects.pressure) {
                ("none", absent) => *absent = None,
                ("collocated", Some(pressure)) => {
                    (pressure.form, pressure.solver) = (Some(stillpoint::case::PressureForm::Collocated), None);
                }
                _ => {}
            }
            let name = format!("{splitting}, pressure {pressure}");
            let scene = Arc::new(Scene::build(&case).expect("a scene"));
            let inner = cpu::double(&scene).expect("an engine");
            let mut engine = Spoiled::new(inner, scene.plan.moving(), 123, 60);
            let mut watch = Watch { rows: Vec::new(), enough: usize::MAX };
            let outcome = simulate(&scene, &mut engine, &mut watch).unwrap_or_else(|error| panic!("{name}: {error}"));
            let Stop::Trouble { trouble: Trouble::NonFinite { field, place }, step } = outcome.stop else {
                panic!("{name}: {:?}", outcome.stop)
            };
            // Spoiled at the beginning of the advance that holds step 60, after the row of step 50.
            assert!((51..=85).contains(&step) && step == outcome.steps, "{name}: step {step}");
            assert!([Buffer::Projected, Buffer::Pressure].contains(&field.buffer), "{name}: {field:?}");
            assert_eq!(place, scene.cloud.position[field.point], "{name}");
            let last = watch.rows.last().expect("a row");
            assert_eq!((watch.rows.len(), last.step, last.time), (2, 50, outcome.snapshot.time), "{name}");
            let snapshot = &outcome.snapshot;
            assert!(snapshot.velocity.iter().all(|u| u.is_finite()), "{name}");
            assert!(snapshot.pressure.iter().all(|p| p.is_finite()), "{name}");
            assert!(snapshot.velocity.iter().any(|u| u.length() > 0.1), "{name}: the state of row 50, not of rest");
        }
    }
}

#[test]
fn an_engine_sees_a_number_that_is_none_within_ten_steps() {
    let mut case = cavity(&[]);
    case.effects.pressure = None;
    let scene = Arc::new(Scene::build(&case).expect("a scene"));
    let mut engine = cpu::double(&scene).expect("an engine");
    let clock = scene.clock(0.01);
    scene.plan.setup.iter().for_each(|&operation| engine.apply(operation, &clock).expect("an operation"));
    assert_eq!(engine.advance(100, &clock).expect("steps"), Advance { steps: 100, ..Advance::default() });
    let Data::Real(mut values) = engine.read(scene.plan.moving()).expect("a velocity") else { panic!("floats") };
    values[2 * 123 + 1] = f64::INFINITY;
    engine.write(scene.plan.moving(), &Data::Real(values)).expect("a velocity");
    let advance = engine.advance(100, &clock).expect("steps");
    assert!(advance.steps <= 10, "{advance:?}");
    assert_eq!(advance.trouble.map(|field| field.buffer), Some(Buffer::Projected));
}

#[test]
fn a_steady_flow_stops_after_two_steady_rows_and_an_unsteady_one_at_its_end() {
    let steady = 1e-2;
    let base = ["time.end=30.0", "output.report_every=10"];
    let (outcome, rows) = run(&cavity_of(16, &[&base[..], &["time.steady=1e-2"]].concat()));
    assert_eq!(outcome.stop, Stop::Steady);
    let slow: Vec<bool> = rows.iter().map(|row| row.change < steady).collect();
    assert!(slow.ends_with(&[true, true]), "{slow:?}");
    assert!(!slow[..slow.len() - 1].windows(2).any(|pair| pair == [true, true]), "{slow:?}");
    assert!(outcome.snapshot.time < 20.0 && outcome.snapshot.time > 1.0, "{}", outcome.snapshot.time);
    let (outcome, _) = run(&cavity_of(16, &["time.end=1.0", "time.steady=1e-2"]));
    assert_eq!(outcome.stop, Stop::End);
}

#[test]
fn the_end_is_reached_exactly_with_equal_steps() {
    for (end, step) in [("0.37", None), ("1.0", Some("time.step=0.03")), ("0.01", Some("time.step=0.01"))] {
        let end_key = format!("time.end={end}");
        let keys: Vec<&str> = [end_key.as_str(), "output.report_every=7"].into_iter().chain(step).collect();
        let (outcome, rows) = run(&cavity(&keys));
        let end: f64 = end.parse().expect("a number");
        assert_eq!(outcome.stop, Stop::End);
        assert!((outcome.snapshot.time - end).abs() <= 1e-12 * end, "{} s of {end} s", outcome.snapshot.time);
        let last = rows.last().expect("a row");
        assert_eq!((last.time, last.step), (outcome.snapshot.time, outcome.steps));
        assert!(rows.windows(2).all(|pair| pair[1].step - pair[0].step == 7 || pair[1].step == outcome.steps));
        let time: f64 = rows
            .iter()
            .scan(0, |before, row| {
                let steps = row.step - std::mem::replace(before, row.step);
                Some(steps as f64 * row.dt)
            })
            .sum();
        assert!((time - end).abs() < 1e-12, "steps times dt: {time}");
    }
}

#[test]
fn an_interrupted_run_is_complete_up_to_where_it_was_stopped() {
    for (enough, rows_expected) in [(0, 1), (1, 1), (3, 3)] {
        let case = cavity(&["output.report_every=5"]);
        let (outcome, rows) = watched(&case, enough);
        assert_eq!((&outcome.stop, rows.len()), (&Stop::Interrupted, rows_expected));
        let last = rows.last().expect("a row");
        assert_eq!((last.step, last.time), (outcome.steps, outcome.snapshot.time));
        assert!(outcome.steps > 0 && outcome.steps <= 5 * rows_expected as u64);
        let snapshot = &outcome.snapshot;
        let points = snapshot.position.len();
        assert_eq!((snapshot.velocity.len(), snapshot.pressure.len()), (points, points));
        assert!(snapshot.velocity.iter().all(|u| u.is_finite()) && snapshot.time < 1.0);
    }
}

#[test]
fn a_step_above_the_viscous_limit_warns_and_one_below_does_not() {
    let warned = |step: &str| {
        run(&cavity(&[step, "time.end=0.2", "cloud.arrangement=jittered", "effects.viscosity.kinematic=0.05"]))
            .0
            .warnings
    };
    assert_eq!(warned("time.step=0.002"), Vec::<String>::new());
    let warnings = warned("time.step=0.05");
    assert!(
        matches!(&warnings[..], [one] if one.starts_with("time.step = 5e-2 s is above the stability limit of the viscosity, ")),
        "{warnings:?}"
    );
}

/// The lid drags the fluid along, without pressure or advection: diffusion alone, which nothing but dt can upset.
#[test]
fn the_chosen_step_is_stable_and_one_three_times_as_long_is_not() {
    for splitting in ["time.splitting=reflection", "time.splitting=projection"] {
        for arrangement in ["cloud.arrangement=jittered", "cloud.arrangement=regular"] {
            let base = ["time.end=20.0", "effects.viscosity.kinematic=0.05", "guard.retries=0"];
            let mut case = cavity(&[&base[..], &[splitting, arrangement]].concat());
            case.effects.pressure = None;
            case.effects.advection = None;
            let (stable, rows) = run(&case);
            let most = stable.snapshot.velocity.iter().map(|u| u.length()).fold(0.0, most);
            assert!(most <= 1.001, "{splitting}, {arrangement}: {most} m/s");
            case.time.step = Some(3.0 * rows[0].dt);
            let (unstable, _) = run(&case);
            let grown =
                !matches!(unstable.stop, Stop::End) || unstable.snapshot.velocity.iter().any(|u| u.length() > 10.0);
            assert!(grown, "{splitting}, {arrangement}: the limit is no limit");
            assert_eq!(unstable.warnings.len(), 1);
        }
    }
}

/// Each row's steps are chosen from the speeds known when they begin: the lid's, and the last row's.
#[test]
fn the_courant_number_bounds_the_displacement_of_a_step() {
    for courant in [0.3, 0.8] {
        let key = format!("time.courant={courant}");
        let (_, rows) = run(&cavity(&[&key, "time.end=4.0", "effects.viscosity.kinematic=0.001"]));
        let before = std::iter::once(1.0).chain(rows.iter().map(|row| row.max_speed.max(1.0)));
        let displacements = rows.iter().zip(before).map(|(row, speed)| row.dt * speed / 0.05);
        // Above it by rounding alone; below it by what makes the number of steps whole.
        let (least, most) = displacements.fold((f64::INFINITY, 0.0), |(a, b), d| (d.min(a), d.max(b)));
        assert!(most <= courant * (1.0 + 1e-9) && least > 0.7 * courant && most > 0.95 * courant, "{least} {most}");
    }
}

#[test]
fn points_too_fast_for_the_forward_remap_are_an_error() {
    let case = cavity(&["effects.advection.remap=forward", "time.step=0.1"]);
    let scene = Arc::new(Scene::build(&case).expect("a scene"));
    let mut engine = cpu::double(&scene).expect("an engine");
    let error = simulate(&scene, engine.as_mut(), &mut ()).expect_err("two spacings a step");
    assert!(
        matches!(error, SimulationError::TooFastForForward { courant, .. } if (courant - 2.0).abs() < 1e-9),
        "{error}"
    );
}

#[test]
fn the_row_of_a_run_measures_its_snapshot() {
    let (outcome, rows) = run(&cavity(&["cloud.arrangement=jittered"]));
    let last = rows.last().expect("a row");
    let cloud = stillpoint::cloud::Cloud::build(&cavity(&["cloud.arrangement=jittered"])).expect("a cloud");
    let cells = stillpoint::cloud::voronoi::Cells::build(&cloud);
    let velocity = &outcome.snapshot.velocity;
    let energy: f64 = velocity.iter().zip(&cells.volume).map(|(u, v)| 0.5 * v * u.length_squared()).sum();
    assert!((last.kinetic_energy - energy).abs() < 1e-13, "{} {energy}", last.kinetic_energy);
    assert_eq!(last.max_speed, velocity.iter().map(|u| u.x.hypot(u.y)).fold(0.0, most));
    let flux = |i: usize| {
        let of =
            |(j, w): (usize, f64)| 0.5 * w * (cloud.position[j] - cloud.position[i]).dot(velocity[i] + velocity[j]);
        cells.faces(i).map(of).sum::<f64>() / cells.volume[i]
    };
    let rms = ((0..cloud.len()).map(|i| flux(i).powi(2)).sum::<f64>() / cloud.len() as f64).sqrt();
    assert!((last.divergence - rms).abs() < 1e-9 * rms, "{} {rms}", last.divergence);
    assert!(velocity[cloud.interior..].contains(&DVec2::X), "the lid moves");
}
