//! The conservative pressure equation in f64: conjugate gradients to a residual of 1e-6 of the right side, and the
//! sparse factorisation with its solves. The right side is noise, so that every mode is there.
//!
//! On `regular` points the matrix is the five-point one. The iterations of each solve stand before the table.

mod common;

use std::sync::Arc;

use common::Size;
use divan::{Bencher, black_box};
use rand_core::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;
use stillpoint::cpu::CpuEngine;
use stillpoint::direct::DirectSolver;
use stillpoint::engine::{Clock, Engine};
use stillpoint::scene::Scene;
use stillpoint::step::{Buffer, Operation};

/// Residual over right side.
const RELATIVE: f64 = 1e-6;
const SOLVE: Operation = Operation::ConjugateGradient;
const PRECONDITIONERS: [&str; 2] = ["jacobi", "multigrid"];

fn main() {
    for size in sizes().iter().filter(|size| size.threads == 1) {
        for preconditioner in PRECONDITIONERS {
            let mut problem = Problem::new(size, preconditioner);
            size.pool().install(|| problem.solve());
            let info = problem.engine.solve_info();
            let relative = info.last_residual / info.first_residual;
            println!(
                "{} {}, {preconditioner}: {} iterations to {relative:.1e}",
                problem.scene.sizes.points, size.arrangement, info.iterations
            );
        }
    }
    divan::main();
}

/// 128, 256 and 512 points a side.
fn sizes() -> Vec<Size> {
    Size::all(&["regular", "random"], &[127, 255, 511])
}

#[divan::bench(args = sizes(), sample_count = 20, max_time = 10)]
fn conjugate_gradient_jacobi(bencher: Bencher, size: &Size) {
    conjugate_gradient(bencher, size, "jacobi");
}

#[divan::bench(args = sizes(), sample_count = 20, max_time = 10)]
fn conjugate_gradient_multigrid(bencher: Bencher, size: &Size) {
    conjugate_gradient(bencher, size, "multigrid");
}

fn conjugate_gradient(bencher: Bencher, size: &Size, preconditioner: &str) {
    let mut problem = Problem::new(size, preconditioner);
    let pool = size.pool();
    bencher.bench_local(|| pool.install(|| problem.solve()));
    let info = problem.engine.solve_info();
    // Else the engine has solved directly, and that is what was timed.
    assert!(info.last_residual <= RELATIVE * info.first_residual * 1.01, "conjugate gradients stalled: {info:?}");
}

/// The direct solver uses one thread.
fn direct_sizes() -> Vec<Size> {
    sizes().into_iter().filter(|size| size.threads == 1 && size.cells < 500).collect()
}

#[divan::bench(args = direct_sizes(), sample_count = 10, max_time = 10)]
fn direct_factorise(bencher: Bencher, size: &Size) {
    let scene = size.scene(&[]);
    let cells = scene.cells().expect("a conservative case");
    bencher.bench_local(|| DirectSolver::conservative(black_box(cells)).expect("a factorisation"));
}

#[divan::bench(args = direct_sizes(), sample_count = 20, max_time = 10)]
fn direct_solve(bencher: Bencher, size: &Size) {
    let scene = size.scene(&[]);
    let solver = DirectSolver::conservative(scene.cells().expect("a conservative case")).expect("a factorisation");
    let source = noise(&scene);
    bencher.bench_local(|| solver.solve(black_box(&source)).expect("a pressure"));
}

/// An engine whose source is noise.
struct Problem {
    scene: Arc<Scene>,
    engine: CpuEngine<f64>,
    clock: Clock,
}

impl Problem {
    fn new(size: &Size, preconditioner: &str) -> Self {
        let scene = size.scene(&[
            &format!("effects.pressure.tolerance={RELATIVE:e}"),
            &format!("effects.pressure.preconditioner={preconditioner}"),
            "effects.pressure.max_iterations=20000",
        ]);
        let mut engine = CpuEngine::new(scene.clone()).expect("an engine");
        let clock = scene.clock(1.0);
        // The tolerance is of `|div u| dt`: with this source its unit is the source's root mean square.
        let unit = scene.constants.density / (clock.kick * clock.dt);
        let source: Vec<f64> = noise(&scene).iter().map(|value| unit * value).collect();
        engine.write(Buffer::Source, &scene.scalars(&source, 0.0)).expect("a source");
        Self { scene, engine, clock }
    }

    /// From zero.
    fn solve(&mut self) {
        self.engine.write(Buffer::Pressure, &self.scene.zeros(Buffer::Pressure)).expect("a pressure");
        self.engine.apply(SOLVE, &self.clock).expect("a solve");
    }
}

/// Noise that sums to zero, one entry a point, its root mean square over the volumes 1.
fn noise(scene: &Scene) -> Vec<f64> {
    let volume = &scene.cells().expect("a conservative case").volume;
    let mut random = Xoshiro256PlusPlus::seed_from_u64(1);
    let mut density: Vec<f64> = volume.iter().map(|_| (random.next_u64() >> 11) as f64 / (1u64 << 53) as f64).collect();
    let area: f64 = volume.iter().sum();
    let mean = density.iter().zip(volume).map(|(value, volume)| value * volume).sum::<f64>() / area;
    density.iter_mut().for_each(|value| *value -= mean);
    let rms = (density.iter().map(|value| value * value).sum::<f64>() / density.len() as f64).sqrt();
    density.iter().zip(volume).map(|(value, volume)| value / rms * volume).collect()
}
