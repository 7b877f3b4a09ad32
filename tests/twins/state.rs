//! What is kept of a run is enough: an engine that knows nothing else goes on to the same bits.

use std::sync::Arc;

use stillpoint::case::Case;
use stillpoint::cpu;
use stillpoint::engine::{Data, Engine};
use stillpoint::gpu::Precision;
use stillpoint::scene::Scene;
use stillpoint::simulation::{Progress, State};
use stillpoint::step::{BLOCK, Buffer, Element, Points};

use crate::cases::cavity_of;
use crate::engines::{candidate, gpu};
use crate::scenes;

/// Steps before the state is kept, and after.
const STEPS: u32 = 3;

type Opened = Box<dyn Engine>;

fn flows() -> impl Iterator<Item = (String, Arc<Scene>)> {
    scenes::all().into_iter().filter(|(_, scene)| scene.plan.flows).map(|(name, scene)| (name.to_string(), scene))
}

fn set_up(scene: &Arc<Scene>, open: &dyn Fn(&Arc<Scene>) -> Opened) -> Opened {
    let mut engine = open(scene);
    for &operation in &scene.plan.setup {
        engine.apply(operation, &scene.clock(1.0)).expect("an operation");
    }
    engine
}

/// Everything that a step changes and that is not kept is spoiled, at every point; what the padding holds is the engine's.
fn spoil(scene: &Scene, engine: &mut dyn Engine) {
    let step = scene.plan.drift.iter().chain(&scene.plan.kick);
    let kept = scene.plan.state();
    for buffer in step.flat_map(|operation| operation.writes()).filter(|buffer| !kept.contains(buffer)) {
        // No index is a number that is none: those of a wrong one would be refused.
        if buffer.element() == Element::Index {
            continue;
        }
        let Data::Real(mut values) = engine.read(buffer).expect("an array") else { panic!("{buffer:?} holds indexes") };
        let width = values.len() / scene.padded();
        let pairs = [Buffer::Kick, Buffer::Position(Points::Moved), Buffer::Departure];
        let solver = [Buffer::ViscousResidual, Buffer::ViscousDirection, Buffer::ViscousProduct];
        let interleaved = pairs.contains(&buffer) || solver.contains(&buffer);
        for (entry, value) in values.iter_mut().enumerate() {
            let block = entry / (BLOCK * width);
            let point = if interleaved { entry / 2 } else { block * BLOCK + entry % BLOCK };
            if point < scene.sizes.points {
                *value = f64::NAN;
            }
        }
        engine.write(buffer, &Data::Real(values)).expect("an array of that length");
    }
}

fn check(name: &str, scene: &Arc<Scene>, open: &dyn Fn(&Arc<Scene>) -> Opened) {
    let clock = scene.clock(0.01);
    let mut engine = set_up(scene, open);
    for &operation in scene.plan.on_step.iter().chain(&scene.plan.kick) {
        engine.apply(operation, &clock).expect("an operation");
    }
    engine.advance(STEPS, &clock).expect("steps");
    engine.measure(1.0).expect("figures");
    let kept = State::read(scene, engine.as_mut(), &Progress::default()).expect("a state");
    let end = |engine: &mut dyn Engine| {
        engine.advance(STEPS, &clock).expect("steps");
        let figures = engine.measure(1.0).expect("figures");
        (State::read(scene, engine, &Progress::default()).expect("a state"), figures, engine.solve_info())
    };
    let expected = end(engine.as_mut());
    let mut fresh = set_up(scene, open);
    kept.write(fresh.as_mut()).expect("a state");
    for &operation in &scene.plan.on_step {
        fresh.apply(operation, &clock).expect("an operation");
    }
    spoil(scene, fresh.as_mut());
    assert!(end(fresh.as_mut()) == expected, "{name}");
    assert!(expected.0.arrays.iter().any(|(buffer, _)| *buffer == scene.plan.moving()), "{name}: what moves is kept");
}

#[test]
fn a_fresh_engine_goes_on_from_a_state_to_the_same_bits() {
    for (name, scene) in flows() {
        check(&format!("{name}, f64"), &scene, &|scene| cpu::double(scene).expect("an engine"));
        check(&format!("{name}, f32"), &scene, &|scene| cpu::single(scene).expect("an engine"));
    }
}

/// Nothing is kept that the setup makes again, or that a step writes before it reads it.
#[test]
fn the_state_of_a_cavity_is_what_it_should_be() {
    let state = |case: &Case| Scene::build(case).expect("a scene").plan.state();
    let whole = state(&cavity_of(16, &[]));
    let expected = [
        Buffer::Velocity,
        Buffer::Projected,
        Buffer::Reflected,
        Buffer::PressureKick,
        Buffer::Pressure,
        Buffer::Reported,
    ];
    assert_eq!(whole, expected);
    let projected = state(&cavity_of(16, &["time.splitting=projection", "effects.pressure.solver=direct"]));
    assert_eq!(projected, [Buffer::Velocity, Buffer::Projected, Buffer::Pressure, Buffer::Reported]);
    let mut still = cavity_of(16, &[]);
    still.effects.pressure = None;
    still.effects.advection = None;
    assert_eq!(state(&still), [Buffer::Projected, Buffer::Reported]);
}

#[test]
fn arrays_read_together_are_those_read_alone_and_the_first_number_that_is_none_is_found() {
    let scene = Arc::new(Scene::build(&cavity_of(16, &[])).expect("a scene"));
    let mut engines: Vec<Opened> =
        vec![cpu::double(&scene).expect("an engine"), cpu::single(&scene).expect("an engine")];
    engines.extend(candidate().map(|candidate| Box::new(gpu(&candidate, &scene, Precision::Single)) as Opened));
    for mut engine in engines {
        let name = format!("{:?}", engine.info());
        for &operation in scene.plan.setup.iter().chain(&scene.plan.kick) {
            engine.apply(operation, &scene.clock(0.01)).expect("an operation");
        }
        let together = [Buffer::Projected, Buffer::Neighbours(Points::Standing), Buffer::Pressure, Buffer::Reported];
        // Whatever was there before.
        let mut arrays = together.map(|buffer| (buffer, Data::Real(vec![f64::NAN; 3])));
        for _ in 0..2 {
            assert_eq!(engine.read_all(&mut arrays), Ok(None), "{name}");
            for (buffer, data) in &arrays {
                assert!(engine.read(*buffer).as_ref() == Ok(data), "{name}: {buffer:?}");
            }
        }
        for (buffer, entry, number) in [(Buffer::Reported, 100, f64::INFINITY), (Buffer::Pressure, 77, f64::NAN)] {
            let Ok(Data::Real(mut values)) = engine.read(buffer) else { panic!("{name}: {buffer:?}") };
            values[entry] = number;
            engine.write(buffer, &Data::Real(values)).expect("an array of that length");
            assert_eq!(engine.read_all(&mut arrays), Ok(Some((buffer, entry))), "{name}");
        }
    }
}
