//! Whole steps on whatever adapter there is.

use super::{CHANGES, Precision, engine, scene};
use crate::cpu::CpuEngine;
use crate::engine::{Data, Engine, EngineError};
use crate::scene::Scene;
use crate::step::{Buffer, Operation, Points};
use std::sync::Arc;

fn reals(engine: &mut dyn Engine, buffer: Buffer) -> Vec<f64> {
    match engine.read(buffer).expect("read") {
        Data::Real(values) => values,
        Data::Index(values) => values.into_iter().map(f64::from).collect(),
    }
}

/// Largest difference over the largest magnitude.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    let most = a.iter().fold(1e-30_f64, |most, value| most.max(value.abs()));
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / most
}

fn cpu(scene: Scene) -> CpuEngine<f64> {
    let scene = Arc::new(scene);
    let mut engine = CpuEngine::new(Arc::clone(&scene)).expect("an engine");
    for &operation in &scene.plan.setup {
        engine.apply(operation, &scene.clock(1.0)).expect("setup");
    }
    engine
}

#[test]
fn the_same_seed_gives_the_same_bits() {
    let run = || {
        let scene = scene(CHANGES[2]);
        let clock = scene.clock(0.01);
        let mut engine = engine(scene, Precision::Single)?;
        let done = engine.advance(6, &clock).expect("steps");
        assert_eq!((done.steps, done.trouble), (6, None));
        Some([Buffer::Projected, Buffer::Pressure].map(|buffer| reals(&mut engine, buffer)))
    };
    let first = run();
    assert!(first.as_ref().is_none_or(|fields| fields[0].iter().any(|&value| value != 0.0)));
    assert_eq!(first, run());
}

#[test]
fn steps_agree_with_the_cpu() {
    for changes in CHANGES {
        let scene = scene(changes);
        let clock = scene.clock(0.01);
        let Some(mut gpu) = engine(scene.clone(), Precision::Single) else { return };
        let mut cpu = cpu(scene);
        gpu.advance(5, &clock).expect("steps");
        cpu.advance(5, &clock).expect("steps");
        let (ours, theirs) = (reals(&mut gpu, Buffer::Projected), reals(&mut cpu, Buffer::Projected));
        let error = apart(&theirs, &ours);
        assert!(error < 2e-4, "{changes:?}: {error}; {:?}, {:?}", gpu.solve_info(), cpu.solve_info());
        let (ours, theirs) = (gpu.measure(1.0).expect("measure"), cpu.measure(1.0).expect("measure"));
        assert!((ours.kinetic_energy / theirs.kinetic_energy - 1.0).abs() < 1e-3, "{ours:?}, {theirs:?}");
        assert!((ours.max_speed / theirs.max_speed - 1.0).abs() < 1e-5, "{ours:?}, {theirs:?}");
        assert!((ours.change / theirs.change - 1.0).abs() < 1e-3, "{ours:?}, {theirs:?}");
    }
}

#[test]
fn results_do_not_depend_on_how_steps_are_batched() {
    let run = |portions: &[u32]| {
        let scene = scene(&["effects.pressure.tolerance=1e-5"]);
        let clock = scene.clock(0.01);
        let mut engine = engine(scene, Precision::Single)?;
        portions.iter().for_each(|&steps| assert_eq!(engine.advance(steps, &clock).expect("steps").steps, steps));
        Some([Buffer::Projected, Buffer::Pressure].map(|buffer| reals(&mut engine, buffer)))
    };
    assert_eq!(run(&[12]), run(&[1, 4, 7]));
}

#[test]
fn a_neighbour_list_that_overflows_is_an_error() {
    let mut scene = scene(&[]);
    scene.sizes.capacity = 12;
    let Some(candidate) = crate::gpu::adapter::choose(None).ok() else { return };
    let gpu = crate::gpu::Gpu::open(&candidate, Precision::Single).expect("the adapter opens");
    let scene = Arc::new(scene);
    let mut engine = crate::gpu::GpuEngine::new(Arc::clone(&scene), gpu).expect("the kernels compile");
    let clock = scene.clock(1.0);
    engine.apply(Operation::BuildCells(Points::Standing), &clock).expect("cells");
    let error = engine.apply(Operation::FindNeighbours(Points::Standing), &clock);
    assert!(matches!(error, Err(EngineError::NeighbourOverflow { found: 13.., capacity: 12 })), "{error:?}");
}

#[test]
fn a_field_that_is_not_a_number_stops_the_run_there() {
    for bad in [f64::NAN, f64::INFINITY] {
        let scene = scene(&["time.splitting=\"projection\"", "effects.pressure.solver=\"bicgstab\""]);
        let clock = scene.clock(0.01);
        let Some(mut engine) = engine(scene, Precision::Single) else { return };
        let mut velocity = reals(&mut engine, Buffer::Projected);
        velocity[2 * 40 + 1] = bad;
        engine.write(Buffer::Projected, &Data::Real(velocity)).expect("write");
        let done = engine.advance(3, &clock).expect("steps");
        assert!(done.trouble.is_some() && done.steps <= 1, "{done:?}");
    }
}
