//! The interpolation form: exact on quadratics wherever a point stands, and its orders of convergence.

use glam::DVec2;
use stillpoint::case::Case;
use stillpoint::step::{Buffer, Operation, Points, Rung, Stage};

use crate::bench::{Bench, Derivatives, most, order};
use crate::cases::{ARRANGEMENTS, cavity, cavity_of};
use crate::random::Random;

/// `c0 + c1 x + c2 y + c3 x^2 + c4 xy + c5 y^2` with its derivatives.
struct Quadratic([f64; 6]);

impl Quadratic {
    fn random(random: &mut Random) -> Self {
        Self(std::array::from_fn(|_| random.number()))
    }

    fn value(&self, p: DVec2) -> f64 {
        let c = &self.0;
        c[0] + c[1] * p.x + c[2] * p.y + c[3] * p.x * p.x + c[4] * p.x * p.y + c[5] * p.y * p.y
    }

    fn gradient(&self, p: DVec2) -> DVec2 {
        let c = &self.0;
        DVec2::new(c[1] + 2.0 * c[3] * p.x + c[4] * p.y, c[2] + c[4] * p.x + 2.0 * c[5] * p.y)
    }

    fn laplacian(&self) -> f64 {
        2.0 * (self.0[3] + self.0[5])
    }
}

/// Largest error of the gradients and Laplacians of two random quadratics over all points, times `r_e` and `r_e^2`, and over
/// the largest change of the field across a neighbourhood.
fn quadratic_error(bench: &mut Bench, seed: u64, twist: f64) -> f64 {
    let mut random = Random::new(seed);
    let [u, v] = std::array::from_fn(|_| Quadratic::random(&mut random));
    let velocity = bench.sample(|p| DVec2::new(u.value(p) + twist * p.x.powi(3), v.value(p)));
    let derivatives = bench.derivatives(&velocity);
    let change = bench.scene.constants.radius;
    let error = |(place, found): (&DVec2, &Derivatives)| {
        let of = |part: usize, exact: &Quadratic| {
            let gradient = found.support * (found.gradient[part] - exact.gradient(*place)).length();
            let laplacian = found.support.powi(2) * (found.laplacian[part] - exact.laplacian()).abs();
            most(gradient, laplacian) / change
        };
        most(of(0, &u), of(1, &v))
    };
    bench.scene.cloud.position.iter().zip(&derivatives).map(error).fold(0.0, most)
}

fn cases() -> Vec<(String, Case)> {
    let mut cases = Vec::new();
    for (name, arrangement) in ARRANGEMENTS {
        for weight in ["method.weight=none", "method.weight=quadratic"] {
            for shape in [&[][..], &["domain.width=4.0"]] {
                let overrides = [arrangement, &[weight], shape].concat();
                cases.push((format!("{overrides:?}"), cavity(&overrides)));
                if name == "random" {
                    for seed in ["cloud.seed=2", "cloud.seed=3", "cloud.seed=4"] {
                        let overrides = [&overrides[..], &[seed]].concat();
                        cases.push((format!("{overrides:?}"), cavity(&overrides)));
                    }
                }
            }
        }
    }
    cases
}

#[test]
fn gradients_and_laplacians_of_quadratics_are_exact_at_every_point() {
    for (name, case) in cases() {
        let mut bench = Bench::new(&case);
        let rungs = bench.indexes(Buffer::Rung(Points::Standing));
        assert!(rungs.iter().all(|&rung| rung < Rung::LINEAR), "{name}: a full fit everywhere");
        for seed in 0..3 {
            let error = quadratic_error(&mut bench, seed, 0.0);
            assert!(error < 1e-9, "{name}: {error:e}");
        }
    }
}

#[test]
fn a_trace_of_a_cubic_spoils_exactness() {
    for (name, case) in cases() {
        let error = quadratic_error(&mut Bench::new(&case), 0, 1e-4);
        assert!(error > 1e-8, "{name}: {error:e}");
    }
}

/// The operations that use the fits, held against the fits' own coefficients above.
#[test]
fn viscosity_and_correction_are_the_laplacian_and_the_gradient() {
    for (name, case) in cases() {
        let mut bench = Bench::new(&case);
        let interior = bench.scene.sizes.interior;
        let (quadratic, half) = (Quadratic([0.3, -0.2, 0.5, 0.7, -0.9, 0.4]), 0.5);
        bench.clock.kick = half;

        let field = bench.sample(|p| DVec2::new(quadratic.value(p), -quadratic.value(p)));
        let diffused = Buffer::Velocity;
        bench.write_vectors(diffused, &field);
        bench.write_vectors(Buffer::Kick, &[]);
        bench.apply(&[Operation::Viscosity(Stage::Start)]);
        let expected = half * 0.01 * quadratic.laplacian();
        let kicks = bench.vectors(Buffer::Kick);
        let off = kicks[..interior].iter().map(|kick| (*kick - DVec2::new(expected, -expected)).length());
        assert!(off.fold(0.0, most) < 1e-9, "{name}: viscosity");
        assert!(kicks[interior..].iter().all(|&kick| kick == DVec2::ZERO), "{name}: walls are not kicked");

        let pressure = bench.sample(|p| quadratic.value(p));
        bench.write_scalars(Buffer::Pressure, &pressure);
        bench.write_vectors(Buffer::Projected, &[]);
        bench.apply(&[Operation::CorrectByFit]);
        let places = bench.scene.cloud.position.clone();
        let corrected = bench.vectors(Buffer::Projected);
        let off = corrected[..interior].iter().zip(&places).map(|(u, &p)| (*u + half * quadratic.gradient(p)).length());
        assert!(off.fold(0.0, most) < 1e-9, "{name}: correction");
        assert!(corrected[interior..].iter().all(|&u| u == DVec2::ZERO), "{name}: walls are not corrected");
    }
}

/// Rms errors of the gradient over all points and of the Laplacian over those whose neighbourhood no wall cuts.
fn smooth_errors(n: usize, overrides: &[&str]) -> [f64; 2] {
    let mut bench = Bench::new(&cavity_of(n, overrides));
    let u = |p: DVec2| (3.0 * p.x + 1.0).sin() * (4.0 * p.y).cos();
    let velocity = bench.sample(|p| DVec2::new(u(p), 0.0));
    let derivatives = bench.derivatives(&velocity);
    let radius = bench.scene.constants.radius;
    let (mut gradient, mut laplacian, mut deep) = (0.0, 0.0, 0);
    for (&p, found) in bench.scene.cloud.position.iter().zip(&derivatives) {
        let exact = DVec2::new(
            3.0 * (3.0 * p.x + 1.0).cos() * (4.0 * p.y).cos(),
            -4.0 * (3.0 * p.x + 1.0).sin() * (4.0 * p.y).sin(),
        );
        gradient += (found.gradient[0] - exact).length_squared();
        if p.min(1.0 - p).min_element() > radius {
            laplacian += (found.laplacian.x + 25.0 * u(p)).powi(2);
            deep += 1;
        }
    }
    [(gradient / derivatives.len() as f64).sqrt(), (laplacian / deep as f64).sqrt()]
}

#[test]
fn gradients_converge_at_order_two_and_laplacians_at_order_one_or_on_lattices_two() {
    for (name, arrangement) in ARRANGEMENTS {
        for weight in ["method.weight=none", "method.weight=quadratic"] {
            let overrides = [arrangement, &[weight]].concat();
            let (coarse, fine) = (smooth_errors(20, &overrides), smooth_errors(80, &overrides));
            let [gradient, laplacian] = std::array::from_fn(|k| order((20, coarse[k]), (80, fine[k])));
            assert!(gradient > 1.9, "{name}, {weight}: gradient of order {gradient}");
            let least = if name == "regular" { 1.9 } else { 0.95 };
            assert!(laplacian > least, "{name}, {weight}: Laplacian of order {laplacian}");
        }
    }
}
