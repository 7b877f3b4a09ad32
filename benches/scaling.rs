//! What a step of points that move costs per point, from 1e3 to 1e5 points of the two collapses: the pressure solve apart, what a
//! row of the reports takes on the host, and the memory that the arrays take beside what the plan says.
//!
//! Prints a table in Markdown: the CPU engine in f32 and f64 on one thread, and the GPU in f32 where there is one. Of every
//! operation the least time of some steps counts, so that other work on the machine disturbs little. With an argument,
//! `cargo bench --bench scaling -- 1e4`, no more points than that.

use std::collections::BTreeMap;
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
use stillpoint::step::Operation;

/// The cases, and the length of a step over the time in which gravity moves a point by its spacing.
const CASES: [(&str, f64); 2] = [("dam_break_mps", 0.02), ("dam_break_shifted", 0.1)];
/// The breadths of the column in spacings: it is twice as high, in a tank of five breadths by three.
const BREADTHS: [u32; 3] = [22, 70, 220];
/// Steps before those that are timed, and those.
const BEFORE: u32 = 2;
const TIMED: u32 = 4;
/// Reports whose time is taken.
const REPORTS: u32 = 8;

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
    for (name, share) in CASES {
        for breadth in BREADTHS.into_iter().filter(|&breadth| 2.0 * f64::from(breadth).powi(2) < 1.1 * most) {
            let scene = collapse(name, share, breadth, REPORTS)?;
            let dt = scene.case.time.step.expect("a step");
            for (engine, mut opened) in [("CPU, f64", cpu::double(&scene)?), ("CPU, f32", cpu::single(&scene)?)] {
                let report = if engine == "CPU, f64" { Some(report(name, share, breadth)?) } else { None };
                row(name, engine, &scene, opened.as_mut(), dt, report, None)?;
            }
            if let Some(candidate) = &candidate {
                let gpu = Gpu::open_timed(candidate, Precision::Single)?;
                let mut opened = GpuEngine::new(Arc::clone(&scene), gpu)?;
                let held = opened.allocated_bytes();
                row(name, "GPU, f32", &scene, &mut opened, dt, None, Some(held))?;
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
    ];
    Ok(Arc::new(Scene::build(&Case::load(&path, &changes)?)?))
}

fn row(
    name: &str,
    label: &str,
    scene: &Scene,
    engine: &mut dyn Engine,
    dt: f64,
    report: Option<f64>,
    held: Option<u64>,
) -> Result<(), Box<dyn Error>> {
    let clock = scene.clock(dt);
    engine.advance(BEFORE, &clock)?;
    let (mut least, mut iterations) = (BTreeMap::<Operation, f64>::new(), 0);
    for _ in 0..TIMED {
        let before = engine.seconds();
        iterations += engine.advance(1, &clock)?.iterations;
        for (operation, after) in engine.seconds() {
            let spent = after - before.get(&operation).copied().unwrap_or(0.0);
            let least = least.entry(operation).or_insert(f64::INFINITY);
            *least = least.min(spent);
        }
    }
    let solves = |operation: &Operation| matches!(operation, Operation::ConjugateGradient | Operation::Bicgstab);
    let nano = |solve: bool| {
        let taken: f64 = least.iter().filter(|(operation, _)| solves(operation) == solve).map(|(_, taken)| taken).sum();
        1e9 * taken / scene.sizes.points as f64
    };
    let points = scene.sizes.points;
    let real = if label.ends_with("64") { 8 } else { 4 };
    let planned = scene.plan.total_bytes(&scene.sizes, real) as f64 / points as f64;
    let [report, held] = [report, held.map(|held| held as f64 / points as f64)]
        .map(|value| value.map_or(String::new(), |value| format!("{value:.0}")));
    println!(
        "| {name} | {label} | {points} | {:.0} | {:.0} | {} | {report} | {planned:.0} | {held} |",
        nano(false),
        nano(true),
        iterations / u64::from(TIMED)
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
