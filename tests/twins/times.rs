//! The seconds that both engines report for each operation.

use std::sync::Arc;
use std::time::Instant;

use stillpoint::cpu;
use stillpoint::engine::Engine;
use stillpoint::gpu::{Gpu, GpuEngine, Precision};
use stillpoint::scene::Scene;

use crate::cases::cavity;
use crate::engines::{candidate, gpu};

/// Runs the setup and some steps: every operation has taken time, and all together no more than what passed.
fn takes_times(engine: &mut dyn Engine, scene: &Scene) {
    let started = Instant::now();
    let clock = scene.clock(0.01);
    for &operation in &scene.plan.setup {
        engine.apply(operation, &clock).expect("an operation");
    }
    engine.advance(1, &clock).expect("a step");
    let first = engine.seconds();
    engine.advance(40, &clock).expect("steps");
    let (last, elapsed) = (engine.seconds(), started.elapsed().as_secs_f64());
    for operation in scene.plan.operations() {
        let taken = last.get(&operation).copied().unwrap_or(0.0);
        assert!(taken > 0.0, "{operation:?} took no time");
        let stepped = !scene.plan.setup.contains(&operation);
        assert!(!stepped || taken > first[&operation], "{operation:?} took no more time in 40 steps");
    }
    let all: f64 = last.values().sum();
    assert!(all < elapsed, "{all} s in {elapsed} s");
}

#[test]
fn every_operation_is_timed_on_the_cpu() {
    let scene = Arc::new(Scene::build(&cavity(&[])).expect("a scene"));
    takes_times(cpu::double(&scene).expect("an engine").as_mut(), &scene);
}

#[test]
fn every_operation_is_timed_on_a_gpu_opened_for_it_and_none_on_another() {
    let Some(candidate) = candidate() else { return };
    let scene = Arc::new(Scene::build(&cavity(&[])).expect("a scene"));
    let opened = Gpu::open_timed(&candidate, Precision::Single).expect("the adapter opens");
    let mut timed = GpuEngine::new(Arc::clone(&scene), opened).expect("the kernels compile");
    // An adapter need not have timestamps: then there is nothing to hold.
    if timed.takes_times() {
        takes_times(&mut timed, &scene);
    }
    let mut plain = gpu(&candidate, &scene, Precision::Single);
    plain.advance(2, &scene.clock(0.01)).expect("steps");
    assert!(plain.seconds().is_empty());
}

#[test]
fn a_direct_solve_on_the_host_is_timed_too() {
    let Some(candidate) = candidate() else { return };
    let scene = Arc::new(Scene::build(&cavity(&["effects.pressure.solver=direct"])).expect("a scene"));
    let opened = Gpu::open_timed(&candidate, Precision::Single).expect("the adapter opens");
    let mut timed = GpuEngine::new(Arc::clone(&scene), opened).expect("the kernels compile");
    if timed.takes_times() {
        takes_times(&mut timed, &scene);
    }
}
