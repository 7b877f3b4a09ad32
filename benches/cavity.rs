//! The lid-driven cavity run to its steady state on the CPU engine in f64, on one thread: CPU time against error.
//!
//! Prints a table in Markdown. Without arguments: Re 100, regular and random points, 32 to 64 spacings a side. With
//! arguments, a case and spacings of one's own: `cargo bench --bench cavity -- cavity_re1000 64 128`.

use std::env;
use std::error::Error;
use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;

use cpu_time::ProcessTime;
use rayon::ThreadPoolBuilder;
use stillpoint::case::Case;
use stillpoint::cpu::CpuEngine;
use stillpoint::scene::Scene;
use stillpoint::simulation::{Stop, simulate};
use stillpoint::{measure, run};

/// The expectations whose errors are shown.
const EXTREMES: [&str; 3] = ["u_min", "v_max", "v_min"];

fn main() -> ExitCode {
    // Cargo adds --bench.
    let mut arguments = env::args().skip(1).filter(|argument| !argument.starts_with("--"));
    let (cases, cells) = match arguments.next() {
        None => (vec!["cavity_re100_regular".to_owned(), "cavity_re100_random".to_owned()], vec![32, 40, 48, 64]),
        Some(case) => (vec![case], arguments.filter_map(|cells| cells.parse().ok()).collect()),
    };
    if cells.is_empty() {
        eprintln!("usage: cargo bench --bench cavity -- CASE SPACINGS...");
        return ExitCode::from(2);
    }
    match table(&cases, &cells) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn table(cases: &[String], cells: &[u32]) -> Result<(), Box<dyn Error>> {
    ThreadPoolBuilder::new().num_threads(1).build_global()?;
    let errors = EXTREMES.map(|name| format!("{name} error")).join(" | ");
    println!("| case | spacings a side | points | steps | CPU s | {errors} |");
    println!("|---|---|---|---|---|---|---|---|");
    for case in cases {
        for &cells in cells {
            println!("{}", row(case, cells)?);
        }
    }
    Ok(())
}

/// Runs one case. Its CPU seconds, user and system, hold the layout of the points, the setup and the steps.
fn row(name: &str, cells: u32) -> Result<String, Box<dyn Error>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(name).with_extension("toml");
    let case = Case::load(&path, &[format!("cloud.spacing={:?}", 1.0 / f64::from(cells))])?;
    let started = ProcessTime::now();
    let scene = Arc::new(Scene::build(&case)?);
    let mut engine = CpuEngine::<f64>::new(Arc::clone(&scene))?;
    let outcome = simulate(&scene, &mut engine, &mut ())?;
    let seconds = started.elapsed().as_secs_f64();
    let measured = measure::evaluate(&case, &outcome.snapshot, &run::profiles(&case)?)?;
    let error = |name: &str| {
        let found = measured.iter().find(|row| row.name == name).and_then(|row| row.error);
        found.map_or("-".to_owned(), |error| format!("{:.2}%", 100.0 * error))
    };
    let steps = match outcome.stop {
        Stop::Steady => outcome.steps.to_string(),
        other => format!("{} ({other:?})", outcome.steps),
    };
    let errors = EXTREMES.map(error).join(" | ");
    Ok(format!("| {name} | {cells} | {} | {steps} | {seconds:.2} | {errors} |", scene.sizes.points))
}
