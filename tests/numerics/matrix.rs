//! The pressure matrices as the engine multiplies by them, and what their forms promise.

use stillpoint::cpu::operations::collocated::Collocated;
use stillpoint::cpu::operations::conservative::{Conservative, Faces};
use stillpoint::cpu::operations::lists::Lists;
use stillpoint::cpu::operations::pressure::Rows;
use stillpoint::cpu::real::{Pack, Real};
use stillpoint::step::{Buffer, Operation, Points};

use crate::bench::Bench;
use crate::cases::{ARRANGEMENTS, cavity};
use crate::random::Random;

type Lanes = <f64 as Real>::Pack;

fn rows_times(rows: &impl Rows<f64>, p: &[f64]) -> Vec<f64> {
    let mut product = vec![0.0; p.len()];
    rows.multiply(0..p.len(), p, |i, value: Lanes| value.store(&mut product[i..]));
    product
}

/// The engine's pressure matrix times `p`, one number a point.
pub fn product(bench: &mut Bench, p: &[f64]) -> Vec<f64> {
    let sizes = bench.scene.sizes;
    let mut padded = p.to_vec();
    padded.resize(bench.scene.padded(), 0.0);
    let mut product = if bench.scene.cells().is_some() {
        let (neighbours, count) = (bench.indexes(Buffer::FaceNeighbours), bench.indexes(Buffer::FaceCount));
        let (weight, volume) = (bench.reals(Buffer::FaceWeight), bench.reals(Buffer::Volume));
        let faces = Faces { neighbours: &neighbours, weight: &weight, count: &count, capacity: sizes.face_capacity };
        rows_times(&Conservative { faces, per_volume: &volume }, &padded)
    } else {
        let neighbours = bench.indexes(Buffer::Neighbours(Points::Standing));
        let count = bench.indexes(Buffer::NeighbourCount(Points::Standing));
        let row = bench.reals(Buffer::MatrixRow);
        let lists = Lists { neighbours: &neighbours, count: &count, capacity: sizes.capacity };
        rows_times(&Collocated { lists, row: &row }, &padded)
    };
    product.truncate(sizes.points);
    product
}

pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// `|x . A y - y . A x|` over the size of its terms, for random x and y.
fn asymmetry(overrides: &[&str]) -> f64 {
    let mut bench = Bench::new(&cavity(overrides));
    let mut random = Random::new(3);
    let (x, y) = (random.numbers(bench.points()), random.numbers(bench.points()));
    let (ax, ay) = (product(&mut bench, &x), product(&mut bench, &y));
    let (one, other) = (dot(&x, &ay), dot(&y, &ax));
    (one - other).abs() / (dot(&ax, &ax) * dot(&y, &y)).sqrt()
}

#[test]
fn the_conservative_matrix_is_symmetric_and_the_collocated_one_is_not() {
    for (name, arrangement) in ARRANGEMENTS {
        let conservative = asymmetry(arrangement);
        assert!(conservative < 1e-15, "{name}: {conservative:e}");
        let collocated = asymmetry(&[arrangement, &["effects.pressure.form=collocated"][..]].concat());
        assert!(collocated > 1e-4, "{name}: {collocated:e}");
    }
}

#[test]
fn both_matrices_have_the_constants_in_their_null_space_and_one_has_nothing_else() {
    for (name, arrangement) in ARRANGEMENTS {
        for form in ["effects.pressure.form=conservative", "effects.pressure.form=collocated"] {
            let mut bench = Bench::new(&cavity(&[arrangement, &[form]].concat()));
            let ones = vec![1.0; bench.points()];
            assert!(product(&mut bench, &ones).iter().all(|&entry| entry == 0.0), "{name}, {form}");
        }
        let mut bench = Bench::new(&cavity(arrangement));
        for seed in 0..20 {
            let x = Random::new(seed).numbers(bench.points());
            let kx = product(&mut bench, &x);
            assert!(dot(&x, &kx) > 0.1 * dot(&x, &x), "{name}: positive but for constants");
        }
    }
}

#[test]
fn the_conservative_source_sums_to_zero_and_the_collocated_one_does_not() {
    for (name, arrangement) in ARRANGEMENTS {
        let sums = |form: &str, operation: Operation| {
            let mut bench = Bench::new(&cavity(&[arrangement, &[form]].concat()));
            let mut random = Random::new(11);
            let predicted: Vec<_> = (0..bench.points()).map(|_| random.vector()).collect();
            bench.write_vectors(Buffer::Projected, &predicted);
            bench.apply(&[operation]);
            let source = bench.scalars(Buffer::Source);
            source.iter().sum::<f64>().abs() / source.iter().map(|b| b.abs()).sum::<f64>()
        };
        let conservative = sums("effects.pressure.form=conservative", Operation::Divergence);
        assert!(conservative < 1e-15, "{name}: {conservative:e}");
        let collocated = sums("effects.pressure.form=collocated", Operation::CollocatedSource);
        assert!(collocated > 1e-6, "{name}: {collocated:e}");
    }
}

#[test]
fn the_divergence_of_a_rotation_with_expansion_is_exact_in_cells_that_touch_no_wall() {
    for (name, arrangement) in ARRANGEMENTS {
        let mut bench = Bench::new(&cavity(arrangement));
        let predicted = bench.sample(|p| glam::DVec2::new(0.35 * p.x - p.y + 2.0, p.x + 0.35 * p.y));
        bench.write_vectors(Buffer::Projected, &predicted);
        bench.apply(&[Operation::Divergence]);
        let (source, volume) = (bench.scalars(Buffer::Source), bench.scalars(Buffer::Volume));
        let deep = |p: glam::DVec2| p.min(1.0 - p).min_element() > 0.1;
        for (point, &place) in bench.scene.cloud.position.iter().enumerate().filter(|(_, p)| deep(**p)) {
            // b = -(rho / dt) V div u.
            let divergence = -source[point] / volume[point];
            assert!((divergence - 0.7).abs() < 1e-5, "{name}: {divergence} at {place}");
        }
    }
}
