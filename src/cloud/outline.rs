//! Points on the outlines of obstacles.
//!
//! They lie about one spacing apart, every corner among them. Half way between two of them is a place of the
//! outline that is equally far from both: there the cells of the two meet. No other point comes as near to that place as they
//! do, so that every other cell ends before the outline.

use std::f64::consts::TAU;
use std::ops::Range;

use glam::DVec2;

use super::grid::Grid;
use super::shape::{Shape, edges};
use super::sizing::Sizing;
use super::{Cloud, CloudError};
use crate::case::Case;

/// Spacings between an outline and another, or a side.
const ROOM: f64 = 2.0;
/// Narrowest slit in a body, spacings.
const SLIT: f64 = 0.6;
/// Points of the rule that integrates the number of spacings along a curve.
const SAMPLES: usize = 4096;

/// The points of one obstacle, anticlockwise.
#[derive(Debug, Clone, PartialEq)]
pub struct Outline {
    pub name: String,
    pub shape: Shape,
    /// Which points of the cloud they are.
    pub points: Range<usize>,
    /// The place of the outline half way from each to the next, m.
    pub middle: Vec<DVec2>,
    /// What the obstacle has beyond the straight ways from each point to that place and from there to the next, m^2.
    pub bulge: Vec<[f64; 2]>,
}

/// Places on an outline, anticlockwise, with what belongs to each.
#[derive(Debug, Clone, PartialEq)]
pub struct Traced {
    /// m
    pub place: Vec<DVec2>,
    /// As in [`Outline`].
    pub middle: Vec<DVec2>,
    bulge: Vec<[f64; 2]>,
    /// Out of the fluid.
    normal: Vec<DVec2>,
}

fn trace(shape: &Shape, sizing: &Sizing) -> Traced {
    match shape {
        Shape::Circle { centre, radius } => {
            let at = |turn: f64| *centre + *radius * DVec2::from_angle(TAU * turn);
            let turns = divided(TAU * radius, &|turn| sizing.at(at(turn)));
            let halves: Vec<f64> = turns.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])).collect();
            let segment = |pair: &[f64]| {
                let angle = 0.5 * TAU * (pair[1] - pair[0]);
                [0.5 * radius * radius * (angle - angle.sin()); 2]
            };
            let places = &turns[..turns.len() - 1];
            Traced {
                place: places.iter().map(|&turn| at(turn)).collect(),
                middle: halves.iter().map(|&turn| at(turn)).collect(),
                bulge: turns.windows(2).map(segment).collect(),
                normal: places.iter().map(|&turn| -DVec2::from_angle(TAU * turn)).collect(),
            }
        }
        Shape::Polygon(corners) => {
            let mut traced = Traced { place: vec![], middle: vec![], bulge: vec![], normal: vec![] };
            // Into the obstacle is to the left.
            let mut before = corners.last().map_or(DVec2::ZERO, |&last| (corners[0] - last).normalize().perp());
            for (from, to) in edges(corners) {
                let along = to - from;
                let normal = along.normalize().perp();
                let shares = divided(along.length(), &|share| sizing.at(from + share * along));
                for pair in shares.windows(2) {
                    traced.place.push(from + pair[0] * along);
                    traced.middle.push(from + 0.5 * (pair[0] + pair[1]) * along);
                    traced.bulge.push([0.0; 2]);
                    traced.normal.push(if pair[0] > 0.0 { normal } else { (before + normal).normalize_or(normal) });
                }
                before = normal;
            }
            traced
        }
        Shape::Figure(figure) => {
            let runs = figure.runs();
            let mut traced = Traced { place: vec![], middle: vec![], bulge: vec![], normal: vec![] };
            let into = |along: DVec2| along.normalize().perp();
            let mut before = runs.last().map_or(DVec2::ZERO, |last| into(last.velocity(last.end())));
            for run in &runs {
                // A length of 1 at a speed that varies.
                let along = |share: f64| share * run.end();
                let cuts = divided(1.0, &|share| {
                    let s = along(share);
                    sizing.at(run.at(s)) / (run.end() * run.velocity(s).length()).max(f64::MIN_POSITIVE)
                });
                for pair in cuts.windows(2) {
                    let [from, to] = [pair[0], pair[1]].map(along);
                    let middle = run.middle(from, to);
                    let normal = into(run.velocity(from));
                    traced.place.push(run.at(from));
                    traced.middle.push(run.at(middle));
                    traced.bulge.push([run.bulge(from, middle), run.bulge(middle, to)]);
                    traced.normal.push(if from > 0.0 { normal } else { (before + normal).normalize_or(normal) });
                }
                before = into(run.velocity(run.end()));
            }
            traced
        }
    }
}

/// Where a curve of `length`, m, is cut into pieces that are no longer than a spacing, as parts of it from 0 to 1, both among
/// them; `spacing` at a part of it, m.
pub(super) fn divided(length: f64, spacing: &dyn Fn(f64) -> f64) -> Vec<f64> {
    // Spacings up to each sample, by the midpoint rule.
    let step = 1.0 / SAMPLES as f64;
    let mut passed = vec![0.0];
    passed.extend((0..SAMPLES).scan(0.0, |sum, k| {
        *sum += length * step / spacing((k as f64 + 0.5) * step);
        Some(*sum)
    }));
    let count = (passed[SAMPLES] * (1.0 - 1e-9)).ceil().max(1.0);
    let mut k = 0;
    let mut cuts = vec![0.0];
    for cut in 1..count as usize {
        let wanted = passed[SAMPLES] * cut as f64 / count;
        while passed[k + 1] < wanted {
            k += 1;
        }
        cuts.push((k as f64 + (wanted - passed[k]) / (passed[k + 1] - passed[k])) * step);
    }
    cuts.push(1.0);
    cuts
}

/// The outlines of the obstacles of a case, in its order.
///
/// # Errors
/// Obstacles that are too thin, or too near to each other or to a side.
pub fn outlines(case: &Case) -> Result<Vec<Traced>, CloudError> {
    let sizing = Sizing::of(case);
    let shapes: Vec<Shape> = case.obstacles.iter().map(Shape::of).collect();
    let mut outlines = Vec::new();
    for (number, (obstacle, shape)) in case.obstacles.iter().zip(&shapes).enumerate() {
        let name = || obstacle.name.clone();
        if let Shape::Figure(figure) = shape
            && let Some(fault) = figure.fault()
        {
            return Err(CloudError::Parts { name: name(), fault });
        }
        let (depth, deepest) = shape.deepest();
        let least = sizing.at(deepest);
        if depth < least {
            return Err(CloudError::Thin { name: name(), depth, least });
        }
        let traced = trace(shape, &sizing);
        for (&place, &normal) in traced.place.iter().zip(&traced.normal) {
            let walls = place.min(sizing.size() - place).min_element();
            let others = shapes.iter().enumerate().filter(|(other, _)| *other != number);
            let clear = others.map(|(_, other)| other.distance(place)).fold(walls, f64::min);
            let into_fluid = |way: f64| shape.distance(place - way * sizing.at(place) * normal);
            if clear < ROOM * sizing.at(place) || [0.5 * SLIT, SLIT].into_iter().any(|way| into_fluid(way) <= 0.0) {
                return Err(CloudError::Narrow { name: name(), x: place.x, y: place.y });
            }
        }
        outlines.push(traced);
    }
    Ok(outlines)
}

/// Puts the points and normals of the obstacles behind those of the sides; the ranges count from there.
pub(super) fn place(
    case: &Case,
    boundary: &mut Vec<DVec2>,
    normal: &mut Vec<DVec2>,
) -> Result<Vec<Outline>, CloudError> {
    let mut placed = Vec::new();
    for (obstacle, traced) in case.obstacles.iter().zip(outlines(case)?) {
        let points = boundary.len()..boundary.len() + traced.place.len();
        boundary.extend(traced.place);
        normal.extend(traced.normal);
        let (name, shape) = (obstacle.name.clone(), Shape::of(obstacle));
        placed.push(Outline { name, shape, points, middle: traced.middle, bulge: traced.bulge });
    }
    Ok(placed)
}

/// Refuses an outline that another point of the boundary comes too near to: the cells of both would overlap.
pub(super) fn check(cloud: &Cloud, sizing: &Sizing) -> Result<(), CloudError> {
    if cloud.outlines.is_empty() {
        return Ok(());
    }
    let boundary = &cloud.position[cloud.interior..];
    let grid = Grid::new(boundary, cloud.size, DVec2::ZERO, 2.0 * sizing.least());
    for outline in &cloud.outlines {
        for (k, &middle) in outline.middle.iter().enumerate() {
            let [own, next] = outline.ends(k);
            let half = cloud.position[own].distance(middle);
            let near = grid.within(middle, half).map(|other| other + cloud.interior);
            for other in near.filter(|&other| other != own && other != next) {
                let place = cloud.position[other];
                if place.distance(middle) < half * (1.0 + 1e-9) {
                    return Err(CloudError::Narrow { name: outline.name.clone(), x: place.x, y: place.y });
                }
            }
        }
    }
    Ok(())
}

impl Outline {
    /// The points that the `k`th middle lies between.
    pub fn ends(&self, k: usize) -> [usize; 2] {
        let count = self.points.len();
        [self.points.start + k, self.points.start + (k + 1) % count]
    }
}
