//! Whole steps on whatever adapter there is.

use std::sync::Arc;

use super::{
    CHANGES, Precision, candidate, engine, forceless_scene, made, open_scene, periodic_scene, scene, still_scene,
};
use crate::cpu::CpuEngine;
use crate::engine::{Data, Engine, EngineError};
use crate::scene::Scene;
use crate::simulation::simulate;
use crate::snapshot::Snapshot;
use crate::step::{Buffer, Operation, Points};

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

/// Five steps of every scene on both engines; the velocities may lie `velocity` apart, the sums `sums`.
fn steps_agree(precision: Precision, tolerance: &str, velocity: f64, sums: f64) {
    let changed = |changes: &&[&str]| scene(&[*changes, &[tolerance]].concat());
    let scenes = CHANGES.iter().map(changed).chain([still_scene(), forceless_scene(), open_scene(), periodic_scene()]);
    for scene in scenes {
        let clock = scene.clock(0.005);
        let Some(mut gpu) = engine(scene.clone(), precision) else { return };
        let mut cpu = cpu(scene.clone());
        for engine in [&mut gpu as &mut dyn Engine, &mut cpu] {
            assert_eq!(engine.advance(5, &clock).map(|done| (done.steps, done.trouble)), Ok((5, None)));
        }
        let (ours, theirs) = (reals(&mut gpu, Buffer::Projected), reals(&mut cpu, Buffer::Projected));
        let error = apart(&theirs, &ours);
        assert!(error < velocity, "{:?}: {error}; {:?}, {:?}", scene.plan, gpu.solve_info(), cpu.solve_info());
        let (ours, theirs) = (gpu.measure(1.0).expect("measure"), cpu.measure(1.0).expect("measure"));
        for (ours, theirs) in [
            (ours.kinetic_energy, theirs.kinetic_energy),
            (ours.max_speed, theirs.max_speed),
            (ours.divergence, theirs.divergence),
            (ours.change, theirs.change),
        ] {
            assert!((ours - theirs).abs() <= sums * theirs.abs(), "{ours}, {theirs}: {:?}", scene.plan);
        }
        let again = gpu.measure(1.0).expect("measure");
        assert_eq!(again.change, 0.0, "what was measured is what was reported");
    }
}

#[test]
fn steps_agree_with_the_cpu_to_single_precision() {
    steps_agree(Precision::Single, "effects.pressure.tolerance=1e-6", 1e-4, 1e-3);
}

#[test]
fn steps_agree_with_the_cpu_to_double_precision() {
    if candidate().is_some_and(|candidate| candidate.double_precision) {
        steps_agree(Precision::Double, "effects.pressure.tolerance=1e-11", 1e-8, 1e-8);
    }
}

#[test]
fn results_do_not_depend_on_how_steps_are_batched() {
    let implicit = "effects.viscosity={ kinematic = 5.0, scheme = \"implicit\" }";
    for (changes, solves) in [(&["effects.pressure.tolerance=1e-6"][..], 1), (&[implicit], 2)] {
        let run = |portions: &[u32], iterations: u32| {
            let scene = scene(changes);
            let clock = scene.clock(0.01);
            let mut engine = engine(scene, Precision::Single)?;
            for &steps in portions {
                engine.hold_iterations(iterations);
                let done = engine.advance(steps, &clock).expect("steps");
                assert!(done.steps == steps && done.iterations > 5 * u64::from(steps), "{done:?}");
            }
            let viscous = engine.viscous_solve_info();
            assert!(
                viscous.is_none_or(|solve| solve.iterations > 5) && viscous.is_some() == (solves == 2),
                "{viscous:?}"
            );
            Some([Buffer::Projected, Buffer::Pressure].map(|buffer| reals(&mut engine, buffer)))
        };
        let whole = run(&[12], 1000);
        // Solves that a batch cannot hold, to be taken up again; and other lengths of batches.
        assert_eq!(whole, run(&[12], 1), "{changes:?}");
        assert_eq!(whole, run(&[1, 4, 7], 5), "{changes:?}");
    }
}

#[test]
fn a_neighbour_list_that_overflows_is_an_error() {
    let mut scene = scene(&[]);
    scene.sizes.capacity = 12;
    let scene = Arc::new(scene);
    let Some(mut engine) = made(&scene, Precision::Single) else { return };
    let clock = scene.clock(1.0);
    engine.apply(Operation::BuildCells(Points::Standing), &clock).expect("cells");
    let error = engine.apply(Operation::FindNeighbours(Points::Standing), &clock);
    assert!(matches!(error, Err(EngineError::NeighbourOverflow { found: 13.., capacity: 12 })), "{error:?}");
}

#[test]
fn a_field_that_is_not_a_number_stops_the_run_there() {
    // With a pressure solve, which breaks down on it, and without.
    for scene in [scene(&[]), forceless_scene()] {
        for bad in [f64::NAN, f64::INFINITY] {
            let clock = scene.clock(0.005);
            let Some(mut engine) = engine(scene.clone(), Precision::Single) else { return };
            engine.advance(2, &clock).expect("steps");
            // On a wall: inside, the drift would write over it.
            let wall = scene.sizes.interior + 5;
            let mut velocity = reals(&mut engine, Buffer::Velocity);
            velocity[2 * wall + 1] = bad;
            engine.write(Buffer::Velocity, &Data::Real(velocity)).expect("write");
            let done = engine.advance(3, &clock).expect("steps");
            assert_eq!(done.steps, 1, "{done:?}");
            let found = done.trouble.expect("trouble");
            assert!(found.buffer == Buffer::Projected && found.point < wall, "{found:?}");
        }
    }
}

#[test]
fn a_viscous_solve_that_meets_no_number_stops_the_run_there() {
    let scene = scene(&["effects.viscosity.scheme=\"implicit\""]);
    let (clock, moving) = (scene.clock(0.005), scene.plan.moving());
    let Some(mut engine) = engine(scene, Precision::Single) else { return };
    engine.advance(2, &clock).expect("steps");
    let mut velocity = reals(&mut engine, moving);
    velocity[2 * 100] = f64::NAN;
    engine.write(moving, &Data::Real(velocity)).expect("write");
    let done = engine.advance(3, &clock).expect("steps");
    assert!(done.steps == 1 && done.trouble.is_some_and(|found| found.buffer == Buffer::Projected), "{done:?}");
}

#[test]
fn a_solve_that_runs_out_of_iterations_is_handed_to_the_direct_solver() {
    let scene = scene(&["effects.pressure.max_iterations=3"]);
    let clock = scene.clock(0.005);
    let Some(mut short) = engine(scene.clone(), Precision::Single) else { return };
    let mut cpu = cpu(scene);
    let (ours, theirs) = (short.advance(3, &clock).expect("steps"), cpu.advance(3, &clock).expect("steps"));
    assert_eq!(ours, theirs);
    assert_eq!((ours.steps, ours.fallbacks), (3, 3));
    assert!(apart(&reals(&mut cpu, Buffer::Projected), &reals(&mut short, Buffer::Projected)) < 1e-4);
}

#[test]
fn an_operation_that_the_plan_lacks_is_refused() {
    let scene = still_scene();
    let clock = scene.clock(0.01);
    let Some(mut engine) = engine(scene, Precision::Single) else { return };
    assert_eq!(engine.apply(Operation::RemapDeparture, &clock), Err(EngineError::Absent(Buffer::Coefficients)));
    assert_eq!(engine.apply(Operation::MovePoints, &clock), Err(EngineError::Absent(Buffer::Position(Points::Moved))));
}

#[test]
fn what_is_written_is_checked_and_read_back() {
    let scene = scene(&[]);
    let padded = scene.padded();
    let Some(mut engine) = engine(scene, Precision::Single) else { return };
    let values = Data::Real((0..padded).map(|i| i as f64).collect());
    engine.write(Buffer::Pressure, &values).expect("write");
    assert_eq!(engine.read(Buffer::Pressure), Ok(values));
    let short = engine.write(Buffer::Pressure, &Data::Real(vec![0.0; 3]));
    assert_eq!(short, Err(EngineError::Length { buffer: Buffer::Pressure, expected: padded, given: 3 }));
    assert_eq!(engine.read(Buffer::Shadow), Err(EngineError::Absent(Buffer::Shadow)));
    let Ok(Data::Index(mut neighbours)) = engine.read(Buffer::FaceNeighbours) else { panic!("indexes") };
    neighbours[7] = padded as u32;
    let wild = engine.write(Buffer::FaceNeighbours, &Data::Index(neighbours));
    assert_eq!(wild, Err(EngineError::Index { buffer: Buffer::FaceNeighbours, entry: 7, index: padded as u32 }));
}

#[test]
fn a_whole_run_agrees_with_the_cpu() {
    let scene = scene(&["time.end=0.5", "output.report_every=7"]);
    let Some(mut gpu) = made(&Arc::new(scene.clone()), Precision::Single) else { return };
    let mut cpu = CpuEngine::<f64>::new(Arc::new(scene.clone())).expect("an engine");
    let ours = simulate(&scene, &mut gpu, &mut ()).expect("a run");
    let theirs = simulate(&scene, &mut cpu, &mut ()).expect("a run");
    assert_eq!((ours.stop, ours.steps, ours.ladder), (theirs.stop, theirs.steps, theirs.ladder));
    let flat = |snapshot: &Snapshot| snapshot.velocity.iter().flat_map(|u| u.to_array()).collect::<Vec<_>>();
    let error = apart(&flat(&theirs.snapshot), &flat(&ours.snapshot));
    assert!(error < 1e-5, "{error}");
}

#[test]
fn a_driver_that_leaves_loops_early_is_found_out() {
    let scene = Arc::new(scene(&[]));
    let Some(engine) = made(&scene, Precision::Single) else { return };
    let gpu = engine.gpu();
    assert!(gpu.info.software || gpu.loop_limit.is_none());
    // Mesa's count.
    assert!(matches!(gpu.loop_limit, None | Some(65_535)), "{:?}", gpu.loop_limit);
}
