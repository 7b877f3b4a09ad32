//! Hard cases of sharp corners, and of a pressure that is given all around.

use glam::DVec2;
use stillpoint::case::{Case, Obstacle};

use crate::cases::{FIT, cavity_of};
use crate::flow::flow_of;
use crate::table::{Promise, Row};

const JITTERED: &str = "cloud.arrangement=jittered";
const RELAXED: &str = "cloud.arrangement=relaxed";

fn beside(case: Case, corners: &[[f64; 2]]) -> Case {
    let obstacle = Obstacle { name: "body".to_owned(), circle: None, polygon: Some(corners.to_vec()), parts: None };
    Case { obstacles: vec![obstacle], ..case }
}

/// A triangle whose tip has so many degrees.
fn spike(degrees: f64) -> Vec<[f64; 2]> {
    let half = 0.4 * (0.5 * degrees.to_radians()).tan();
    vec![[0.3, 0.5 - half], [0.7, 0.5], [0.3, 0.5 + half]]
}

/// Two arms at a right angle: the fluid between them has a corner of 90 degrees, at the end of each it turns by 270.
const ANGLE: [[f64; 2]; 6] = [[0.3, 0.3], [0.7, 0.3], [0.7, 0.45], [0.45, 0.45], [0.45, 0.7], [0.3, 0.7]];

/// A star of five tips of 36 degrees.
fn star() -> Vec<[f64; 2]> {
    let corner = |k: u32| {
        let radius = if k.is_multiple_of(2) { 0.25 } else { 0.0955 };
        (DVec2::splat(0.5) + radius * DVec2::from_angle(f64::from(k) * 36_f64.to_radians() + 0.1)).to_array()
    };
    (0..10).map(corner).collect()
}

pub fn rows() -> Vec<Row> {
    let mut rows = Vec::new();
    let thin = &["effects.viscosity.kinematic=1e-4"][..];
    for (name, corners) in [
        ("a spike of 10 degrees", spike(10.0)),
        ("a spike of 40 degrees", spike(40.0)),
        ("a re-entrant corner", ANGLE.to_vec()),
        ("a star of five tips", star()),
    ] {
        let relaxed = &[RELAXED, "method.radius=2.8"];
        for (what, changes) in
            [("", &[][..]), (", jittered, fitted faces", &[JITTERED, FIT]), (", relaxed", relaxed), (", Re 1e4", thin)]
        {
            let case = beside(cavity_of(32, &[&["time.end=0.5"], changes].concat()), &corners);
            rows.push(Row::of_flow(format!("{name}{what}"), Promise::Bounded(1.0), &flow_of(&case), None));
        }
    }
    let needle = beside(cavity_of(32, &[]), &spike(0.1));
    let promise = Promise::Refused("neighbours would see each other through it");
    rows.push(Row::of_flow("a needle of 0.1 degrees", promise, &flow_of(&needle), None));
    rows.extend(given_all_around());
    rows
}

/// Fluid between four outlets, where the pressure is 0: nothing holds it, and it falls, to 0.5 m/s.
fn given_all_around() -> Vec<Row> {
    let sides = ["left", "right", "bottom", "top"].map(|side| format!("boundaries.{side}={{ kind = 'outlet' }}"));
    let mut fall: Vec<&str> = sides.iter().map(String::as_str).collect();
    fall.extend(["effects.gravity.acceleration=[0.0, -1.0]", "time.end=0.5"]);
    let of = |(what, changes): (&str, &[&str])| {
        let flow = flow_of(&cavity_of(16, &[&fall, changes].concat()));
        Row::of_flow(format!("pressure 0 all around{what}"), Promise::Right(1e-9), &flow, Some(0.125))
    };
    let variants: [(&str, &[&str]); 5] = [
        ("", &[]),
        (", jittered", &[JITTERED]),
        (", jittered, fitted faces", &[JITTERED, FIT]),
        (", direct", &["effects.pressure.solver=direct"]),
        (", projection", &["time.splitting=projection"]),
    ];
    variants.into_iter().map(of).collect()
}
