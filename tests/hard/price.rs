//! What the guards cost of a step: on the CPU in f64, on one thread.
//!
//! `cargo test --release --test hard -- --ignored --nocapture the_price`

use std::fs;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use stillpoint::case::Case;
use stillpoint::cpu;
use stillpoint::cpu::operations::measure;
use stillpoint::engine::{Data, first_lost};
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

/// A row of the table, in per cent of a step. The guards are the energy that is watched and the speed that the next step is chosen
/// by; the state to go back to, and the search in it for numbers that are none; the same search on the way; and what points
/// that move are judged by. What else a row costs is output: the divergence, and what `motion.csv` has beside.
fn shares(name: &str, set: &[&str]) {
    let path = Path::new(ROOT).join("cases").join(name).with_extension("toml");
    let set: Vec<String> = set.iter().map(|&key| key.to_owned()).collect();
    let scene = Arc::new(Scene::build(&Case::load(&path, &set).expect("a case")).expect("a scene"));
    let mut engine = cpu::double(&scene).expect("an engine");
    let outcome = simulate(&scene, engine.as_mut(), &mut ()).expect("a run");
    let clock = scene.clock(outcome.state.progress.dt);
    let step = mean(|| engine.advance(1, &clock).map(|_| ()).expect("steps"));
    let share = |seconds: f64| 100.0 * seconds / step;
    // Measured again at once, nothing has changed.
    let still = mean(|| engine.measure(clock.dt).map(|_| ()).expect("figures"));
    let mut values = |buffer| match engine.read(buffer).expect("an array") {
        Data::Real(values) => values,
        Data::Index(_) => panic!("floats"),
    };
    let [velocity, volume, mut before] = [Buffer::Projected, Buffer::Volume, Buffer::Reported].map(&mut values);
    let searched = [Buffer::Projected, Buffer::Pressure, Buffer::Source].map(&mut values);
    let points = scene.sizes.points;
    let mut speeds = |velocity: &[f64]| {
        let found = measure::speeds(velocity, &volume, &mut before, points, clock.dt);
        assert!(found.max_speed > 0.0);
    };
    let divergence = share(still - mean(|| speeds(&velocity)));
    let later: Vec<f64> = velocity.iter().map(|u| 1.01 * u).collect();
    let (mut turns, both) = (0, [&velocity, &later]);
    let watched = share(mean(|| {
        turns += 1;
        speeds(both[turns % 2]);
    }));
    let lost = |values: &Vec<f64>| first_lost(values, |value| !value.is_finite());
    let search = share(mean(|| assert_eq!(searched.iter().find_map(lost), None)));
    let mut state = State::read(&scene, engine.as_mut(), &Progress::default()).expect("a state");
    let kept = share(mean(|| assert_eq!(state.renew(&scene, engine.as_mut()).expect("a state"), None)));
    let (mut judged, mut measured, mut every) = (0.0, 0.0, scene.case.output.report_every);
    if scene.plan.moves() {
        let mut flags = motion::flags(&scene);
        let read = mean(|| assert_eq!(engine.read_all(&mut flags).expect("flags"), None));
        let seen = motion::State::new(&scene, &state.arrays, &flags);
        let judge = mean(|| assert!(motion::watch(&scene, &seen).nearest[0] > 0.0));
        let look = || motion::measure(&scene, &seen, motion::watch(&scene, &seen), 0, 0.0, 1.0);
        let look = mean(|| assert!(look().area > 0.0));
        (judged, measured, every) = (share(judge), share(read + look - judge), every.min(10));
    }
    let (guards, often) = (watched + kept + judged, f64::from(every));
    println!(
        "| `{name}` | {points} | {:.2} | {watched:.2} | {kept:.2} | {search:.2} | {judged:.2} | {:.2} | {divergence:.2} | \
         {measured:.2} | {every} | {:.2} | {:.2} |",
        1e3 * step,
        guards + search,
        guards / often + search / often.min(10.0),
        (guards + divergence + measured) / often + search / often.min(10.0),
    );
}

#[test]
#[ignore = "a measurement"]
fn the_price_of_the_guards() {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    pool.install(prices);
}

fn prices() {
    println!(
        "| case | points | a step, ms | energy, speed | state | search | motion | guards | divergence | measures | steps a row \
         | guards | all |"
    );
    println!("|{}", "---|".repeat(13));
    for name in ["cavity_re100_regular", "cavity_re400", "cavity_re1000"] {
        shares(name, &["time.end=0.5", "expect={}"]);
    }
    for name in ["dam_break_mps", "dam_break_shifted", "hydrostatic_mps", "standing_wave", "rotating_square"] {
        shares(name, &["time.end=0.05", "expect={}"]);
    }
}
