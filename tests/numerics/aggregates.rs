//! The coarse pressure of points that stand still: its matrices are sums of the points', its cycle is linear and symmetric, and it
//! helps wherever points lie: between walls and outlets, in domains that repeat, in groups out of each other's sight, close and far
//! apart.

use glam::DVec2;
use stillpoint::case::Case;
use stillpoint::cloud::Cloud;
use stillpoint::cpu::operations::aggregates::Aggregated;
use stillpoint::cpu::operations::coarse::{Coarse, Correction, SCALE, Vectors};
use stillpoint::engine::Outcome;
use stillpoint::step::aggregates::Level;
use stillpoint::step::{Buffer, Operation};

use crate::bench::{Bench, most};
use crate::cases::{ARRANGEMENTS, cavity_of, vortices};
use crate::random::Random;

const ACROSS: usize = 24;
const GRADED: [&str; 2] =
    ["cloud.arrangement=relaxed", "cloud.refine=[{ near = 'top', spacing = 0.006, growth = 0.2 }]"];
const OPEN: [&str; 3] = [
    "cloud.arrangement=jittered",
    "boundaries.left={ kind = 'inlet', velocity = [1.0, 0.0] }",
    "boundaries.right={ kind = 'outlet' }",
];

/// Every scene, and whether its pressure is found but for a constant.
fn scenes(preconditioner: &str) -> Vec<(&'static str, Bench, bool)> {
    let key = format!("effects.pressure.preconditioner={preconditioner}");
    let with = |changes: &[&'static str]| -> Vec<String> {
        let more = [key.as_str(), "effects.pressure.tolerance=1e-6"];
        changes.iter().copied().chain(more).map(str::to_owned).collect()
    };
    let cavity =
        |changes: &[&'static str]| cavity_of(ACROSS, &with(changes).iter().map(String::as_str).collect::<Vec<_>>());
    let mut scenes: Vec<_> =
        ARRANGEMENTS.map(|(name, changes)| (name, Bench::new(&cavity(changes)), true)).into_iter().collect();
    for (name, changes, singular) in [("graded", &GRADED[..], true), ("open", &OPEN, false)] {
        scenes.push((name, Bench::new(&cavity(changes)), singular));
    }
    for (name, changes) in ARRANGEMENTS {
        let name = if name == "regular" { "periodic, regular" } else { "periodic, scattered" };
        scenes.push((
            name,
            Bench::new(&vortices(ACROSS, &with(changes).iter().map(String::as_str).collect::<Vec<_>>())),
            true,
        ));
    }
    let case = cavity(&["method.radius=2.1"]);
    scenes.push(("two groups", Bench::with_cloud(&case, groups(&case)), true));
    scenes
}

/// A strip of the cavity in the middle has no points.
fn groups(case: &Case) -> Cloud {
    let mut cloud = Cloud::build(case).expect("a cloud");
    let kept = |place: &DVec2| (place.x - 0.5).abs() >= 1.6 * cloud.spacing;
    let keep: Vec<bool> = cloud.position.iter().map(kept).collect();
    let interior = cloud.interior;
    let stays = |from: usize| {
        let mut next = from..;
        let keep = &keep;
        move || next.next().is_some_and(|point| keep[point])
    };
    let (mut of_position, mut of_normal, mut of_side) = (stays(0), stays(interior), stays(interior));
    cloud.position.retain(|_| of_position());
    cloud.normal.retain(|_| of_normal());
    cloud.sides.retain(|_| of_side());
    cloud.interior = keep[..interior].iter().filter(|&&keep| keep).count();
    cloud.pressured = cloud.position.len();
    cloud
}

/// The levels of a scene and their arrays.
struct Found {
    levels: Vec<Level>,
    cell: Vec<u32>,
    start: Vec<u32>,
    parts: Vec<u32>,
    parent: Vec<u32>,
    neighbours: Vec<u32>,
    matrix: Vec<f64>,
}

impl Found {
    fn of(bench: &mut Bench) -> Self {
        Self {
            levels: bench.scene.aggregates().expect("aggregates").levels.clone(),
            cell: bench.indexes(Buffer::CoarseCell),
            start: bench.indexes(Buffer::AggregateStart),
            parts: bench.indexes(Buffer::AggregateParts),
            parent: bench.indexes(Buffer::AggregateParent),
            neighbours: bench.indexes(Buffer::AggregateNeighbours),
            matrix: bench.reals(Buffer::AggregateMatrix),
        }
    }

    fn places(level: Level) -> std::ops::Range<usize> {
        level.first..level.first + level.count
    }

    /// `x . K x` on a level.
    fn energy(&self, level: Level, x: &[f64]) -> f64 {
        let links = &self.matrix[2 * self.parent.len()..];
        let row = |place: usize| {
            let other = |slot| level.entry(place, slot);
            let beside: f64 =
                (0..level.slots).map(|slot| links[other(slot)] * x[self.neighbours[other(slot)] as usize]).sum();
            x[place] * (self.matrix[place] * x[place] - beside)
        };
        Self::places(level).map(row).sum()
    }
}

/// `p . K p` over the points.
fn energy(bench: &Bench, p: &dyn Fn(usize) -> f64) -> f64 {
    let cells = bench.scene.cells().expect("a conservative case");
    let row = |i: usize| cells.faces(i).map(|(j, weight)| weight * (p(i) - p(j))).sum::<f64>();
    (0..bench.points()).filter(|&i| !bench.scene.is_outlet(i)).map(|i| p(i) * row(i)).sum()
}

#[test]
fn every_point_is_of_one_aggregate_and_every_row_is_the_sum_of_its_parts() {
    for (name, mut bench, singular) in scenes("multigrid") {
        let found = Found::of(&mut bench);
        let places = found.parent.len();
        let parts =
            |place: usize| found.parts[found.start[place] as usize..found.start[place + 1] as usize].iter().copied();
        let points: Vec<u32> = Found::places(found.levels[0]).flat_map(parts).collect();
        assert_eq!(points.len(), (0..bench.points()).filter(|&i| !bench.scene.is_outlet(i)).count(), "{name}");
        for place in Found::places(found.levels[0]) {
            assert!(parts(place).all(|point| found.cell[point as usize] as usize == place), "{name}");
        }
        let x = Random::new(5).numbers(places);
        let p = |i: usize| if found.cell[i] == 0 { 0.0 } else { x[found.cell[i] as usize] };
        let (fine, coarse) = (energy(&bench, &p), found.energy(found.levels[0], &x));
        assert!((fine - coarse).abs() < 1e-11 * fine && fine > 0.0, "{name}: {fine}, {coarse}");
        for pair in found.levels.windows(2) {
            assert!(pair[1].count < pair[0].count, "{name}");
            let mut steps = vec![0.0; places];
            for place in Found::places(pair[1]) {
                for part in parts(place) {
                    assert_eq!(found.parent[part as usize] as usize, place, "{name}");
                    steps[part as usize] = x[place];
                }
            }
            let (fine, coarse) = (found.energy(pair[0], &steps) / SCALE, found.energy(pair[1], &x));
            let size = found.energy(pair[0], &x).max(1e-12);
            assert!((fine - coarse).abs() < 1e-11 * size, "{name}: {fine}, {coarse}");
        }
        let some = found.levels[0];
        assert!(
            (2.5..5.0).contains(&(points.len() as f64 / some.count as f64)),
            "{name}: {} of {some:?}",
            points.len()
        );
        // The last one has nothing left to be linked to, and is held by an outlet or by nothing, to the last bit.
        let last = found.levels.last().expect("a level");
        assert_eq!((last.count, found.matrix[last.first] == 0.0), (1, singular), "{name}");
    }
}

#[test]
fn the_cycle_is_linear_and_symmetric_and_positive() {
    for (name, mut bench, _) in scenes("multigrid") {
        let found = Found::of(&mut bench);
        let padded = bench.scene.padded();
        let cycle = |r: &[f64]| -> (f64, Vec<f64>) {
            let mut vectors = Vectors::new(found.parent.len());
            let hierarchy = Aggregated {
                levels: &found.levels,
                start: &found.start,
                parts: &found.parts,
                parent: &found.parent,
                neighbours: &found.neighbours,
                matrix: &found.matrix,
            };
            let product = Coarse { hierarchy, cell: &found.cell, vectors: &mut vectors }.correct(r);
            (product, found.cell.iter().map(|&cell| vectors.smoothed[cell as usize]).collect())
        };
        let field = |seed: u64| -> Vec<f64> {
            let noise = Random::new(seed).numbers(padded);
            noise.into_iter().zip(&found.cell).map(|(noise, &cell)| if cell == 0 { 0.0 } else { noise }).collect()
        };
        let dot = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
        let (x, y) = (field(3), field(7));
        let ((own, of_x), (_, of_y)) = (cycle(&x), cycle(&y));
        assert!((own - dot(&x, &of_x)).abs() < 1e-12 * own && own > 0.0, "{name}: {own}");
        assert!((dot(&y, &of_x) - dot(&x, &of_y)).abs() < 1e-12 * own, "{name}");
        let both: Vec<f64> = x.iter().zip(&y).map(|(x, y)| 2.0 * x - y).collect();
        for (i, value) in cycle(&both).1.into_iter().enumerate() {
            let sum = 2.0 * of_x[i] - of_y[i];
            assert!((value - sum).abs() < 1e-11, "{name}, point {i}: {value} is not {sum}");
        }
    }
}

/// Solves for noise, of which every mode is there; the iterations, and the largest error of a difference across a face.
fn solved(bench: &mut Bench) -> (u32, f64) {
    let scene = bench.scene.clone();
    let cells = scene.cells().expect("a conservative case");
    let noise = Random::new(11).numbers(bench.points());
    let p = |i: usize| if scene.is_outlet(i) { 0.0 } else { noise[i] };
    let row = |i: usize| cells.faces(i).map(|(j, weight)| weight * (p(i) - p(j))).sum();
    let source: Vec<f64> = (0..bench.points()).map(|i| if scene.is_outlet(i) { 0.0 } else { row(i) }).collect();
    bench.write_scalars(Buffer::Source, &source);
    bench.apply(&[Operation::ConjugateGradient]);
    let info = bench.engine.solve_info();
    assert_eq!(info.outcome, Outcome::Converged, "{info:?}");
    let found = bench.scalars(Buffer::Pressure);
    let off = |i: usize| cells.faces(i).map(|(j, _)| (found[i] - found[j] - p(i) + p(j)).abs()).fold(0.0, most);
    (info.iterations, (0..bench.points()).map(off).fold(0.0, most))
}

#[test]
fn it_takes_fewer_iterations_than_the_diagonal_alone_wherever_points_lie() {
    for ((name, mut jacobi, _), (_, mut multigrid, _)) in scenes("jacobi").into_iter().zip(scenes("multigrid")) {
        let ((many, first), (few, second)) = (solved(&mut jacobi), solved(&mut multigrid));
        assert!(first < 1e-6 && second < 1e-6, "{name}: {first:e}, {second:e} off");
        assert!(few > 5 && 3 * few < 2 * many, "{name}: {few} iterations, {many} by the diagonal");
    }
}

#[test]
fn iterations_hardly_grow_with_the_number_of_points() {
    for arrangement in [&[][..], &["cloud.arrangement=random", "method.radius=2.8"]] {
        let [few, many] = [64, 256].map(|n| {
            let mut case = cavity_of(n, arrangement);
            if let Some(pressure) = &mut case.effects.pressure {
                // A billionth of the noise's rows, whose size is that of the spacing's square.
                pressure.tolerance = Some(1e-8 * (n * n) as f64);
            }
            solved(&mut Bench::new(&case)).0
        });
        assert!(many < 60 && f64::from(many) < 1.5 * f64::from(few), "{arrangement:?}: {few} at 64, {many} at 256");
    }
}
