//! Voronoi cells: the identities of closed cells on which the conservative pressure equation rests.

use glam::DVec2;
use stillpoint::cloud::Cloud;
use stillpoint::cloud::voronoi::Cells;

use crate::cases::{ARRANGEMENTS, cavity};

fn clouds() -> Vec<(String, Cloud)> {
    let mut clouds = Vec::new();
    for (name, arrangement) in ARRANGEMENTS {
        for shape in [&[][..], &["domain.width=4.0"]] {
            for seed in [1, 2, 3] {
                let seed = format!("cloud.seed={seed}");
                let seed = if name == "regular" { None } else { Some(seed.as_str()) };
                let overrides: Vec<&str> = arrangement.iter().chain(shape).copied().chain(seed).collect();
                clouds
                    .push((format!("{name} {shape:?} {seed:?}"), Cloud::build(&cavity(&overrides)).expect("a cloud")));
            }
        }
    }
    clouds
}

fn cells(cloud: &Cloud) -> Cells {
    Cells::build(cloud)
}

/// `sum_j w_ij d_ij` and `sum_j w_ij |d_ij|^2 - 4 V_i` of one cell, in spacings.
fn closure(cloud: &Cloud, cells: &Cells, point: usize) -> (DVec2, f64) {
    let own = cloud.position[point];
    let (mut first, mut second) = (DVec2::ZERO, 0.0);
    for (other, weight) in cells.faces(point) {
        let offset = (cloud.position[other] - own) / cloud.spacing;
        first += weight * offset;
        second += weight * offset.length_squared();
    }
    (first, second - 4.0 * cells.volume[point] / cloud.spacing.powi(2))
}

/// True where the cell of a point surely touches no wall: a wall is farther away than any corner of a cell.
fn is_deep(cloud: &Cloud, place: DVec2) -> bool {
    place.min(cloud.size - place).min_element() > 2.0 * cloud.spacing
}

#[test]
fn volumes_are_positive_and_sum_to_the_area() {
    for (name, cloud) in clouds() {
        let cells = cells(&cloud);
        let area = cloud.size.x * cloud.size.y;
        let sum: f64 = cells.volume.iter().sum();
        assert!((sum - area).abs() < 1e-12 * area, "{name}: {sum}");
        assert!(cells.volume.iter().all(|&volume| volume > 0.0), "{name}");
    }
}

#[test]
fn cells_that_touch_no_wall_are_closed() {
    for (name, cloud) in clouds() {
        let cells = cells(&cloud);
        let deep: Vec<usize> = (0..cloud.interior).filter(|&i| is_deep(&cloud, cloud.position[i])).collect();
        assert!(deep.len() > cloud.interior / 2, "{name}");
        for point in deep {
            let (first, second) = closure(&cloud, &cells, point);
            // Faces of less than 1e-7 spacings are left out.
            assert!(first.length() < 1e-6 && second.abs() < 1e-6, "{name}, point {point}: {first} {second}");
        }
    }
}

#[test]
fn what_is_open_adds_up_to_the_walls() {
    for (name, cloud) in clouds() {
        let cells = cells(&cloud);
        // sum_j w_ij d_ij = -A_i n_i, so that each half of the rectangle adds up to the side it holds.
        let middle = 0.5 * cloud.size;
        let mut sides = [DVec2::ZERO; 2];
        for point in 0..cloud.len() {
            let open = closure(&cloud, &cells, point).0 * cloud.spacing;
            let lower = cloud.position[point].cmplt(middle);
            sides[usize::from(!lower.x)].x += open.x;
            sides[usize::from(!lower.y)].y += open.y;
        }
        let expected = DVec2::new(cloud.size.y, cloud.size.x);
        let off = (sides[0] - expected).abs().max((sides[1] + expected).abs());
        assert!(off.max_element() < 1e-6 * cloud.size.max_element(), "{name}: {sides:?}");
    }
}

#[test]
fn a_shifted_point_opens_its_cell() {
    let (_, mut cloud) = clouds().remove(6);
    let cells = cells(&cloud);
    let point = (0..cloud.interior).find(|&i| is_deep(&cloud, cloud.position[i])).expect("a deep point");
    let shift = 1e-4 * cloud.spacing;
    cloud.position[point].x += shift;
    assert!(closure(&cloud, &cells, point).0.length() > 1e-5);
}

#[test]
fn weights_are_positive_and_the_same_bits_from_both_sides() {
    for (name, cloud) in clouds() {
        let cells = cells(&cloud);
        for point in 0..cloud.len() {
            for (other, weight) in cells.faces(point) {
                assert!(weight > 0.0 && other != point, "{name}: {point} {other}");
                let back: Vec<u64> =
                    cells.faces(other).filter(|&(back, _)| back == point).map(|(_, back)| back.to_bits()).collect();
                assert_eq!(back, [weight.to_bits()], "{name}: {point} {other}");
            }
        }
    }
}

#[test]
fn lattice_cells_have_four_faces_and_scattered_ones_six_on_average() {
    for (name, cloud) in clouds() {
        let cells = cells(&cloud);
        let deep: Vec<usize> = (0..cloud.interior).filter(|&i| is_deep(&cloud, cloud.position[i])).collect();
        let faces = |point: usize| cells.start[point + 1] - cells.start[point];
        if name.starts_with("regular") {
            assert!(deep.iter().all(|&point| faces(point) == 4), "{name}");
            assert!(deep.iter().all(|&point| cells.faces(point).all(|(_, weight)| (weight - 1.0).abs() < 1e-12)));
        } else {
            let mean = deep.iter().map(|&point| faces(point)).sum::<usize>() as f64 / deep.len() as f64;
            assert!((mean - 6.0).abs() < 0.15, "{name}: {mean}");
            assert!(deep.iter().all(|&point| (3..=12).contains(&faces(point))), "{name}");
        }
        assert_eq!(cells.most_faces(), (0..cloud.len()).map(faces).max().unwrap_or(0), "{name}");
    }
}
