//! Orders 1 to 4 and the two families of operators: exact on polynomials, orders of convergence, and what scattered points do to
//! weighted means.

use std::sync::Arc;

use glam::DVec2;
use stillpoint::case::{Case, Component};
use stillpoint::cpu;
use stillpoint::known::Known;
use stillpoint::measure::FieldError;
use stillpoint::scene::Scene;
use stillpoint::simulation::simulate;
use stillpoint::step::{Buffer, Operation, Points};

use crate::bench::{Bench, order};
use crate::cases::problem;
use crate::random::Random;

/// A random polynomial about the middle of the domain: powers of x and of y, and their factors.
struct Polynomial(Vec<(i32, i32, f64)>);

impl Polynomial {
    fn random(degree: i32, random: &mut Random) -> Self {
        let powers = (0..=degree).flat_map(|d| (0..=d).map(move |y| (d - y, y)));
        Self(powers.map(|(x, y)| (x, y, random.number())).collect())
    }

    /// Value, gradient and Laplacian.
    fn at(&self, p: DVec2) -> (f64, DVec2, f64) {
        let p = p - 0.5;
        let power = |x: f64, n: i32| if n < 0 { 0.0 } else { x.powi(n) };
        let (mut value, mut gradient, mut laplacian) = (0.0, DVec2::ZERO, 0.0);
        for &(i, j, c) in &self.0 {
            let (n, m) = (f64::from(i), f64::from(j));
            value += c * power(p.x, i) * power(p.y, j);
            gradient.x += c * n * power(p.x, i - 1) * power(p.y, j);
            gradient.y += c * m * power(p.x, i) * power(p.y, j - 1);
            laplacian += c * n * (n - 1.0) * power(p.x, i - 2) * power(p.y, j);
            laplacian += c * m * (m - 1.0) * power(p.x, i) * power(p.y, j - 2);
        }
        (value, gradient, laplacian)
    }
}

/// Gradient and Laplacian of a field by the operators of a problem; no Laplacian with fits of order 1.
fn derivatives(bench: &mut Bench, field: &[f64]) -> (Vec<DVec2>, Vec<f64>) {
    bench.write_scalars(Buffer::Field, field);
    let all = bench.scene.plan.kick.clone();
    bench.apply(&all);
    let laplacian = if all.contains(&Operation::Laplacian) { bench.scalars(Buffer::FieldLaplacian) } else { vec![] };
    (bench.vectors(Buffer::FieldGradient), laplacian)
}

fn of(overrides: &[&str]) -> Case {
    problem(20, &[&["derivatives.field=waves"], overrides].concat())
}

const SCATTERED: [&[&str]; 3] = [
    &["cloud.arrangement=regular"],
    &["cloud.jitter=0.4"],
    &["cloud.arrangement=random", "cloud.minimum_distance=0.7"],
];

#[test]
fn fits_of_every_order_are_exact_on_polynomials_of_their_degree_and_not_beyond() {
    for (degree, key) in (1..).zip(["method.order=1", "method.order=2", "method.order=3", "method.order=4"]) {
        for cloud in SCATTERED {
            let mut bench = Bench::new(&of(&[cloud, &[key, "method.weight=quadratic"]].concat()));
            let rungs = bench.indexes(Buffer::Rung(Points::Standing));
            let full = rungs[..bench.points()].iter().filter(|&&rung| rung == 0).count();
            assert!(
                full == bench.points() || cloud[0] != "cloud.arrangement=regular",
                "{key} {cloud:?}: {full} full fits"
            );
            let worst = |degree: i32, bench: &mut Bench| {
                let polynomial = Polynomial::random(degree, &mut Random::new(7));
                let field = bench.sample(|p| polynomial.at(p).0);
                let (gradient, laplacian) = derivatives(bench, &field);
                let radius = bench.scene.constants.radius;
                let mut worst = 0.0_f64;
                for (point, &place) in bench.scene.cloud.position.iter().enumerate() {
                    let (_, slope, curvature) = polynomial.at(place);
                    // A fit of lower order is not exact.
                    if rungs[point] <= 3 {
                        worst = worst.max(radius * (gradient[point] - slope).length());
                        let off = laplacian.get(point).map_or(0.0, |found| (found - curvature).abs());
                        worst = worst.max(radius * radius * off);
                    }
                }
                worst
            };
            let (exact, beyond) = (worst(degree, &mut bench), worst(degree + 1, &mut bench));
            assert!(exact < 1e-9, "{key} {cloud:?}: {exact:e}");
            assert!(beyond > 1e-6, "{key} {cloud:?}: {beyond:e} one degree higher");
        }
    }
}

/// Root mean square errors of gradient and Laplacian, relative, over the points whose neighbourhood no wall cuts.
fn errors(n: usize, overrides: &[&str]) -> [f64; 2] {
    let case = problem(n, &[&["derivatives.field=waves"], overrides].concat());
    let mut bench = Bench::new(&case);
    let known = Known::of(&case).expect("a known field");
    let field = bench.sample(|p| known.value(p));
    let (gradient, laplacian) = derivatives(&mut bench, &field);
    let mut sums = [[0.0; 2]; 2];
    for (point, &p) in bench.scene.cloud.position.iter().enumerate() {
        if p.min(1.0 - p).min_element() < bench.scene.constants.radius {
            continue;
        }
        let slope = known.gradient(p);
        sums[0][0] += (gradient[point] - slope).length_squared();
        sums[0][1] += slope.length_squared();
        if let Some(found) = laplacian.get(point) {
            sums[1][0] += (found - known.laplacian(p)).powi(2);
            sums[1][1] += known.laplacian(p).powi(2);
        }
    }
    sums.map(|[off, size]| if size > 0.0 { (off / size).sqrt() } else { 0.0 })
}

#[test]
fn gradients_converge_at_the_order_of_the_fit_and_laplacians_at_one_less() {
    for (degree, key) in (1..).zip(["method.order=1", "method.order=2", "method.order=3", "method.order=4"]) {
        let (coarse, fine) = (errors(24, &[key]), errors(72, &[key]));
        let gradient = order((24, coarse[0]), (72, fine[0]));
        assert!(gradient > f64::from(degree) - 0.15, "{key}: gradient of order {gradient}");
        if degree > 1 {
            let laplacian = order((24, coarse[1]), (72, fine[1]));
            assert!(laplacian > f64::from(degree) - 1.2, "{key}: Laplacian of order {laplacian}");
        }
    }
}

#[test]
fn the_integral_form_is_right_on_lattices_alone() {
    let integral = "method.operators=integral";
    let lattice = ["cloud.arrangement=regular", integral];
    let (coarse, fine) = (errors(24, &lattice), errors(72, &lattice));
    for (name, k) in [("gradient", 0), ("Laplacian", 1)] {
        let order = order((24, coarse[k]), (72, fine[k]));
        assert!(order > 1.9, "{name} on a lattice: order {order}, from {} to {}", coarse[k], fine[k]);
    }
    // On jittered points more of them do not help, while the fits get better.
    let jittered = ["cloud.jitter=0.4", integral];
    let (coarse, fine) = (errors(24, &jittered), errors(72, &jittered));
    for k in 0..2 {
        assert!(fine[k] > 0.9 * coarse[k] && fine[k] > 0.1, "{coarse:?} {fine:?}");
    }
    let fits = (errors(24, &["cloud.jitter=0.4"]), errors(72, &["cloud.jitter=0.4"]));
    assert!(fits.1[0] < 0.01 && fits.1[0] < fits.0[0] / 7.0, "{fits:?}");
}

/// The three formulas, summed by hand over the neighbours of one point.
#[test]
fn the_integral_form_is_the_formulas_of_the_paper() {
    let case = of(&["cloud.jitter=0.4", "method.operators=integral"]);
    let mut bench = Bench::new(&case);
    let known = Known::of(&case).expect("a known field");
    let field = bench.sample(|p| known.value(p));
    let (gradient, laplacian) = derivatives(&mut bench, &field);
    let average = bench.scalars(Buffer::FieldAverage);
    let (r_e, places) = (bench.scene.constants.radius, bench.scene.cloud.position.clone());
    let (n0, lambda) = (bench.scene.constants.lattice.density, bench.scene.constants.lattice.spread);
    for i in [0, 57, 200, places.len() - 1] {
        let (mut value, mut slope, mut curvature) = (0.0, DVec2::ZERO, 0.0);
        for j in (0..places.len()).filter(|&j| j != i) {
            let d = places[j] - places[i];
            let r = d.length();
            if r < r_e {
                let w = r_e / r - 1.0;
                value += field[j] * w / n0;
                slope += 2.0 / n0 * (field[j] - field[i]) / (r * r) * d * w;
                curvature += 4.0 / (lambda * n0) * (field[j] - field[i]) * w;
            }
        }
        assert!((average[i] - value).abs() < 1e-12, "value at {i}");
        assert!((gradient[i] - slope).length() < 1e-10, "gradient at {i}");
        assert!((laplacian[i] - curvature).abs() < 1e-8, "Laplacian at {i}");
    }
}

/// Relative rms error of the solution of the pressure equation.
fn poisson_error(n: usize, overrides: &[&str]) -> f64 {
    let case = problem(n, &[&["effects.pressure.tolerance=1e-9"], overrides].concat());
    let scene = Arc::new(Scene::build(&case).expect("a scene"));
    let outcome = simulate(&scene, cpu::double(&scene).expect("an engine").as_mut(), &mut ()).expect("a run");
    assert_eq!(outcome.fallbacks, 0, "{overrides:?}");
    let known = Known::of(&case).expect("a known field");
    let FieldError { difference, exact } = FieldError::of_known(&outcome.snapshot, &known, Component::P);
    difference / exact
}

#[test]
fn the_pressure_equation_gives_the_known_field_at_order_two() {
    let collocated: &[&str] =
        &["effects.pressure.form=collocated", "method.radius=3.1", "method.weight=quadratic", "poisson.field=cosines"];
    for (overrides, least) in [
        (&["poisson.field=cosines"][..], 1.9),
        (&["poisson.field=waves", "domain.periodic=both"], 1.9),
        (&["poisson.field=waves", "domain.periodic=x"], 1.9),
        (collocated, 1.8),
    ] {
        let (coarse, fine) = (poisson_error(24, overrides), poisson_error(72, overrides));
        let found = order((24, coarse), (72, fine));
        assert!(found > least && fine < 0.01, "{overrides:?}: order {found}, from {coarse} to {fine}");
    }
}
