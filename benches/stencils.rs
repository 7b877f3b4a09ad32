//! Least-squares stencils of order 2 on scattered points with about 20 neighbours each, on the CPU engine.
//!
//! `factorise` forms and factorises the 5x5 normal matrix of every point: all that depends on the points. `fit` solves
//! for the five coefficients of u and of v with these factors. `factorise_and_fit` does both. Items are points.

mod common;

use common::Size;
use divan::Bencher;
use divan::counter::ItemsCount;
use glam::DVec2;
use stillpoint::cpu::CpuEngine;
use stillpoint::cpu::real::Real;
use stillpoint::engine::{Clock, Engine};
use stillpoint::step::{Operation, Points};

const FACTORISE: Operation = Operation::Factorise(Points::Standing);
const FIT: Operation = Operation::FitVelocity(Points::Standing);

fn main() {
    divan::main();
}

/// 256 and 512 points a side: 65,536 and 262,144.
fn sizes() -> Vec<Size> {
    Size::all(&["random"], &[255, 511])
}

#[divan::bench(types = [f32, f64], args = sizes())]
fn factorise<T: Real>(bencher: Bencher, size: &Size) {
    bench::<T>(bencher, size, &[FACTORISE]);
}

#[divan::bench(types = [f32, f64], args = sizes())]
fn fit<T: Real>(bencher: Bencher, size: &Size) {
    bench::<T>(bencher, size, &[FIT]);
}

#[divan::bench(types = [f32, f64], args = sizes())]
fn factorise_and_fit<T: Real>(bencher: Bencher, size: &Size) {
    bench::<T>(bencher, size, &[FACTORISE, FIT]);
}

fn bench<T: Real>(bencher: Bencher, size: &Size, operations: &[Operation]) {
    // 2.6 spacings reach about 20 neighbours.
    let scene = size.scene(&["method.radius=2.6"]);
    let clock = scene.clock(1.0);
    let mut engine = CpuEngine::<T>::new(scene.clone()).expect("an engine");
    let swirl = |place: &DVec2| DVec2::new(place.y.sin(), (3.0 * place.x).cos());
    let velocity: Vec<DVec2> = scene.cloud.position.iter().map(swirl).collect();
    engine.write(scene.plan.moving(), &scene.vectors(&velocity, DVec2::ZERO)).expect("a velocity");
    apply(&mut engine, &scene.plan.setup, &clock);
    let pool = size.pool();
    let bencher = bencher.counter(ItemsCount::new(scene.sizes.points));
    bencher.bench_local(|| pool.install(|| apply(&mut engine, operations, &clock)));
}

fn apply<T: Real>(engine: &mut CpuEngine<T>, operations: &[Operation], clock: &Clock) {
    for &operation in operations {
        engine.apply(operation, clock).expect("an operation of the plan");
    }
}
