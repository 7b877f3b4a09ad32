//! Points whose spacing varies: as close as they are asked to be, evenly laid out, and as exact as even ones.

use std::f64::consts::PI;

use glam::DVec2;
use stillpoint::case::{Case, Refine};
use stillpoint::cloud::voronoi::Cells;
use stillpoint::cloud::{Cloud, Sizing};
use stillpoint::cpu::blocks;
use stillpoint::step::{Buffer, Operation, Points};

use crate::bench::{Bench, largest_difference, order, without_mean};
use crate::cases::{cavity_of, problem};

fn near(side: &str, spacing: f64, growth: f64) -> Refine {
    Refine { near: Some(side.to_owned()), corners: None, spacing, growth }
}

fn boxed(corners: [[f64; 2]; 2], spacing: f64, growth: f64) -> Refine {
    Refine { near: None, corners: Some(corners), spacing, growth }
}

/// Closer by four under the lid, and by eight in a place inside.
fn graded(mut case: Case) -> Case {
    let spacing = case.cloud.spacing;
    case.cloud.refine = vec![near("top", spacing / 4.0, 0.1), boxed([[0.3, 0.4], [0.3, 0.4]], spacing / 8.0, 0.15)];
    case
}

fn cavity() -> Case {
    graded(cavity_of(16, &["cloud.arrangement=relaxed"]))
}

#[test]
fn points_are_as_close_as_asked_everywhere() {
    let case = cavity();
    let (cloud, sizing) = (Cloud::build(&case).expect("a cloud"), Sizing::of(&case));
    let spacing = |x: f64, y: f64| sizing.at(DVec2::new(x, y));
    for (found, right) in [
        (spacing(0.5, 1.0), 1.0 / 64.0),
        (spacing(0.8, 0.9), 1.0 / 64.0 + 0.01),
        (spacing(0.3, 0.4), 1.0 / 128.0),
        (spacing(0.3, 0.2), 1.0 / 128.0 + 0.03),
        (spacing(1.0, 0.0), 1.0 / 16.0),
    ] {
        assert!((found - right).abs() < 1e-12, "{found}, not {right}");
    }
    assert_eq!((sizing.least(), sizing.base()), (1.0 / 128.0, 1.0 / 16.0));
    let cells = Cells::build(&cloud);
    let share = |point: usize| cells.volume[point] / cloud.spacing_at(point).powi(2);
    let shares: Vec<f64> = (0..cloud.interior).map(share).collect();
    let (least, most) = shares.iter().fold((9.0_f64, 0.0_f64), |(low, high), &share| (low.min(share), high.max(share)));
    let mean = shares.iter().sum::<f64>() / shares.len() as f64;
    assert!(least > 0.5 && most < 1.8 && (mean - 1.0).abs() < 0.1, "{least} {mean} {most}");
    let area: f64 = cells.volume.iter().sum();
    assert!((area - 1.0).abs() < 1e-12, "{area}");
}

#[test]
fn a_seed_gives_the_same_points_and_another_seed_others() {
    let built = |seed: u64| {
        let mut case = cavity();
        case.cloud.seed = Some(seed);
        Cloud::build(&case).expect("a cloud").position
    };
    assert!(built(3) == built(3) && built(3) != built(4));
}

#[test]
fn layers_stand_behind_the_walls_like_a_lattice() {
    let cloud = Cloud::build(&cavity_of(16, &["cloud.arrangement=relaxed"])).expect("a cloud");
    for k in 1..=3 {
        for i in 3..=13 {
            let place = DVec2::new(f64::from(i), f64::from(k)) / 16.0;
            let found = cloud.position.iter().any(|other| other.distance(place) < 1e-12);
            assert!(found, "no point at {place}");
        }
    }
}

#[test]
fn every_point_finds_those_within_its_own_radius() {
    let mut bench = Bench::new(&cavity());
    let capacity = bench.scene.sizes.capacity;
    let (neighbours, count) =
        (bench.indexes(Buffer::Neighbours(Points::Standing)), bench.indexes(Buffer::NeighbourCount(Points::Standing)));
    let rungs = bench.indexes(Buffer::Rung(Points::Standing));
    let cloud = &bench.scene.cloud;
    for i in (0..cloud.len()).filter(|&i| rungs[i] == 0) {
        let mut found: Vec<usize> =
            (0..count[i] as usize).map(|slot| neighbours[blocks::at(i, slot, capacity)] as usize).collect();
        found.sort_unstable();
        let radius = bench.scene.case.method.radius() * cloud.spacing_at(i);
        let close = |j: &usize| *j != i && cloud.position[*j].distance(cloud.position[i]) < radius;
        assert_eq!(found, (0..cloud.len()).filter(close).collect::<Vec<_>>(), "point {i}");
    }
    let low = rungs[..cloud.len()].iter().filter(|&&rung| rung > 0).count();
    assert!(low < cloud.len() / 100, "{low} weak fits of {}", cloud.len());
}

#[test]
fn quadratics_are_exact_in_the_fits_and_in_the_flux() {
    let mut bench =
        Bench::new(&graded(cavity_of(16, &["cloud.arrangement=relaxed", "effects.pressure.divergence=fit"])));
    let field = |p: DVec2| DVec2::new(p.x * p.x - 2.0 * p.x * p.y, p.y * p.y + 3.0 * p.x * p.y - p.x);
    let velocity = bench.sample(field);
    for (place, d) in bench.sample(|p| p).into_iter().zip(bench.derivatives(&velocity)) {
        let right = [
            DVec2::new(2.0 * place.x - 2.0 * place.y, -2.0 * place.x),
            DVec2::new(3.0 * place.y - 1.0, 2.0 * place.y + 3.0 * place.x),
        ];
        let off = (d.gradient[0] - right[0]).length().max((d.gradient[1] - right[1]).length());
        assert!(off < 1e-9 && (d.laplacian - DVec2::splat(2.0)).length() < 1e-6, "{place}: {off} {}", d.laplacian);
    }
    // What leaves one cell enters another: inside the sum over cells of a velocity that rests on the walls is nothing.
    let fluxes = bench.scene.fluxes().expect("fitted faces");
    let calm = |p: DVec2| field(p) * (p.x * (1.0 - p.x) * p.y * (1.0 - p.y));
    let sum: f64 = (0..bench.points())
        .map(|cell| fluxes.row(cell).map(|(k, factor)| factor.dot(calm(bench.scene.cloud.position[k]))).sum::<f64>())
        .sum();
    assert!(sum.abs() < 1e-13, "{sum}");
}

#[test]
fn the_known_pressure_is_found_at_order_two() {
    let error = |n: usize| {
        let solver = "effects.pressure.solver=direct";
        let case = graded(problem(n, &["poisson.field=cosines", "cloud.arrangement=relaxed", solver]));
        let mut bench = Bench::new(&case);
        bench.apply(&[Operation::DirectSolve]);
        let exact = bench.sample(|p| (PI * p.x).cos() * (PI * p.y).cos());
        // The growth does not change with the spacing: of two clouds their numbers of points tell how much finer one is.
        let across = (bench.points() as f64).sqrt() as usize;
        (across, largest_difference(&without_mean(&bench.scalars(Buffer::Pressure)), &without_mean(&exact)))
    };
    let (coarse, fine) = (error(12), error(36));
    let found = order(coarse, fine);
    assert!(found > 1.7 && fine.1 < 2e-3, "order {found}, {coarse:?} to {fine:?}");
}

/// The step is as long as the fastest fluid takes for its own spacing.
#[test]
fn refinement_where_nothing_moves_fast_does_not_shorten_the_step() {
    let step = |refine: Vec<Refine>| {
        let mut case =
            cavity_of(16, &["cloud.arrangement=relaxed", "effects.viscosity.kinematic=0.001", "time.end=2.0"]);
        case.cloud.refine = refine;
        let scene = std::sync::Arc::new(stillpoint::scene::Scene::build(&case).expect("a scene"));
        let mut engine = stillpoint::cpu::double(&scene).expect("an engine");
        stillpoint::simulation::simulate(&scene, engine.as_mut(), &mut ()).expect("a run").steps
    };
    let (even, below, lid) =
        (step(vec![]), step(vec![near("bottom", 1.0 / 64.0, 0.1)]), step(vec![near("top", 1.0 / 64.0, 0.1)]));
    assert!(below < 2 * even && lid > 3 * even, "{even} {below} {lid}");
}
