//! Hard cases of points that move: columns of water that collapse, fluid whose surface is all around it, spray.

use std::sync::Arc;

use glam::DVec2;
use stillpoint::case::Case;
use stillpoint::cloud::Cloud;
use stillpoint::cpu;
use stillpoint::engine::Engine;
use stillpoint::motion;
use stillpoint::scene::Scene;
use stillpoint::simulation::{Stop, simulate};

use crate::columns::{MPS, column};
use crate::flow::{Flow, Open};
use crate::random::Random;
use crate::rows::Rows;
use crate::spoiled::Spoiled;
use crate::table::{Promise, Row};

/// What the watch allows, over the energy at the start.
const MOST_ENERGY: f64 = 1.05;

/// A run, and what was measured of its points.
pub struct Moved {
    flow: Flow,
    rows: Vec<motion::Row>,
}

pub fn scene(case: &Case, cloud: Option<Cloud>) -> Result<Arc<Scene>, String> {
    let scene = match cloud {
        Some(cloud) => Scene::with_cloud(case, cloud),
        None => Scene::build(case),
    };
    scene.map(Arc::new).map_err(|error| error.to_string())
}

pub fn moved_on(scene: &Arc<Scene>, engine: &mut dyn Engine) -> Result<Moved, String> {
    let mut rows = Rows::default();
    let outcome = simulate(scene, engine, &mut rows).map_err(|error| error.to_string())?;
    Ok(Moved { flow: Flow { scene: Arc::clone(scene), outcome, rows: rows.rows }, rows: rows.moved })
}

pub fn moved(case: &Case, cloud: Option<Cloud>, open: Open) -> Result<Moved, String> {
    let scene = scene(case, cloud)?;
    let mut engine = open(&scene).map_err(|error| error.to_string())?;
    moved_on(&scene, engine.as_mut())
}

impl Moved {
    /// The most energy, over that at the start.
    fn energy(&self) -> f64 {
        let energy = |row: &motion::Row| row.kinetic_energy + row.potential_energy;
        let first = self.rows.first().map_or(f64::NAN, energy);
        self.rows.iter().map(energy).fold(0.0, f64::max) / first
    }

    fn lost(&self) -> u64 {
        self.rows.last().map_or(0, |row| row.lost)
    }

    fn is_finite(&self) -> bool {
        let figures = |row: &motion::Row| {
            [row.kinetic_energy, row.potential_energy, row.front, row.column, row.area, row.nearest[0]]
        };
        self.flow.is_finite()
            && self.flow.outcome.snapshot.position.iter().all(|place| place.is_finite())
            && self.rows.iter().flat_map(figures).all(f64::is_finite)
    }
}

/// What is promised of a motion.
#[derive(Clone, Copy, PartialEq)]
pub enum Kept {
    /// It runs to its end, its energy never above what the watch allows, and no point leaves.
    Bounded,
    /// The same, but for so many points that leave and are counted.
    AllBut(u64),
    /// The same, or it stops and says why.
    OrFlagged,
}

pub fn kept(case: impl Into<String>, promise: Kept, run: &Result<Moved, String>) -> Row {
    let bounded = format!("energy at most {MOST_ENERGY} of the first");
    let most = if let Kept::AllBut(most) = promise { most } else { 0 };
    let words = match promise {
        Kept::Bounded => format!("{bounded}, no point lost"),
        Kept::AllBut(_) => format!("{bounded}, at most {most} points lost, and counted"),
        Kept::OrFlagged => format!("{bounded}, no point lost; or stops, says why, keeps its last good state"),
    };
    match run {
        Err(said) => Row::new(case, words, said.clone(), false),
        Ok(run) if run.flow.ended() => {
            let (energy, lost) = (run.energy(), run.lost());
            let nearest = run.rows.iter().map(|row| row.nearest[0]).fold(f64::INFINITY, f64::min);
            let measured = format!("energy {energy:.3}, nearest two {nearest:.1e} spacings, {lost} lost");
            Row::new(case, words, measured, energy <= MOST_ENERGY && lost <= most && run.is_finite())
        }
        Ok(run) => {
            let stopped = matches!(run.flow.outcome.stop, Stop::Trouble { .. });
            Row::new(case, words, run.flow.end(), promise == Kept::OrFlagged && stopped && run.is_finite())
        }
    }
}

/// Other promises, as of any flow.
pub fn promised(case: impl Into<String>, promise: Promise, run: Result<Moved, String>) -> Row {
    let finite = run.as_ref().map_or(true, Moved::is_finite);
    Row::of_flow(case, promise, &run.map(|run| run.flow), None).and(finite)
}

/// With other fluid points; the walls stay.
fn changed(case: &Case, change: impl FnOnce(&mut Vec<DVec2>)) -> Cloud {
    let mut cloud = Cloud::build(case).expect("a cloud");
    let (walls, pressured) = (cloud.position.split_off(cloud.interior), cloud.pressured - cloud.interior);
    change(&mut cloud.position);
    cloud.interior = cloud.position.len();
    cloud.pressured = cloud.interior + pressured;
    cloud.position.extend(walls);
    cloud
}

/// The point nearest to the middle of the column has another so many spacings away.
pub fn doubled(case: &Case, spacings: f64) -> Cloud {
    changed(case, |position| {
        let off = |place: &DVec2| (*place - DVec2::new(0.04, 0.06)).length();
        let middle = position.iter().copied().min_by(|a, b| off(a).total_cmp(&off(b))).expect("a point");
        position.push(middle + spacings * 0.01 * DVec2::new(0.8, 0.6));
    })
}

/// Points alone in the air beside the column and above it, at least two spacings from everything.
fn spray(case: &Case) -> Cloud {
    let mut random = Random::new(8);
    changed(case, |position| {
        let column = position.len();
        while position.len() < column + 20 {
            let place = DVec2::new(0.15 + 0.13 * random.number(), 0.1 + 0.08 * random.number());
            if position.iter().all(|other| (*other - place).length() > 0.02) {
                position.push(place);
            }
        }
    })
}

/// An error of a fall against what is promised of it.
fn falls(case: impl Into<String>, most: f64, run: &Result<Moved, String>) -> Row {
    match run {
        Err(said) => Row::new(case, "", said.clone(), false),
        Ok(run) if !run.flow.ended() => Row::new(case, "", run.flow.end(), false),
        Ok(run) => {
            let snapshot = &run.flow.outcome.snapshot;
            let expected = run.flow.scene.constants.gravity * snapshot.time;
            let off = snapshot.velocity.iter().map(|u| (*u - expected).length()).fold(0.0, f64::max);
            Row::of_error(case, most, off / expected.length())
        }
    }
}

const JITTERED: &str = "cloud.arrangement=jittered";
/// A square of 8 spacings in the air.
const SQUARE: [&str; 2] = ["cloud.fill={ from = [0.1, 0.1], to = [0.18, 0.18] }", "time.end=0.08"];

pub fn rows() -> Vec<Row> {
    let mut rows = Vec::new();
    for (name, changes) in [("shifted", &[][..]), ("MPS", MPS)] {
        let mps = name == "MPS";
        // What bounces takes up as shifted points is thrown apart by the density of MPS.
        let rough = if mps { Kept::OrFlagged } else { Kept::Bounded };
        let of = |more: &[&str]| column(&[changes, more].concat());
        let plain = of(&["time.end=0.3"]);
        let mut on = |what: &str, promise: Kept, case: &Case, cloud: Option<Cloud>| {
            rows.push(kept(format!("{name}: {what}"), promise, &moved(case, cloud, cpu::double)));
        };
        on("two points 0.5 spacings apart", Kept::Bounded, &plain, Some(doubled(&plain, 0.5)));
        for apart in [0.1, 1e-3, 1e-7] {
            on(&format!("two points {apart:e} spacings apart"), rough, &plain, Some(doubled(&plain, apart)));
        }
        let pools = of(&["time.end=0.3", "cloud.fill.to=[0.3, 0.1]"]);
        let apart = changed(&pools, |position| position.retain(|place| (place.x - 0.15).abs() > 0.09));
        on("two pools that collapse into each other", Kept::Bounded, &pools, Some(apart));
        on("20 drops of one point", if mps { Kept::AllBut(2) } else { Kept::Bounded }, &plain, Some(spray(&plain)));
        on("a film of 4 spacings at rest", Kept::Bounded, &of(&["time.end=0.2", "cloud.fill.to=[0.3, 0.04]"]), None);
        on("jitter 0.2", Kept::Bounded, &of(&["time.end=0.2", JITTERED, "cloud.jitter=0.2"]), None);
        on("jitter 0.45", rough, &of(&["time.end=0.2", JITTERED, "cloud.jitter=0.45"]), None);
        let long = of(&["time.end=0.3", "time.step=0.1"]);
        on("steps in which a point falls 5 spacings", Kept::OrFlagged, &long, None);
        rows.push(kept(format!("{name}: a column in f32"), Kept::Bounded, &moved(&plain, None, cpu::single)));
        let run = moved(&plain, Some(doubled(&plain, 0.0)), cpu::double);
        rows.push(promised(format!("{name}: the same point twice"), Promise::Refused("coincide"), run));
        let (square, all_around) = (of(&SQUARE), "a square that falls freely, pressure 0 all around");
        rows.push(falls(format!("{name}: {all_around}"), 1e-3, &moved(&square, None, cpu::double)));
        let drop = changed(&square, |position| position.truncate(1));
        rows.push(falls(format!("{name}: one point that falls"), 1e-6, &moved(&square, Some(drop), cpu::double)));
        let plain = of(&["time.end=0.15"]);
        let scene = scene(&plain, None).expect("a scene");
        let mut spoiled = Spoiled::new(cpu::double(&scene).expect("an engine"), scene.plan.moving(), 7, 20);
        rows.push(promised(
            format!("{name}: a velocity of NaN, once"),
            Promise::Mended,
            moved_on(&scene, &mut spoiled),
        ));
        for (unit, metres) in [("nanometres", 1e-9), ("kilometres", 1e3)] {
            // On a lattice rounding decides between equals.
            let error = scaled(&of(&["time.end=0.05", JITTERED, "cloud.jitter=0.1"]), metres);
            rows.push(Row::of_error(format!("{name}: a column in {unit}, against metres"), 1e-9, error));
        }
    }
    let paper = column(&["effects.advection.motion=lagrangian", "time.end=0.6"]);
    rows.push(promised("the paper's form, to 0.6 s", Promise::Flagged, moved(&paper, None, cpu::double)));
    rows
}

/// How far front and energy of a column are from those in metres.
fn scaled(case: &Case, metres: f64) -> f64 {
    let one = moved(case, None, cpu::double);
    let mut case = case.clone();
    for length in [&mut case.domain.width, &mut case.domain.height, &mut case.cloud.spacing] {
        *length *= metres;
    }
    if let Some(fill) = &mut case.cloud.fill {
        fill.from.iter_mut().chain(&mut fill.to).for_each(|length| *length *= metres);
    }
    if let Some(gravity) = &mut case.effects.gravity {
        gravity.acceleration.iter_mut().for_each(|acceleration| *acceleration *= metres);
    }
    case.output.sensors.clear();
    match (one, moved(&case, None, cpu::double)) {
        (Ok(one), Ok(other)) if other.flow.ended() => {
            let pairs = one.rows.iter().zip(&other.rows);
            let off = |(a, b): (&motion::Row, &motion::Row)| {
                let front = b.front / metres / a.front - 1.0;
                front.abs().max((b.potential_energy / metres.powi(4) / a.potential_energy - 1.0).abs())
            };
            pairs.map(off).fold(0.0, f64::max)
        }
        _ => f64::NAN,
    }
}
