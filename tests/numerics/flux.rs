//! The flux of a velocity out of every Voronoi cell, fitted on the faces: exact for quadratics, conservative for anything.

use glam::{DMat2, DVec2};
use stillpoint::cloud::Cloud;
use stillpoint::cloud::flux::Fluxes;
use stillpoint::cloud::voronoi::Cells;

use crate::bench::{most, order};
use crate::cases::{ARRANGEMENTS, cavity, vortices};
use crate::random::Random;

fn built(cloud: &Cloud) -> (Cells, Fluxes) {
    let cells = Cells::build(cloud);
    let fluxes = Fluxes::build(cloud, &cells, 2.8);
    (cells, fluxes)
}

fn clouds() -> Vec<(String, Cloud)> {
    let mut clouds = Vec::new();
    for (name, arrangement) in ARRANGEMENTS {
        clouds.push((format!("{name}, walls"), Cloud::build(&cavity(arrangement)).expect("a cloud")));
        clouds.push((format!("{name}, periodic"), Cloud::build(&vortices(20, arrangement)).expect("a cloud")));
    }
    clouds
}

fn flux(fluxes: &Fluxes, cell: usize, velocity: impl Fn(usize) -> DVec2) -> f64 {
    fluxes.row(cell).map(|(k, factor)| factor.dot(velocity(k))).sum()
}

#[test]
fn the_flux_of_a_linear_velocity_is_its_divergence_times_the_volume() {
    let slope = DMat2::from_cols(DVec2::new(1.3, -0.4), DVec2::new(0.7, 0.9));
    for (name, cloud) in clouds().into_iter().filter(|(name, _)| name.ends_with("walls")) {
        let (cells, fluxes) = built(&cloud);
        let deep = |i: usize| (cloud.position[i].min(cloud.size - cloud.position[i])).min_element() > 0.1;
        for cell in (0..cloud.interior).filter(|&i| deep(i)) {
            let found = flux(&fluxes, cell, |k| slope * cloud.position[k]);
            let right = cells.volume[cell] * (1.3 + 0.9);
            // Faces of less than 1e-7 spacings are left out.
            assert!((found - right).abs() < 1e-6 * right, "{name}, cell {cell}: {found} {right}");
        }
    }
}

#[test]
fn of_two_cells_one_gains_what_the_other_loses_whatever_the_velocity() {
    let mut random = Random::new(3);
    for (name, cloud) in clouds() {
        let (cells, fluxes) = built(&cloud);
        let velocity: Vec<DVec2> = (0..cloud.len()).map(|_| random.vector()).collect();
        let all: f64 = (0..cloud.len()).map(|cell| flux(&fluxes, cell, |k| velocity[k])).sum();
        let size: f64 = (0..cloud.len()).map(|cell| flux(&fluxes, cell, |k| velocity[k]).abs()).sum();
        assert!(all.abs() < 1e-13 * size && size > 1.0, "{name}: {all} of {size}");
        assert_eq!(cells.start.len(), cloud.len() + 1);
    }
}

/// Largest error of the divergence of a divergence-free velocity on a periodic cloud, by fitted faces and by plain ones.
fn divergence(n: usize, arrangement: &[&str]) -> [f64; 2] {
    let cloud = Cloud::build(&vortices(n, arrangement)).expect("a cloud");
    let (cells, fluxes) = built(&cloud);
    let wave = |p: DVec2| {
        let [x, y] = (std::f64::consts::TAU * p).to_array();
        DVec2::new(x.cos() * y.sin(), -x.sin() * y.cos())
    };
    let of = |cell: usize| {
        let fitted = flux(&fluxes, cell, |k| wave(cloud.position[k]));
        let plain = |(other, weight): (usize, f64)| {
            let offset = stillpoint::cloud::shortest(cloud.position[other] - cloud.position[cell], cloud.period);
            0.5 * weight * offset.dot(wave(cloud.position[cell]) + wave(cloud.position[other]))
        };
        [fitted, cells.faces(cell).map(plain).sum::<f64>()].map(|flux| (flux / cells.volume[cell]).abs())
    };
    (0..cloud.len()).map(of).fold([0.0; 2], |[a, b], [c, d]| [most(a, c), most(b, d)])
}

#[test]
fn the_divergence_is_of_second_order_on_scattered_points_where_that_of_plain_faces_does_not_fall() {
    for (name, arrangement) in &ARRANGEMENTS[1..] {
        let [coarse, fine] = [24, 96].map(|n| divergence(n, arrangement));
        let [fitted, plain] = [0, 1].map(|k| order((24, coarse[k]), (96, fine[k])));
        assert!(fitted > 1.6, "{name}: order {fitted}, {coarse:?} to {fine:?}");
        assert!(plain < 0.5, "{name}: order {plain} of plain faces, {coarse:?} to {fine:?}");
    }
}
