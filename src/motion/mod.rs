//! What is measured of points that move: how evenly they stand, where the fluid is, what energy it has, what is lost.

mod area;
mod near;

use std::collections::BTreeSet;

use glam::DVec2;
use serde::{Deserialize, Serialize};

use crate::engine::Data;
use crate::scene::Scene;
use crate::step::{Buffer, Points};
use near::Near;

/// One row of `motion.csv`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Row {
    pub step: u64,
    /// s
    pub time: f64,
    /// `sum V |u|^2 / 2`, m^4/s^2.
    pub kinetic_energy: f64,
    /// `-sum V g . x`, m^4/s^2.
    pub potential_energy: f64,
    /// Least, mean and largest distance of a point to the one nearest to it, in spacings.
    pub nearest: [f64; 3],
    /// Largest x of the fluid, m: droplets apart.
    pub front: f64,
    /// Largest y of the fluid beside the left wall, m.
    pub column: f64,
    /// Area that the fluid covers over that at the start.
    pub area: f64,
    /// Points on the free surface.
    pub surface: u64,
    /// Points whose fit was lowered.
    pub lowered: u64,
    /// Points that have left the domain.
    pub lost: u64,
    /// Pushes of the pressure that were bounded since the beginning, of all points.
    pub bounded: u64,
    /// Which these are, and where: not in `motion.csv`.
    pub outside: Vec<Lost>,
    /// Pressure at each sensor, in the order of their names, Pa.
    pub sensors: Vec<f64>,
}

/// A point outside the domain.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Lost {
    /// Its place in the list of points, from 0: the row of `points.csv` and of every frame.
    pub point: usize,
    /// m
    pub place: [f64; 2],
}

/// The fluid's points at one instant, of the arrays that an engine holds.
pub struct State<'a> {
    /// m; of the fluid's points, and of the walls' points behind them that have a pressure.
    position: &'a [[f64; 2]],
    pressured: &'a [[f64; 2]],
    /// m/s
    velocity: &'a [[f64; 2]],
    /// Of `pressured`, Pa.
    pressure: &'a [f64],
    /// 1 at the free surface.
    surface: &'a [u32],
    rung: &'a [u32],
    /// In how many steps each push was bounded.
    bounded: &'a [u32],
}

/// The arrays that are looked at beside those of a run's state, empty: of the points at the surface, and of those whose fit was
/// lowered.
pub fn flags(scene: &Scene) -> Vec<(Buffer, Data)> {
    let planned = scene.plan.buffers();
    let flags = [Buffer::Surface, Buffer::Rung(Points::Standing)].into_iter().filter(|flag| planned.contains(flag));
    flags.map(|flag| (flag, Data::empty(flag.element()))).collect()
}

impl<'a> State<'a> {
    /// Of the arrays of a run's state and its [`flags`]; what the scene's plan lacks counts as empty.
    pub fn new(scene: &Scene, state: &'a [(Buffer, Data)], flags: &'a [(Buffer, Data)]) -> Self {
        let array = |buffer| state.iter().chain(flags).find(|(known, _)| *known == buffer).map(|(_, data)| data);
        let (fluid, pressured) = (scene.sizes.interior, scene.sizes.pressured);
        let reals = |buffer| match array(buffer) {
            Some(Data::Real(values)) => values.as_slice(),
            _ => &[],
        };
        let flags = |buffer| match array(buffer) {
            Some(Data::Index(values)) => &values[..fluid.min(values.len())],
            _ => &[],
        };
        let [position, velocity] =
            [Buffer::Position(Points::Standing), Buffer::Projected].map(|b| reals(b).as_chunks().0);
        let pressure = reals(Buffer::Pressure);
        Self {
            position: &position[..fluid],
            pressured: &position[..pressured],
            velocity: &velocity[..fluid],
            pressure: &pressure[..pressured.min(pressure.len())],
            surface: flags(Buffer::Surface),
            rung: flags(Buffer::Rung(Points::Standing)),
            bounded: flags(Buffer::Bounded),
        }
    }
}

/// Distance within which points belong to one body of fluid, in spacings.
const JOINED: f64 = 1.5;
/// Radius within which a sensor takes the pressure, in spacings.
const SENSOR: f64 = 2.0;

/// What a motion is judged by.
pub struct Watched {
    /// As in [`Row`].
    pub kinetic_energy: f64,
    pub potential_energy: f64,
    pub nearest: [f64; 3],
    pub outside: Vec<Lost>,
    /// The places in the domain, m, and how near they are to each other.
    inside: Vec<DVec2>,
    near: Near,
}

/// Looks at a state for what it is judged by.
pub fn watch(scene: &Scene, state: &State) -> Watched {
    let spacing = scene.constants.spacing;
    let [kinetic_energy, potential_energy] = energies(scene, state);
    let (inside, outside) = parted(scene, state.position);
    let near = Near::new(&inside, scene.constants.size, JOINED * spacing);
    Watched { kinetic_energy, potential_energy, nearest: near.nearest(spacing), outside, inside, near }
}

/// The area that the fluid covers, m^2.
pub fn covered(scene: &Scene, watched: &Watched) -> f64 {
    area::covered(&watched.inside, scene.constants.size, scene.constants.spacing)
}

/// Measures the rest of a state. `area` is the covered area at the start, m^2.
pub fn measure(scene: &Scene, state: &State, watched: Watched, step: u64, time: f64, area: f64) -> Row {
    let area = covered(scene, &watched) / area;
    let Watched { kinetic_energy, potential_energy, nearest, outside, mut near, .. } = watched;
    let spacing = scene.constants.spacing;
    let body = near.largest_bodies();
    let reach = |points: &mut dyn Iterator<Item = f64>| points.fold(0.0, f64::max);
    Row {
        step,
        time,
        kinetic_energy,
        potential_energy,
        nearest,
        front: reach(&mut body.iter().map(|place| place.x)),
        column: reach(&mut body.iter().filter(|place| place.x < 2.0 * spacing).map(|place| place.y)),
        area,
        surface: state.surface.iter().map(|&flag| u64::from(flag)).sum(),
        lowered: state.rung.iter().filter(|&&rung| rung != 0).count() as u64,
        lost: outside.len() as u64,
        bounded: state.bounded.iter().map(|&steps| u64::from(steps)).sum(),
        outside,
        sensors: scene.case.output.sensors.values().map(|sensor| pressure_at(scene, state, sensor.at.into())).collect(),
    }
}

/// Kinetic and potential, m^4/s^2.
fn energies(scene: &Scene, state: &State) -> [f64; 2] {
    let (volume, gravity) = (scene.cloud.filled.unwrap_or(0.0), scene.constants.gravity);
    let squares = state.velocity.iter().map(|&u| DVec2::from(u).length_squared());
    let heights = state.position.iter().map(|&place| gravity.dot(place.into()));
    [0.5 * volume * squares.sum::<f64>(), -volume * heights.sum::<f64>()]
}

/// The places in the domain, and the points outside it, each in their order.
fn parted(scene: &Scene, position: &[[f64; 2]]) -> (Vec<DVec2>, Vec<Lost>) {
    let (mut inside, mut outside) = (Vec::with_capacity(position.len()), Vec::new());
    for (point, &place) in position.iter().enumerate() {
        match lost(scene, place.into()) {
            true => outside.push(Lost { point, place }),
            false => inside.push(place.into()),
        }
    }
    (inside, outside)
}

/// A line about the points that were lost over these rows, each when it was first seen outside; none where none was.
pub fn losses(rows: &[Row]) -> Option<String> {
    let mut seen = BTreeSet::new();
    let each = rows.iter().flat_map(|row| row.outside.iter().map(move |lost| (row.step, lost.point)));
    let new: Vec<(u64, usize)> = each.filter(|&(_, point)| seen.insert(point)).collect();
    let (step, point) = new.first()?;
    let first = format!("point {point}, seen outside after step {step}");
    Some(match new.len() {
        1 => format!("a point left the domain: {first}; lost.csv has its time and place"),
        count => format!(
            "{count} points left the domain, the first of them {first}; lost.csv has each with its time and place"
        ),
    })
}

/// True of a point outside the domain.
pub fn lost(scene: &Scene, place: DVec2) -> bool {
    let size = scene.constants.size;
    !(place.x >= 0.0 && place.y >= 0.0 && place.x <= size.x && place.y <= size.y)
}

/// The mean over the points around a place, each pressure brought to it as in a fluid at rest, Pa; 0 where there are none.
fn pressure_at(scene: &Scene, state: &State, place: DVec2) -> f64 {
    let radius = SENSOR * scene.constants.spacing;
    let weight_density = scene.constants.density * scene.constants.gravity;
    let (mut sum, mut weights) = (0.0, 0.0);
    for (&there, &pressure) in state.pressured.iter().zip(state.pressure) {
        let way = place - DVec2::from(there);
        let rest = 1.0 - way.length_squared() / (radius * radius);
        if rest > 0.0 {
            sum += rest * rest * (pressure + weight_density.dot(way));
            weights += rest * rest;
        }
    }
    if weights > 0.0 { sum / weights } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_lost_point_is_told_of_once() {
        let row = |step: u64, points: &[usize]| {
            let outside = points.iter().map(|&point| Lost { point, place: [-0.5, 2.0] }).collect();
            Row { step, outside, ..Row::default() }
        };
        assert_eq!(losses(&[row(0, &[]), row(1, &[])]), None);
        let one = losses(&[row(0, &[]), row(5, &[7]), row(10, &[7])]);
        let told = "a point left the domain: point 7, seen outside after step 5; lost.csv has its time and place";
        assert_eq!(one.as_deref(), Some(told));
        let three = losses(&[row(5, &[7]), row(10, &[3, 7, 9]), row(15, &[3])]).expect("a line");
        assert!(three.starts_with("3 points left the domain, the first of them point 7, seen"), "{three}");
    }
}
