//! Hard cases of the pressure equation.

use std::sync::Arc;
use stillpoint::cpu::operations::bicgstab::{self, Shift};
use stillpoint::cpu::operations::coarse::Nothing;
use stillpoint::cpu::operations::conjugate_gradient;
use stillpoint::cpu::operations::lists::PACKS;
use stillpoint::cpu::operations::pressure::{Rows, Stop};
use stillpoint::cpu::real::{Pack, Real};
use stillpoint::engine::{Clock, Data, Outcome};
use stillpoint::scene::Scene;
use stillpoint::step::{BLOCK, Buffer};
use stillpoint::{cpu, known::Known};

use crate::cases::{cavity_of, problem};
use crate::flow::flow_of;
use crate::table::{Promise, Row};

const SOLVERS: [&str; 3] = ["conjugate_gradient", "bicgstab", "direct"];

pub fn rows() -> Vec<Row> {
    let mut rows = Vec::new();
    for solver in SOLVERS {
        rows.push(incompatible("conservative", solver));
    }
    for solver in ["bicgstab", "direct"] {
        rows.push(incompatible("collocated", solver));
    }
    // Solves that cannot do what they are asked for.
    let right = flow_of(&cavity_of(16, &["effects.pressure.solver=direct"])).expect("a flow").energy();
    for (form, within) in [("conservative", 1e-9), ("collocated", 0.1)] {
        let form = format!("effects.pressure.form={form}");
        for (name, key) in [
            ("1 iteration", "effects.pressure.max_iterations=1"),
            ("a tolerance of 1e-300", "effects.pressure.tolerance=1e-300"),
        ] {
            let flow = flow_of(&cavity_of(16, &[&form, key]));
            let case = format!("a solve allowed {name}, {}", &form[22..]);
            rows.push(Row::of_flow(
                case.replace("allowed a tolerance", "asked for a tolerance"),
                Promise::Right(within),
                &flow,
                Some(right),
            ));
        }
    }
    let loose = flow_of(&cavity_of(16, &["effects.pressure.tolerance=0.9"]));
    rows.push(Row::of_flow("a solve with a tolerance of 0.9", Promise::Bounded(1.0), &loose, None));
    rows.extend(breakdowns());
    rows
}

/// A source that no pressure answers: as much more flows out than in as the flow is large. Its mean is taken out, which
/// leaves the pressure of the source without it.
fn incompatible(form: &str, solver: &str) -> Row {
    let keys = [format!("effects.pressure.form={form}"), format!("effects.pressure.solver={solver}")];
    let keys: Vec<&str> =
        keys.iter().map(String::as_str).chain(["poisson.field=cosines", "effects.pressure.tolerance=1e-10"]).collect();
    let case = problem(16, &[&keys[..], &["cloud.arrangement=regular"]].concat());
    let scene = Arc::new(Scene::build(&case).expect("a scene"));
    let mut engine = cpu::double(&scene).expect("an engine");
    let clock = Clock { dt: 1e-3, kick: 1e-3, second_kick: 0.0, share: 1.0 };
    for &operation in &scene.plan.setup {
        engine.apply(operation, &clock).expect("the setup");
    }
    let Ok(Data::Real(mut source)) = engine.read(Buffer::Source) else { panic!("a source") };
    let mut solve = |source: &[f64]| {
        engine.write(Buffer::Source, &Data::Real(source.to_vec())).expect("a source");
        engine.write(Buffer::Pressure, &scene.zeros(Buffer::Pressure)).expect("a pressure");
        engine.apply(scene.plan.kick[0], &clock).expect("a solve");
        let Ok(Data::Real(pressure)) = engine.read(Buffer::Pressure) else { panic!("a pressure") };
        let mean = pressure[..scene.sizes.points].iter().sum::<f64>() / scene.sizes.points as f64;
        pressure[..scene.sizes.points].iter().map(|p| p - mean).collect::<Vec<f64>>()
    };
    let compatible = solve(&source);
    let size = source.iter().map(|b| b.abs()).fold(0.0, f64::max);
    // What a singular matrix leaves out of the question: the constants of the one form; of the other the multiplier on the mean, which the rows inside have.
    source[..scene.constants.shift.rows].iter_mut().for_each(|b| *b += size);
    let known = Known::of(&case).expect("a field");
    let scale = scene.cloud.position.iter().map(|&place| known.value(place).abs()).fold(0.0, f64::max);
    let off = solve(&source).iter().zip(&compatible).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / scale;
    Row::of_error(format!("a source that does not sum to zero, {form}, {solver}"), 1e-4, off)
}

/// A matrix of two rows at the beginning, and the identity behind: whatever breaks a method down.
struct Small([[f64; 2]; 2]);

impl Rows<f64> for Small {
    fn products(&self, block: usize, p: &[f64]) -> [<f64 as Real>::Pack; PACKS] {
        let Small([a, b]) = self;
        std::array::from_fn(|pack| {
            <f64 as Real>::Pack::from_lanes(|lane| match BLOCK * block + <f64 as Real>::Pack::LANES * pack + lane {
                0 => a[0] * p[0] + a[1] * p[1],
                1 => b[0] * p[0] + b[1] * p[1],
                other => p[other],
            })
        })
    }

    fn measure(
        &self,
        _: usize,
        residual: <f64 as Real>::Pack,
        size: <f64 as Real>::Pack,
        sums: &mut [<f64 as Real>::Pack],
    ) {
        sums[0] += residual * residual;
        sums[1] += size * size;
    }
}

/// Methods that would divide by zero, by themselves.
fn breakdowns() -> Vec<Row> {
    const LENGTH: usize = 32;
    let stop = Stop { residual: 1e-12, max_iterations: 50, floor: 1.0, singular: true };
    let vector = || vec![0.0; LENGTH];
    let two = |a: f64, b: f64| {
        let mut source = vector();
        (source[0], source[1]) = (a, b);
        source
    };
    let ones = vec![1.0; LENGTH];
    let bicgstab = |matrix: [[f64; 2]; 2], source: &[f64]| {
        let mut vectors: [Vec<f64>; 7] = std::array::from_fn(|_| vector());
        let [residual, direction, product, shadow, stabilised, stabilised_product, preconditioned] =
            vectors.each_mut().map(|v| &mut v[..]);
        let work =
            bicgstab::Work { residual, direction, product, shadow, stabilised, stabilised_product, preconditioned };
        let mut pressure = vector();
        let info = bicgstab::solve(
            &Small(matrix),
            &mut Nothing,
            &ones,
            2,
            Shift { factor: 0.0, rows: 0 },
            source,
            stop,
            work,
            &mut pressure,
        );
        (info, pressure)
    };
    let gradients = |matrix: [[f64; 2]; 2], source: &[f64]| {
        let (mut residual, mut direction, mut product, mut pressure) = (vector(), vector(), vector(), vector());
        let work =
            conjugate_gradient::Work { residual: &mut residual, direction: &mut direction, product: &mut product };
        let info = conjugate_gradient::solve(&Small(matrix), &mut Nothing, &ones, 2, source, stop, work, &mut pressure);
        (info, pressure)
    };
    let row =
        |case: &str, promise: &str, (info, pressure): (stillpoint::engine::SolveInfo, Vec<f64>), converges: bool| {
            let finite = pressure.iter().all(|p| p.is_finite());
            let measured = format!("{:?} after {} iterations", info.outcome, info.iterations);
            Row::new(case, promise, measured, finite && (info.outcome == Outcome::Converged) == converges)
        };
    let (given_up, solved) = ("gives up with a finite pressure, for the direct solve", "converges");
    // (r, A r) = 0 from the first product on: nothing to divide by.
    let turn = [[0.0, 1.0], [-1.0, 0.0]];
    // A first half step, and then (A s, s) = 0: omega is 0.
    let half = [[1.0, 1.0], [-1.0, 0.0]];
    vec![
        row("BiCGStab on a quarter turn: its first divisor is 0", given_up, bicgstab(turn, &two(1.0, 1.0)), false),
        row("BiCGStab where omega is 0", given_up, bicgstab(half, &two(1.0, 0.0)), false),
        row("BiCGStab on a matrix of zeros", given_up, bicgstab([[0.0; 2]; 2], &two(1.0, -1.0)), false),
        row("BiCGStab without a source", solved, bicgstab(turn, &vector()), true),
        row(
            "conjugate gradients on an indefinite matrix",
            given_up,
            gradients([[0.0, 1.0], [1.0, 0.0]], &two(1.0, -1.0)),
            false,
        ),
        row("conjugate gradients on a matrix of zeros", given_up, gradients([[0.0; 2]; 2], &two(1.0, -1.0)), false),
        row("conjugate gradients without a source", solved, gradients([[1.0, 0.0], [0.0, 1.0]], &vector()), true),
    ]
}
