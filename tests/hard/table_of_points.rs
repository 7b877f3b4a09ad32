//! Hard cases of where the points are.

use glam::DVec2;
use stillpoint::case::Case;
use stillpoint::cloud::Cloud;
use stillpoint::cpu;
use stillpoint::known::Known;

use crate::cases::{self, FIT, cavity, cavity_of, problem, vortices};
use crate::flow::{Open, flow, flow_of};
use crate::table::{Promise, Row};

const ACROSS: usize = 16;

fn plain(changes: &[&str]) -> Case {
    cavity_of(ACROSS, changes)
}

fn cloud() -> Cloud {
    Cloud::build(&plain(&[])).expect("a cloud")
}

/// The interior point nearest to the middle.
fn middle(cloud: &Cloud) -> usize {
    let off = |point: usize| (cloud.position[point] - 0.5 * cloud.size).length();
    (0..cloud.interior).min_by(|&a, &b| off(a).total_cmp(&off(b))).expect("a point")
}

/// Without the interior points for which `drop` holds, and with some more.
fn changed(mut cloud: Cloud, drop: impl Fn(DVec2) -> bool, more: &[DVec2]) -> Cloud {
    let walls = cloud.position.split_off(cloud.interior);
    cloud.position.retain(|&place| !drop(place));
    cloud.position.extend_from_slice(more);
    cloud.interior = cloud.position.len();
    cloud.position.extend(walls);
    cloud
}

/// The middle point has another so many spacings away.
pub fn doubled(spacings: f64) -> Cloud {
    let cloud = cloud();
    let place = cloud.position[middle(&cloud)] + spacings * cloud.spacing * DVec2::new(0.8, 0.6);
    changed(cloud, |_| false, &[place])
}

/// Without the points nearer to the middle one than so many spacings.
pub fn around(reach: f64) -> Cloud {
    let cloud = cloud();
    let (centre, reach) = (cloud.position[middle(&cloud)], reach * cloud.spacing);
    changed(cloud, move |place| place != centre && (place - centre).length() < reach, &[])
}

/// So many points along either side of a square of one spacing beside the middle one.
pub fn cluster(count: i32) -> Cloud {
    let cloud = cloud();
    let centre = cloud.position[middle(&cloud)];
    let step = 0.9 * cloud.spacing / f64::from(count);
    let more: Vec<DVec2> = (1..=count)
        .flat_map(|i| (1..=count).map(move |j| centre + step * DVec2::new(f64::from(i), f64::from(j))))
        .collect();
    changed(cloud, |_| false, &more)
}

/// How far the velocities of a cavity are from those in metres, in the lid's.
pub fn scaled(metres: f64, open: Open) -> f64 {
    let scaled = |metres: f64| {
        let case = cavity(&["cloud.arrangement=jittered", "time.end=0.5"]);
        flow(&cases::scaled(case, metres), None, open)
    };
    match (scaled(1.0), scaled(metres)) {
        (Ok(one), Ok(other)) if other.ended() => {
            let pairs = one.outcome.snapshot.velocity.iter().zip(&other.outcome.snapshot.velocity);
            pairs.map(|(a, b)| (*a - *b / metres).length()).fold(0.0, f64::max)
        }
        _ => f64::NAN,
    }
}

/// Of the undisturbed flow.
pub fn energy() -> f64 {
    flow_of(&plain(&[])).expect("the undisturbed flow").energy()
}

const COLLOCATED: &str = "effects.pressure.form=collocated";

pub fn rows() -> Vec<Row> {
    let right = energy();
    let spacing = 1.0 / ACROSS as f64;
    let mut rows = Vec::new();
    let on = |case: &str, promise: Promise, changes: &[&str], cloud: Cloud| {
        Row::of_flow(case, promise, &flow(&plain(changes), Some(cloud), cpu::double), Some(right))
    };
    // Few neighbours.
    rows.push(on(
        "a point with 4 neighbours",
        Promise::Refused("4 neighbours; allowed: a radius that gives every point 5"),
        &[],
        {
            let cloud = cloud();
            let centre = cloud.position[middle(&cloud)];
            changed(
                cloud,
                |place| {
                    place != centre
                        && (place - centre).length() > 1.1 * spacing
                        && (place - centre).length() < 2.7 * spacing
                },
                &[],
            )
        },
    ));
    rows.push(on("a point without neighbours", Promise::Refused("has 0 neighbours"), &[], around(2.7)));
    rows.push(on("a ring of 8 neighbours gone", Promise::Right(0.01), &[], around(1.5)));
    rows.push(on("a ring of 8 neighbours gone, collocated", Promise::Bounded(1.0), &[COLLOCATED], around(1.5)));
    // Neighbours on a line.
    let line = || {
        let cloud = cloud();
        let centre = cloud.position[middle(&cloud)];
        let more: Vec<DVec2> =
            (-2..=2).filter(|&k| k != 0).map(|k| centre + 0.4 * f64::from(k) * spacing * DVec2::X).collect();
        changed(
            cloud,
            |place| {
                (place - centre).y.abs() < 2.7 * spacing && (place - centre).x.abs() < 3.2 * spacing && place != centre
            },
            &more,
        )
    };
    rows.push(on("a row of points alone in a hole", Promise::Refused("neighbours; allowed"), &[], line()));
    let mut linear = plain(&[]);
    (linear.effects.viscosity, linear.method.order) = (None, 1);
    let inviscid = flow(&linear, Some(line()), cpu::double);
    rows.push(Row::of_flow(
        "a row of points alone in a hole, order 1, no viscosity",
        Promise::Bounded(1.0),
        &inviscid,
        None,
    ));
    // Points that nearly coincide.
    for exponent in 3..=7 {
        let name = |form: &str| format!("two points 1e-{exponent} spacings apart{form}");
        let two = || doubled(10_f64.powi(-exponent));
        rows.push(on(&name(""), Promise::Right(0.01), &[], two()));
        rows.push(on(&name(", collocated"), Promise::Bounded(1.0), &[COLLOCATED], two()));
    }
    let single = flow(&plain(&[]), Some(doubled(1e-3)), cpu::single);
    rows.push(Row::of_flow("two points 1e-3 spacings apart, f32", Promise::Right(0.01), &single, Some(right)));
    rows.push(on("two points 1e-9 spacings apart", Promise::Refused("coincide"), &[], doubled(1e-9)));
    rows.push(on("the same point twice", Promise::Refused("coincide"), &[], doubled(0.0)));
    // Clusters and holes.
    rows.push(on("9 points in the square of 1 spacing", Promise::Right(0.01), &[], cluster(3)));
    rows.push(on("36 points in the square of 1 spacing", Promise::Right(0.01), &[], cluster(6)));
    rows.push(on("36 points in the square of 1 spacing, collocated", Promise::Bounded(1.0), &[COLLOCATED], cluster(6)));
    let hole = |reach: f64| changed(cloud(), move |place| (place - DVec2::splat(0.5)).length() < reach * spacing, &[]);
    rows.push(on("a hole of 3 spacings across", Promise::Right(0.01), &[], hole(1.5)));
    rows.push(on("a hole of 6 spacings across, radius 4", Promise::Bounded(1.0), &["method.radius=4.0"], hole(3.0)));
    // Jitter.
    for (name, changes) in [
        ("", &[][..]),
        (", fitted faces", &[FIT]),
        (", collocated", &[COLLOCATED, "method.radius=3.1"]),
        (", forward remap", &["effects.advection.remap=forward"]),
    ] {
        let jitter = plain(&[&["cloud.arrangement=jittered", "cloud.jitter=0.49"], changes].concat());
        let promise = if [", collocated", ", forward remap"].contains(&name) {
            Promise::Bounded(1.0)
        } else {
            Promise::Right(0.1)
        };
        rows.push(Row::of_flow(format!("jitter 0.49{name}"), promise, &flow_of(&jitter), Some(right)));
    }
    rows.push(Row::of_flow(
        "jitter 0.5",
        Promise::Refused("must be a number from 0 to below 0.5"),
        &refused(&["cloud.arrangement=jittered", "cloud.jitter=0.5"]),
        None,
    ));
    // Shapes of the domain.
    let long = problem(
        4,
        &[
            "domain.width=1000.0",
            "cloud.arrangement=regular",
            "poisson.field=cosines",
            "effects.pressure.solver=conjugate_gradient",
            "effects.pressure.tolerance=1e-10",
            "effects.pressure.max_iterations=20000",
        ],
    );
    let alone = flow_of(&long);
    let error = alone.as_ref().ok().zip(Known::of(&long)).map_or(f64::NAN, |(flow, known)| {
        let snapshot = &flow.outcome.snapshot;
        let pairs = snapshot.position.iter().zip(&snapshot.pressure);
        let square: f64 = pairs.map(|(&place, p)| (p - known.value(place)).powi(2)).sum();
        (square / snapshot.position.len() as f64).sqrt()
    });
    rows.push(Row::of_error("sides of 1000 : 1, the pressure equation alone, 4 spacings across", 0.1, error));
    let mut channel = cavity_of(
        4,
        &[
            "domain.width=1000.0",
            "domain.periodic=x",
            "time.end=2.0",
            "effects.viscosity.kinematic=1.0",
            "time.step=0.01",
        ],
    );
    channel.effects.advection = None;
    let couette = flow_of(&channel);
    let error = couette.as_ref().map_or(f64::NAN, |flow| {
        let places = flow.outcome.snapshot.position.iter().zip(&flow.outcome.snapshot.velocity);
        places.map(|(place, u)| (*u - DVec2::new(place.y, 0.0)).length()).fold(0.0, f64::max)
    });
    rows.push(Row::of_error("sides of 1000 : 1, a channel 4 spacings high", 1e-6, error));
    rows.push(Row::of_flow(
        "a gap of 3 spacings",
        Promise::Refused("4 spacings to the shorter side"),
        &refused(&["domain.height=0.1875", "cloud.spacing=0.0625"]),
        None,
    ));
    // Units.
    for (name, metres, open, within) in [
        ("nanometres, f64", 1e-9, cpu::double as Open, 1e-9),
        ("kilometres, f64", 1e3, cpu::double, 1e-9),
        ("micrometres, f32", 1e-6, cpu::single, 1e-3),
        ("kilometres, f32", 1e3, cpu::single, 1e-3),
    ] {
        rows.push(Row::of_error(format!("a cavity in {name}, against metres"), within, scaled(metres, open)));
    }
    // Pools that do not touch.
    let pools = || changed(cloud(), |place| (place.x - 0.5).abs() < 1.6 * spacing, &[]);
    let walls = |mut cloud: Cloud| {
        let keep: Vec<bool> =
            cloud.position[cloud.interior..].iter().map(|place| (place.x - 0.5).abs() >= 1.6 * spacing).collect();
        let mut at = 0;
        let interior = cloud.interior;
        let mut index = 0;
        cloud.position.retain(|_| {
            index += 1;
            index <= interior || keep[index - 1 - interior]
        });
        cloud.normal.retain(|_| {
            at += 1;
            keep[at - 1]
        });
        at = 0;
        cloud.sides.retain(|_| {
            at += 1;
            keep[at - 1]
        });
        cloud
    };
    rows.push(on("two pools out of each other's sight", Promise::Bounded(1.0), &["method.radius=2.1"], walls(pools())));
    rows.push(on(
        "two pools out of each other's sight, collocated",
        Promise::Refused("2 groups out of each other's sight"),
        &["method.radius=2.1", COLLOCATED],
        walls(pools()),
    ));
    // Points nowhere.
    let moved = |place: DVec2| {
        let mut cloud = cloud();
        cloud.position[7] = place;
        cloud
    };
    rows.push(on(
        "a point outside the domain",
        Promise::Refused("point 7 at (1.5, 0.5) m is outside the domain"),
        &[],
        moved(DVec2::new(1.5, 0.5)),
    ));
    rows.push(on(
        "a point at NaN",
        Promise::Refused("point 7 at (NaN, 0.5) m is outside the domain"),
        &[],
        moved(DVec2::new(f64::NAN, 0.5)),
    ));
    rows.push(on(
        "no points",
        Promise::Refused("the cloud has no points inside"),
        &[],
        changed(cloud(), |_| true, &[]),
    ));
    // Vortices over the seam of a periodic box.
    let still = flow_of(&vortices(16, &["cloud.arrangement=regular"])).expect("vortices").energy();
    let across = flow_of(&vortices(16, &["cloud.arrangement=jittered", "cloud.jitter=0.49", FIT]));
    rows.push(Row::of_flow("a periodic box, jitter 0.49, fitted faces", Promise::Right(0.05), &across, Some(still)));
    rows
}

fn refused(changes: &[&str]) -> Result<crate::flow::Flow, String> {
    crate::table_of_input::from_keys(changes)
}
