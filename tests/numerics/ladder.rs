//! The ladder: points whose neighbours do not carry a full fit get less, are counted, and are never NaN.

use std::path::Path;
use std::sync::Arc;

use glam::DVec2;
use stillpoint::case::Case;
use stillpoint::cloud::Cloud;
use stillpoint::cpu;
use stillpoint::scene::{Scene, SceneError};
use stillpoint::simulation::simulate;
use stillpoint::step::{Buffer, Points, Rung};

use crate::bench::Bench;
use crate::cases::{cavity, cavity_of};

/// Rows of points, `across` apart, the points along them half a spacing apart.
fn rows(corner: DVec2, across: &[f64]) -> Vec<DVec2> {
    across.iter().flat_map(|&y| (0..13).map(move |k| corner + DVec2::new(0.5 * f64::from(k), y))).collect()
}

/// Four groups of points out of each other's sight on 40 x 40 m, all in spacings of 1 m: a dense patch, whose full fit
/// makes room for long lists; one row; two rows; two rows with a third that only a wider radius reaches.
fn groups() -> (Cloud, [std::ops::Range<usize>; 4]) {
    let dense: Vec<f64> = (0..13).map(|k| 0.5 * f64::from(k)).collect();
    let parts = [
        rows(DVec2::new(2.0, 2.0), &dense),
        rows(DVec2::new(22.0, 2.0), &[0.0]),
        rows(DVec2::new(2.0, 22.0), &[0.0, 0.5]),
        rows(DVec2::new(22.0, 22.0), &[0.0, 0.5, 3.0]),
    ];
    let mut start = 0;
    let ranges = parts.each_ref().map(|part| {
        start += part.len();
        start - part.len()..start
    });
    let position = parts.concat();
    let (interior, size) = (position.len(), DVec2::splat(40.0));
    let (normal, sides, outlines, filled, local) = (vec![], vec![], vec![], None, None);
    let cloud = Cloud {
        position,
        interior,
        pressured: interior,
        filled,
        normal,
        sides,
        outlines,
        spacing: 1.0,
        local,
        size,
        period: DVec2::ZERO,
    };
    (cloud, ranges)
}

fn unbounded() -> stillpoint::case::Case {
    let mut case = cavity(&["domain.width=40.0", "domain.height=40.0", "cloud.spacing=1.0"]);
    case.effects.pressure = None;
    case
}

#[test]
fn rows_of_points_step_down_as_far_as_they_must() {
    let (cloud, [dense, row, two, three]) = groups();
    let mut bench = Bench::with_cloud(&unbounded(), cloud);
    let rungs = bench.indexes(Buffer::Rung(Points::Standing));
    assert!(rungs[dense].iter().all(|&rung| rung == 0), "a patch is fitted in full");
    assert!(rungs[row.clone()].iter().all(|&rung| rung == Rung::NEAREST), "{:?}", &rungs[row.clone()]);
    assert!(rungs[two.clone()].iter().all(|&rung| rung == Rung::LINEAR), "{:?}", &rungs[two.clone()]);
    // The lower row sees the third with 1.25 r_e = 3.25 spacings.
    let lower = three.start + 3..three.start + 10;
    assert!(rungs[lower.clone()].iter().all(|&rung| rung == 1), "{:?}", &rungs[lower.clone()]);
    let support = bench.reals(Buffer::Support(Points::Standing));
    assert!(support[lower].iter().all(|&radius| (radius - 3.25).abs() < 1e-12));

    let plane = bench.sample(|p| DVec2::new(2.0 * p.x - 3.0 * p.y + 1.0, p.x * p.y));
    let derivatives = bench.derivatives(&plane);
    for (point, found) in derivatives.iter().enumerate() {
        let [gradient, _] = found.gradient;
        let expected = if row.contains(&point) { DVec2::ZERO } else { DVec2::new(2.0, -3.0) };
        assert!((gradient - expected).length() < 1e-9, "point {point}: {gradient}, not {expected}");
        assert!(found.laplacian.is_finite(), "point {point}");
        if row.contains(&point) || two.contains(&point) {
            assert_eq!(found.laplacian, DVec2::ZERO, "point {point} has no second derivatives");
        }
    }
}

#[test]
fn the_ladder_is_counted_in_the_outcome_and_nothing_turns_nan() {
    let (cloud, ranges) = groups();
    let [_, row, two, _] = ranges;
    let mut case = unbounded();
    case.time.end = 3.0;
    for splitting in [stillpoint::case::Splitting::Reflection, stillpoint::case::Splitting::Projection] {
        case.time.splitting = splitting;
        let mut bench = Bench::with_cloud(&case, cloud.clone());
        let rungs = bench.indexes(Buffer::Rung(Points::Standing));
        let widened = rungs.iter().filter(|&&rung| (1..Rung::LINEAR).contains(&rung)).count() as u64;
        // The run does its own setup, on an engine that has not been set up.
        bench.engine = cpu::double(&bench.scene).expect("an engine");
        let moving = bench.sample(|p| DVec2::new(p.y.sin(), 0.1));
        for buffer in [Buffer::Velocity, Buffer::Projected, Buffer::Reflected] {
            if bench.scene.plan.buffers().contains(&buffer) {
                bench.write_vectors(buffer, &moving);
            }
        }
        let outcome = simulate(&bench.scene, bench.engine.as_mut(), &mut ()).expect("a run");
        assert!(widened > 0);
        assert_eq!(outcome.ladder, [widened, two.len() as u64, row.len() as u64]);
        assert!(outcome.snapshot.velocity.iter().all(|u| u.is_finite()));
    }
}

#[test]
fn corners_with_too_few_neighbours_take_a_wider_radius() {
    // At 2.0005 spacings a corner's five neighbours are as many as the coefficients, two of them with next to no weight.
    let mut bench = Bench::new(&cavity(&["method.radius=2.0005"]));
    let rungs = bench.indexes(Buffer::Rung(Points::Standing));
    let corner = bench.scene.cloud.position.iter().position(|&p| p == DVec2::ZERO).expect("a corner");
    assert!((1..Rung::LINEAR).contains(&rungs[corner]), "{}", rungs[corner]);
    let plane = bench.sample(|p| DVec2::new(p.x * p.x - p.y, p.x * p.y));
    let found = &bench.derivatives(&plane)[corner];
    assert!((found.gradient[0] - DVec2::NEG_Y).length() < 1e-9 && (found.laplacian.x - 2.0).abs() < 1e-7);
}

#[test]
fn fewer_neighbours_than_coefficients_are_an_error() {
    let error = Scene::build(&cavity(&["method.radius=1.9"])).expect_err("a corner with three neighbours");
    assert!(matches!(error, SceneError::TooFewNeighbours { found: 3, .. }), "{error}");
    assert!(Scene::build(&cavity_of(20, &["method.radius=2.0005"])).is_ok());
}

#[test]
fn points_that_coincide_are_an_error_that_names_both() {
    let case = cavity(&[]);
    let mut cloud = Cloud::build(&case).expect("a cloud");
    cloud.position[7] = cloud.position[100];
    let error = Scene::with_cloud(&case, cloud).expect_err("two points in one place").to_string();
    assert!(error.starts_with("points 7 and 100 coincide at ("), "{error}");
}

#[test]
fn widened_corners_are_counted_in_single_precision_too() {
    let scene = Arc::new(Scene::build(&cavity(&["method.radius=2.0005"])).expect("a scene"));
    let outcome = simulate(&scene, cpu::single(&scene).expect("an engine").as_mut(), &mut ()).expect("a run");
    assert!(outcome.ladder[0] >= 4 && outcome.ladder[1..] == [0, 0], "{:?}", outcome.ladder);
    assert!(outcome.snapshot.velocity.iter().all(|u| u.is_finite()));
}

/// Points that move, whose neighbours and images stand in a line, have no slope across it: under a ceiling they fall.
#[test]
fn two_points_under_a_ceiling_fall_straight() {
    let text = "title = 'a pair'\n\
                domain = { width = 3.0, height = 2.5 }\n\
                cloud = { arrangement = 'regular', spacing = 0.1, fill = { from = [0.0, 0.0], to = [1.0, 1.5] } }\n\
                fluid.density = 2.0\n\
                effects.gravity.acceleration = [0.0, -1.0]\n\
                effects.pressure = {}\n\
                effects.advection.motion = 'shifted'\n\
                time.end = 1.0\n";
    let case = Case::from_text(text, Path::new("pair.toml"), &[]).expect("a case");
    let mut cloud = Scene::build(&case).expect("a scene").cloud;
    let first = cloud.interior;
    cloud.position.extend([DVec2::new(2.5, 2.45), DVec2::new(2.501, 2.35)]);
    (cloud.interior, cloud.pressured) = (first + 2, first + 2);
    let mut bench = Bench::with_cloud(&case, cloud);
    let (dt, steps) = (0.01, 20);
    bench.engine.advance(steps, &bench.scene.clock(dt)).expect("steps");
    assert_eq!(bench.indexes(Buffer::Rung(Points::Standing))[first..first + 2], [Rung::NEAREST; 2]);
    let fallen = -f64::from(steps) * dt;
    for velocity in bench.reals(Buffer::Projected)[2 * first..2 * first + 4].chunks_exact(2) {
        assert!(velocity[0].abs() < 1e-12 && (velocity[1] - fallen).abs() < 1e-12, "{velocity:?}");
    }
}
