//! What a step of points that move costs per point, from 1e3 to 1e5 points of the two collapses: the pressure solve apart, what a
//! row of the reports takes on the host, and the memory that the arrays take beside what the plan says.
//!
//! Prints a table in Markdown: the CPU engine in f64 and f32 on one thread, and the GPU in f32 where there is one. Times are CPU
//! times of the process, which other work on the machine disturbs little and which hold those of a software adapter. A step's price
//! apart from its solve is that of steps whose solve is done before its first iteration. With an argument,
//! `cargo bench --bench scaling -- 1e4`, no more points than that.

use std::env;
use std::error::Error;
use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;

use cpu_time::ProcessTime;
use rayon::ThreadPoolBuilder;
use stillpoint::case::Case;
use stillpoint::cpu;
use stillpoint::engine::Engine;
use stillpoint::gpu::{Gpu, GpuEngine, Precision, adapter};
use stillpoint::scene::Scene;
use stillpoint::simulation::simulate;

/// The cases, and the length of a step over the time in which gravity moves a point by its spacing.
const CASES: [(&str, f64); 2] = [("dam_break_mps", 0.02), ("dam_break_shifted", 0.1)];
/// The breadths of the column in spacings: it is twice as high, in a tank of five breadths by three.
const BREADTHS: [u32; 3] = [22, 70, 220];
/// Steps before those that are timed, and those.
const BEFORE: u32 = 2;
const TIMED: u32 = 4;
/// Times that these are taken, of which the least counts.
const REPEATS: u32 = 3;
/// Reports whose time is taken.
const REPORTS: u32 = 8;

/// An engine, and the bytes that its arrays take where it counts them.
struct Opened {
    engine: Box<dyn Engine>,
    held: Option<u64>,
}

/// Makes the engine of a scene.
type Open<'a> = dyn Fn(&Arc<Scene>) -> Result<Opened, Box<dyn Error>> + 'a;

fn main() -> ExitCode {
    // Cargo adds --bench.
    let most = env::args().skip(1).find_map(|argument| argument.parse::<f64>().ok()).unwrap_or(f64::INFINITY);
    match table(most) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn table(most: f64) -> Result<(), Box<dyn Error>> {
    ThreadPoolBuilder::new().num_threads(1).build_global()?;
    let candidate = adapter::choose(None).ok();
    println!(
        "| case | engine | points | ns a point and step | its solve | iterations | ns a point and report | bytes a point, planned | held |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
    let double = |scene: &Arc<Scene>| Ok(Opened { engine: cpu::double(scene)?, held: None });
    let single = |scene: &Arc<Scene>| Ok(Opened { engine: cpu::single(scene)?, held: None });
    for (name, share) in CASES {
        for breadth in BREADTHS.into_iter().filter(|&breadth| 2.0 * f64::from(breadth).powi(2) < 1.1 * most) {
            let scene = collapse(name, share, breadth, REPORTS)?;
            row(name, "CPU, f64", 8, &scene, &double, Some(report(name, share, breadth)?))?;
            row(name, "CPU, f32", 4, &scene, &single, None)?;
            if let Some(candidate) = &candidate {
                let gpu = |scene: &Arc<Scene>| {
                    let opened = GpuEngine::new(Arc::clone(scene), Gpu::open(candidate, Precision::Single)?)?;
                    let held = Some(opened.allocated_bytes());
                    Ok(Opened { engine: Box::new(opened), held })
                };
                row(name, "GPU, f32", 4, &scene, &gpu, None)?;
            }
        }
    }
    if let Some(candidate) = candidate {
        println!("\nGPU: {}", candidate.info.name);
    }
    Ok(())
}

/// The column of so many spacings, with steps enough for so many reports.
fn collapse(name: &str, share: f64, breadth: u32, reports: u32) -> Result<Arc<Scene>, Box<dyn Error>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(name).with_extension("toml");
    let spacing = 0.05715 / f64::from(breadth);
    let step = share * (spacing / 9.81).sqrt();
    let changes = [
        format!("cloud.spacing={spacing:?}"),
        format!("time.step={step:?}"),
        format!("time.end={:?}", step * f64::from(reports)),
        "expect={}".to_owned(),
    ];
    Ok(Arc::new(Scene::build(&Case::load(&path, &changes)?)?))
}

/// CPU seconds of a step, and the pressure iterations that it takes.
fn step(engine: &mut dyn Engine, scene: &Scene) -> Result<(f64, u64), Box<dyn Error>> {
    let clock = scene.clock(scene.case.time.step.ok_or("no step")?);
    engine.advance(BEFORE, &clock)?;
    let started = ProcessTime::now();
    let iterations = engine.advance(TIMED, &clock)?.iterations;
    Ok((started.elapsed().as_secs_f64() / f64::from(TIMED), iterations / u64::from(TIMED)))
}

/// One row of the table; `open` makes the engine.
fn row(
    name: &str,
    label: &str,
    real: usize,
    scene: &Arc<Scene>,
    open: &Open,
    report: Option<f64>,
) -> Result<(), Box<dyn Error>> {
    let points = scene.sizes.points as f64;
    let mut loose = Scene::clone(scene);
    loose.constants.tolerance = 1.0;
    let loose = Arc::new(loose);
    let mut apart = f64::INFINITY;
    for _ in 0..REPEATS {
        apart = apart.min(step(open(&loose)?.engine.as_mut(), &loose)?.0);
    }
    let Opened { mut engine, held } = open(scene)?;
    let (whole, iterations) = step(engine.as_mut(), scene)?;
    let [apart, whole] = [apart, whole].map(|seconds| 1e9 * seconds / points);
    let planned = scene.plan.total_bytes(&scene.sizes, real) as f64 / points;
    let shown = |value: Option<f64>| value.map_or(String::new(), |value| format!("{value:.0}"));
    println!(
        "| {name} | {label} | {points} | {apart:.0} | {:.0} | {iterations} | {} | {planned:.0} | {} |",
        whole - apart,
        shown(report),
        shown(held.map(|held| held as f64 / points)),
    );
    Ok(())
}

/// CPU time of a row of the reports, ns a point: that of a run with a row after every step less that of a run with one row.
fn report(name: &str, share: f64, breadth: u32) -> Result<f64, Box<dyn Error>> {
    let mut scene = Scene::clone(&*collapse(name, share, breadth, REPORTS)?);
    // Solves that take no time worth mentioning.
    scene.constants.tolerance = 1.0;
    let mut taken = |every: u32| -> Result<f64, Box<dyn Error>> {
        scene.case.output.report_every = every;
        let shared = Arc::new(scene.clone());
        let mut engine = cpu::double(&shared)?;
        let started = ProcessTime::now();
        simulate(&shared, engine.as_mut(), &mut ())?;
        Ok(started.elapsed().as_secs_f64())
    };
    let seconds = (taken(1)? - taken(REPORTS)?) / f64::from(REPORTS - 1);
    Ok(1e9 * seconds / scene.sizes.points as f64)
}
