//! Obstacles: points on their outlines, cells that end there, and the pressure equation beside them.

use std::f64::consts::TAU;

use glam::DVec2;
use stillpoint::case::{Case, Circle, Obstacle};
use stillpoint::cloud::voronoi::{Boundary, Cells};
use stillpoint::cloud::{Cloud, CloudError};
use stillpoint::step::{Buffer, Operation};

use crate::bench::{Bench, largest_difference, order, without_mean};
use crate::cases::{cavity_of, problem};
use crate::random::Random;

const ARRANGEMENTS: [&str; 4] = ["regular", "jittered", "random", "relaxed"];

fn circle(name: &str, centre: DVec2, radius: f64) -> Obstacle {
    let circle = Some(Circle { centre: centre.to_array(), radius });
    Obstacle { name: name.to_owned(), circle, polygon: None, parts: None }
}

fn polygon(name: &str, corners: &[DVec2]) -> Obstacle {
    let corners = corners.iter().map(|corner| corner.to_array()).collect();
    Obstacle { name: name.to_owned(), circle: None, polygon: Some(corners), parts: None }
}

/// A star of three to eight corners around `centre`, either way round.
fn star(random: &mut Random, centre: DVec2, largest: f64) -> Obstacle {
    let count = 3 + (2.99 * (1.0 + random.number())) as usize;
    let turn = random.number();
    let mut corners: Vec<DVec2> = (0..count)
        .map(|k| {
            let angle = TAU * (turn + (k as f64 + 0.2 * random.number()) / count as f64);
            centre + largest * (0.8 + 0.2 * random.number()) * DVec2::from_angle(angle)
        })
        .collect();
    if random.number() < 0.0 {
        corners.reverse();
    }
    polygon("star", &corners)
}

/// A body made of parts, as a case file has it.
fn figure(name: &str, parts: &str) -> Obstacle {
    toml::from_str(&format!("name = '{name}'\nparts = [{parts}]")).expect("an obstacle")
}

/// Bodies with curved sides, round and sharp corners, and corners that point inwards.
const CUP: &str = "{ circle = { centre = [0.35, 0.5], radius = 0.25 } }, \
                   { circle = { centre = [0.35, 0.5], radius = 0.14 }, combine = 'subtract' }, \
                   { box = { centre = [0.55, 0.5], size = [0.5, 0.16] }, combine = 'subtract' }";
const WING: &str = "{ ellipse = { centre = [0.8, 0.25], axes = [0.16, 0.07], turn = -40.0 } }";
const KEY: &str = "{ box = { centre = [0.3, 0.3], size = [0.3, 0.2], corner = 0.05, turn = 15.0 } }, \
                   { capsule = { from = [0.35, 0.3], to = [0.62, 0.6], radius = 0.05 } }, \
                   { ellipse = { centre = [0.2, 0.42], axes = [0.1, 0.06] }, combine = 'subtract' }";

/// Scenes of a circle and a star at random places, then of bodies made of parts, by arrangement.
fn scenes() -> Vec<(String, Case, Cloud)> {
    let mut scenes = Vec::new();
    let mut random = Random::new(5);
    for seed in 0..12 {
        for arrangement in ARRANGEMENTS {
            let mut case = cavity_of(32, &[&format!("cloud.arrangement={arrangement}"), "method.radius=2.8"]);
            let mut near = |x: f64, y: f64| DVec2::new(x, y) + 0.06 * random.vector();
            let [ball, centre] = [near(0.28, 0.7), near(0.68, 0.35)];
            let radius = 0.1 + 0.04 * random.number();
            case.obstacles = vec![circle("ball", ball, radius), star(&mut random, centre, 0.19)];
            let cloud = Cloud::build(&case).unwrap_or_else(|error| panic!("{arrangement} {seed}: {error}"));
            scenes.push((format!("{arrangement} {seed}"), case, cloud));
        }
    }
    for arrangement in ARRANGEMENTS {
        for bodies in [vec![figure("cup", CUP), figure("wing", WING)], vec![figure("key", KEY)]] {
            let mut case = cavity_of(32, &[&format!("cloud.arrangement={arrangement}"), "method.radius=2.8"]);
            let name = format!("{arrangement} {}", bodies[0].name);
            case.obstacles = bodies;
            let cloud = Cloud::build(&case).unwrap_or_else(|error| panic!("{name}: {error}"));
            scenes.push((name, case, cloud));
        }
    }
    scenes
}

/// A circle is a circle, as a shape of its own and as the one part of another.
#[test]
fn a_part_alone_is_the_figure_that_it_is() {
    let ball = circle("ball", DVec2::new(0.45, 0.55), 0.2);
    let part = figure("ball", "{ circle = { centre = [0.45, 0.55], radius = 0.2 } }");
    let corners = [[0.3, 0.3], [0.7, 0.3], [0.7, 0.6], [0.3, 0.6]].map(DVec2::from);
    let block = figure("block", "{ box = { centre = [0.5, 0.45], size = [0.4, 0.3] } }");
    for (one, other) in [(ball, part), (polygon("block", &corners), block)] {
        let [one, other] = [one, other].map(|body| {
            let mut case = cavity_of(20, &["cloud.arrangement=relaxed"]);
            case.obstacles = vec![body];
            Cloud::build(&case).expect("a cloud")
        });
        assert_eq!(one.len(), other.len());
        let nearest = |place: &DVec2| other.position.iter().map(|p| p.distance(*place)).fold(f64::INFINITY, f64::min);
        let off = one.position.iter().map(nearest).fold(0.0, f64::max);
        assert!(off < 1e-9, "{off:e}");
        let [one, other] = [&one, &other].map(|cloud| Cells::build(cloud).volume.iter().sum::<f64>());
        assert!((one - other).abs() < 1e-13);
    }
}

#[test]
fn volumes_are_positive_and_sum_to_the_area_less_the_obstacles() {
    for (name, _, cloud) in scenes() {
        let cells = Cells::build(&cloud);
        let area = 1.0 - cloud.outlines.iter().map(|outline| outline.shape.area()).sum::<f64>();
        assert!(area < 0.97 && (cloud.area() - area).abs() < 1e-14, "{name}: {area}");
        let sum: f64 = cells.volume.iter().sum();
        assert!((sum - area).abs() < 1e-12, "{name}: {sum} of {area}");
        assert!(cells.volume.iter().all(|&volume| volume > 0.0), "{name}");
    }
}

/// `sum_j w_ij d_ij = -A_i n_i` in every cell, those on sides and outlines among them.
#[test]
fn cells_and_their_pieces_of_wall_are_closed() {
    for (name, _, cloud) in scenes() {
        let cells = Cells::build(&cloud);
        let mut open = vec![DVec2::ZERO; cloud.len()];
        for (point, open) in open.iter_mut().enumerate() {
            for (other, weight) in cells.faces(point) {
                assert!(weight > 0.0);
                *open += weight * (cloud.position[other] - cloud.position[point]);
            }
        }
        cells.walls.iter().for_each(|piece| open[piece.point] += piece.area);
        let worst = open.iter().map(|open| open.length()).fold(0.0, f64::max);
        // Faces of less than 1e-7 spacings are left out.
        assert!(worst < 1e-6 * cloud.spacing, "{name}: {worst}");
    }
}

#[test]
fn points_of_outlines_alone_touch_them_and_the_pieces_go_all_round() {
    for (name, _, cloud) in scenes() {
        let cells = Cells::build(&cloud);
        for (number, outline) in cloud.outlines.iter().enumerate() {
            let pieces: Vec<_> = cells.walls.iter().filter(|piece| piece.of == Boundary::Obstacle(number)).collect();
            assert!(pieces.iter().all(|piece| outline.points.contains(&piece.point)), "{name}");
            assert_eq!(pieces.len(), 2 * outline.points.len(), "{name}");
            let sum: DVec2 = pieces.iter().map(|piece| piece.area).sum();
            assert!(sum.length() < 1e-12, "{name}: {sum}");
            for piece in pieces {
                let [own, way] = [cloud.position[piece.point], piece.middle - cloud.position[piece.point]];
                // Out of the fluid: a little farther is in the obstacle.
                let beyond = own + way + 0.2 * piece.area;
                assert!(outline.shape.distance(beyond) < 0.0, "{name}: {beyond}");
            }
        }
    }
}

#[test]
fn interior_points_keep_off_outlines_and_points_on_them_have_outward_normals() {
    for (name, _, cloud) in scenes() {
        for place in &cloud.position[..cloud.interior] {
            assert!(cloud.clearance(*place) > 0.5 * cloud.spacing, "{name}: {place}");
        }
        for outline in &cloud.outlines {
            let range = outline.points.clone();
            for (point, &middle) in range.clone().zip(&outline.middle) {
                let place = cloud.position[point];
                assert!(outline.shape.distance(place).abs() < 1e-12, "{name}: {place}");
                assert!(outline.shape.distance(middle).abs() < 1e-12, "{name}: {middle}");
                let normal = cloud.normal[point - cloud.interior];
                assert!((normal.length() - 1.0).abs() < 1e-12);
                assert!(outline.shape.distance(place + 0.1 * cloud.spacing * normal) < 0.0, "{name}: {place} {normal}");
            }
            let gaps = range.clone().zip(range.skip(1)).map(|(a, b)| cloud.position[a].distance(cloud.position[b]));
            let (least, most) = gaps.fold((1.0_f64, 0.0_f64), |(low, high), gap| (low.min(gap), high.max(gap)));
            assert!(least > 0.5 * cloud.spacing && most < 1.0001 * cloud.spacing, "{name}: {least} {most}");
        }
    }
}

/// About as many points to the area as without obstacles, and none of them far from its neighbours.
#[test]
fn the_fluid_is_filled_evenly() {
    for (name, _, cloud) in scenes() {
        let cells = Cells::build(&cloud);
        let cell = cloud.spacing * cloud.spacing;
        // Cells on walls are halves.
        let wanted = cloud.area() / cell - 0.5 * (cloud.len() - cloud.interior) as f64;
        assert!((cloud.interior as f64 / wanted - 1.0).abs() < 0.08, "{name}: {} of {wanted}", cloud.interior);
        let most = cells.volume.iter().fold(0.0_f64, |most, &volume| most.max(volume));
        assert!(most < 2.2 * cell, "{name}: {}", most / cell);
    }
}

#[test]
fn what_is_too_small_or_too_near_is_refused_by_name() {
    let built = |obstacles: Vec<Obstacle>| {
        let mut case = cavity_of(32, &[]);
        case.obstacles = obstacles;
        Cloud::build(&case).map(|_| ())
    };
    let middle = DVec2::splat(0.5);
    assert!(matches!(built(vec![circle("dot", middle, 0.03)]), Err(CloudError::Thin { name, .. }) if name == "dot"));
    let near = |obstacles| matches!(built(obstacles), Err(CloudError::Narrow { name, .. }) if name == "it");
    assert!(near(vec![circle("it", DVec2::new(0.25, 0.5), 0.2)]), "a side is near");
    assert!(near(vec![circle("it", middle, 0.1), circle("other", middle + 0.16, 0.1)]), "another is near");
    assert!(near(vec![circle("it", middle, 0.1), circle("other", middle, 0.2)]), "one in another");
    let plate = [DVec2::new(0.3, 0.5), DVec2::new(0.7, 0.5), DVec2::new(0.7, 0.51), DVec2::new(0.3, 0.51)];
    assert!(matches!(built(vec![polygon("it", &plate)]), Err(CloudError::Thin { name, .. }) if name == "it"));
    assert_eq!(built(vec![circle("it", middle, 0.1), circle("other", middle + 0.25, 0.1)]), Ok(()));
    let narrow =
        |parts: &str| matches!(built(vec![figure("it", parts)]), Err(CloudError::Narrow { name, .. }) if name == "it");
    let round = "{ circle = { centre = [0.5, 0.5], radius = 0.2 } }";
    assert!(
        narrow(&format!("{round}, {{ box = {{ centre = [0.7, 0.5], size = [0.3, 0.01] }}, combine = 'subtract' }}")),
        "a slit"
    );
    let hole = format!("{round}, {{ circle = {{ centre = [0.5, 0.5], radius = 0.01 }}, combine = 'subtract' }}");
    assert!(matches!(built(vec![figure("it", &hole)]), Err(CloudError::Parts { name, .. }) if name == "it"));
    let thin = "{ capsule = { from = [0.3, 0.3], to = [0.7, 0.7], radius = 0.02 } }";
    assert!(matches!(built(vec![figure("it", thin)]), Err(CloudError::Thin { name, .. }) if name == "it"));
}

/// Largest error of the pressure, over the largest pressure.
fn poisson(n: usize, arrangement: &str, obstacles: Vec<Obstacle>) -> f64 {
    let arrangement = format!("cloud.arrangement={arrangement}");
    let mut case = problem(n, &["poisson.field=cosines", &arrangement, "effects.pressure.solver=direct"]);
    case.obstacles = obstacles;
    let mut bench = Bench::new(&case);
    bench.apply(&[Operation::DirectSolve]);
    let exact = bench.sample(|p| (0.5 * TAU * p.x).cos() * (0.5 * TAU * p.y).cos());
    largest_difference(&without_mean(&bench.scalars(Buffer::Pressure)), &without_mean(&exact))
}

#[test]
fn the_known_pressure_is_found_at_order_two_beside_obstacles() {
    let corners = [[0.55, 0.2], [0.8, 0.3], [0.65, 0.5], [0.6, 0.35]].map(DVec2::from);
    let body = || vec![circle("ball", DVec2::new(0.3, 0.65), 0.15), polygon("body", &corners)];
    let key = || vec![figure("key", KEY)];
    for (arrangement, body) in ARRANGEMENTS.into_iter().flat_map(|name| [(name, &body as &dyn Fn() -> _), (name, &key)])
    {
        let errors = [24, 48, 96].map(|n| poisson(n, arrangement, body()));
        let found = order((24, errors[0]), (96, errors[2]));
        assert!(found > 1.7 && errors[1] < 3e-3, "{arrangement}: order {found}, errors {errors:?}");
    }
}
