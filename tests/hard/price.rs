//! What the guards cost of a step: on the CPU in f64, on one thread, a row of diagnostics after every step.
//!
//! `cargo test --release --test hard -- --ignored --nocapture the_price`

use std::fs;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use stillpoint::case::Case;
use stillpoint::cpu;
use stillpoint::cpu::operations::measure;
use stillpoint::engine::Data;
use stillpoint::motion;
use stillpoint::scene::Scene;
use stillpoint::simulation::{Progress, State, simulate};
use stillpoint::step::Buffer;

use crate::ROOT;

/// Each is done over and over for so long, s.
const ENOUGH: f64 = 0.4;

/// What this thread has had of a processor so far, s: a busy machine does not lengthen it. Where nobody says, the clock.
fn spent(started: Instant) -> f64 {
    let nanoseconds = fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = nanoseconds.and_then(|text| text.split(' ').next()?.parse::<f64>().ok());
    nanoseconds.map_or(started.elapsed().as_secs_f64(), |spent| 1e-9 * spent)
}

/// Mean time of `body`, s.
fn mean(mut body: impl FnMut()) -> f64 {
    let started = Instant::now();
    let (before, mut times) = (spent(started), 0);
    loop {
        (0..10).for_each(|_| body());
        times += 10;
        let taken = spent(started) - before;
        if taken > ENOUGH {
            return taken / f64::from(times);
        }
    }
}

/// Shares of a step, in per cent. The guards are the energy that is watched and the speed that the next step is chosen by, the
/// state to go back to, and the search for numbers in it that are none. All figures of a row have the first in them.
fn shares(name: &str, set: &[&str]) {
    let path = Path::new(ROOT).join("cases").join(name);
    let set: Vec<String> = set.iter().map(|&key| key.to_owned()).collect();
    let scene = Arc::new(Scene::build(&Case::load(&path, &set).expect("a case")).expect("a scene"));
    let mut engine = cpu::double(&scene).expect("an engine");
    let outcome = simulate(&scene, engine.as_mut(), &mut ()).expect("a run");
    let clock = scene.clock(outcome.state.progress.dt);
    let mut steps = |count: u32| engine.advance(count, &clock).map(|_| ()).expect("steps");
    let step = mean(|| steps(1));
    let figures = mean(|| engine.measure(clock.dt).map(|_| ()).expect("figures"));
    let values = |buffer| match engine.read(buffer).expect("an array") {
        Data::Real(values) => values,
        Data::Index(_) => panic!("floats"),
    };
    let [velocity, volume, mut before] = [Buffer::Projected, Buffer::Volume, Buffer::Reported].map(values);
    let points = scene.sizes.points;
    let watched = mean(|| assert!(measure::speeds(&velocity, &volume, &mut before, points, clock.dt).max_speed > 0.0));
    let mut state = State::read(&scene, engine.as_mut(), &Progress::default()).expect("a state");
    let kept = mean(|| assert_eq!(state.renew(&scene, engine.as_mut()).expect("a state"), None));
    let fluid = &outcome.snapshot;
    let look = || {
        let state = motion::State {
            position: &fluid.position,
            velocity: &fluid.velocity,
            pressure: &fluid.pressure,
            pressured: &fluid.position,
            surface: &[],
            rung: &[],
        };
        drop(motion::measure(&scene, &state, 0, 0.0, &mut 1.0));
    };
    let looked = if scene.plan.moves() { mean(look) } else { 0.0 };
    let share = |seconds: f64| 100.0 * seconds / step;
    println!(
        "{name}, {} points: a step {:.3} ms; energy and speed {:.2}%, state {:.2}%; \
         all figures {:.2}%, a look at points that move {:.2}%",
        points,
        1e3 * step,
        share(watched),
        share(kept),
        share(figures),
        share(looked),
    );
}

#[test]
#[ignore = "a measurement"]
fn the_price_of_the_guards() {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    pool.install(prices);
}

fn prices() {
    for name in ["cavity_re100_regular.toml", "cavity_re400.toml", "cavity_re1000.toml"] {
        shares(name, &["time.end=0.5"]);
    }
    for name in ["dam_break_shifted.toml", "dam_break_mps.toml"] {
        shares(name, &["time.end=0.05"]);
    }
}
