//! What is measured of points that move: how evenly they stand, where the fluid is, what energy it has, what is lost.

use std::collections::BTreeSet;

use glam::DVec2;
use serde::{Deserialize, Serialize};

use crate::cloud::grid::Grid;
use crate::scene::Scene;

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

/// The fluid's points at one instant.
pub struct State<'a> {
    pub position: &'a [DVec2],
    pub velocity: &'a [DVec2],
    /// Of these, and of the walls' points behind them, with their places.
    pub pressure: &'a [f64],
    pub pressured: &'a [DVec2],
    /// 1 at the free surface.
    pub surface: &'a [u32],
    pub rung: &'a [u32],
}

/// Distance within which points belong to one body of fluid, in spacings.
const JOINED: f64 = 1.5;
/// Points of a body below which it is a droplet.
const DROPLET: usize = 12;
/// Radius of the disc that a point covers, and side of the squares that are counted, in spacings.
const DISC: f64 = 0.8;
const SQUARE: f64 = 0.25;
/// Radius within which a sensor takes the pressure, in spacings.
const SENSOR: f64 = 2.0;

/// Measures a state. `area` is the covered area at the start, m^2; 0 makes it that of this state.
pub fn measure(scene: &Scene, state: &State, step: u64, time: f64, start: &mut f64) -> Row {
    let (spacing, size) = (scene.constants.spacing, scene.constants.size);
    let volume = scene.cloud.filled.unwrap_or(0.0);
    let inside: Vec<DVec2> = state.position.iter().copied().filter(|place| !lost(scene, *place)).collect();
    let grid = Grid::new(&inside, size, DVec2::ZERO, JOINED * spacing);
    let nearest = |point: usize| {
        let near = (0..=1).flat_map(|ring| grid.ring(inside[point], ring)).filter(|&other| other != point);
        near.map(|other| (inside[other] - inside[point]).length()).fold(f64::INFINITY, f64::min)
    };
    let near: Vec<f64> = (0..inside.len()).map(nearest).filter(|d| d.is_finite()).map(|d| d / spacing).collect();
    let fold = |start: f64, f: fn(f64, f64) -> f64| near.iter().copied().fold(start, f);
    let mean = near.iter().sum::<f64>() / near.len().max(1) as f64;
    let nearest = if near.is_empty() { [0.0; 3] } else { [fold(f64::INFINITY, f64::min), mean, fold(0.0, f64::max)] };
    let body = largest_bodies(&inside, &grid, JOINED * spacing);
    let reach = |points: &mut dyn Iterator<Item = f64>| points.fold(0.0, f64::max);
    let covered = area(&inside, size, spacing);
    if *start == 0.0 {
        *start = covered;
    }
    let gravity = scene.constants.gravity;
    Row {
        step,
        time,
        kinetic_energy: 0.5 * volume * state.velocity.iter().map(|u| u.length_squared()).sum::<f64>(),
        potential_energy: -volume * state.position.iter().map(|place| gravity.dot(*place)).sum::<f64>(),
        nearest,
        front: reach(&mut body.iter().map(|&point| inside[point].x)),
        column: reach(&mut body.iter().map(|&point| inside[point]).filter(|at| at.x < 2.0 * spacing).map(|at| at.y)),
        area: covered / *start,
        surface: state.surface.iter().map(|&flag| u64::from(flag)).sum(),
        lowered: state.rung.iter().filter(|&&rung| rung != 0).count() as u64,
        lost: (state.position.len() - inside.len()) as u64,
        outside: outside(scene, state.position),
        sensors: scene.case.output.sensors.values().map(|sensor| pressure_at(scene, state, sensor.at.into())).collect(),
    }
}

/// Every point outside the domain, in their order.
fn outside(scene: &Scene, position: &[DVec2]) -> Vec<Lost> {
    let all = position.iter().enumerate().filter(|(_, place)| lost(scene, **place));
    all.map(|(point, place)| Lost { point, place: place.to_array() }).collect()
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

/// The points of every connected body of fluid that is no droplet; of the largest where all are.
fn largest_bodies(position: &[DVec2], grid: &Grid, joined: f64) -> Vec<usize> {
    let mut body = vec![usize::MAX; position.len()];
    let mut members: Vec<Vec<usize>> = Vec::new();
    for seed in 0..position.len() {
        if body[seed] != usize::MAX {
            continue;
        }
        let (number, mut found) = (members.len(), vec![seed]);
        body[seed] = number;
        let mut next = 0;
        while next < found.len() {
            let here = position[found[next]];
            next += 1;
            for other in (0..=1).flat_map(|ring| grid.ring(here, ring)) {
                if body[other] == usize::MAX && (position[other] - here).length_squared() < joined * joined {
                    body[other] = number;
                    found.push(other);
                }
            }
        }
        members.push(found);
    }
    let most = members.iter().map(Vec::len).max().unwrap_or(0);
    members.into_iter().filter(|body| body.len() >= DROPLET.min(most)).flatten().collect()
}

/// Area of the union of discs about the points, by counting squares, m^2.
fn area(position: &[DVec2], size: DVec2, spacing: f64) -> f64 {
    let square = SQUARE * spacing;
    let [columns, rows] = [size.x, size.y].map(|length| (length / square).ceil() as usize);
    let mut covered = vec![false; columns * rows];
    let reach = (DISC / SQUARE).ceil() as i64;
    for place in position {
        let at = (*place / square).floor();
        for (i, j) in (-reach..=reach).flat_map(|j| (-reach..=reach).map(move |i| (i, j))) {
            let (column, row) = (at.x as i64 + i, at.y as i64 + j);
            let middle = square * DVec2::new(column as f64 + 0.5, row as f64 + 0.5);
            let within = (0..columns as i64).contains(&column) && (0..rows as i64).contains(&row);
            if within && (middle - *place).length() < DISC * spacing {
                covered[row as usize * columns + column as usize] = true;
            }
        }
    }
    square * square * covered.iter().filter(|&&covered| covered).count() as f64
}

/// The mean over the points around a place, each pressure brought to it as in a fluid at rest, Pa; 0 where there are none.
fn pressure_at(scene: &Scene, state: &State, place: DVec2) -> f64 {
    let radius = SENSOR * scene.constants.spacing;
    let weight_density = scene.constants.density * scene.constants.gravity;
    let (mut sum, mut weights) = (0.0, 0.0);
    for (&there, &pressure) in state.pressured.iter().zip(state.pressure) {
        let way = place - there;
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
