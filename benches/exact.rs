//! Errors against the exact flows on the CPU engine in f64: how they fall with the spacing, and with the step at one spacing.
//!
//! Prints tables in Markdown: `cargo bench --bench exact`. With arguments a table of one's own, a case, spacings a metre,
//! then keys to set: `cargo bench --bench exact -- taylor_green 32,64 time.splitting=projection`.

use std::env;
use std::error::Error;
use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;

use stillpoint::case::{Case, Component};
use stillpoint::cpu;
use stillpoint::exact::Exact;
use stillpoint::measure::FieldError;
use stillpoint::scene::Scene;
use stillpoint::simulation::simulate;

fn main() -> ExitCode {
    // Cargo adds --bench.
    let mut arguments = env::args().skip(1).filter(|argument| !argument.starts_with("--"));
    let done = match arguments.next() {
        None => spacings().and_then(|()| steps()),
        Some(case) => {
            let cells = arguments.next().unwrap_or_default();
            let cells: Vec<u32> = cells.split(',').filter_map(|cells| cells.parse().ok()).collect();
            let keys: Vec<String> = arguments.collect();
            own(&case, &cells, &keys)
        }
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Steps, and the errors of velocity and pressure at the end of one run.
struct Row {
    steps: u64,
    velocity: f64,
    pressure: f64,
}

fn run(name: &str, cells: u32, keys: &[&str]) -> Result<Row, Box<dyn Error>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(name).with_extension("toml");
    let spacing = format!("cloud.spacing={:?}", 1.0 / f64::from(cells));
    let case = Case::load(&path, &keys.iter().map(|key| (*key).to_owned()).chain([spacing]).collect::<Vec<_>>())?;
    let scene = Arc::new(Scene::build(&case)?);
    let outcome = simulate(&scene, cpu::double(&scene)?.as_mut(), &mut ())?;
    let exact = Exact::of(&case).ok_or("the case knows no exact flow")?;
    let error = |component| {
        let FieldError { difference, exact } = FieldError::new(&outcome.snapshot, &exact, component);
        difference / exact
    };
    Ok(Row { steps: outcome.steps, velocity: error(Component::Velocity), pressure: error(Component::P) })
}

const ARRANGEMENTS: [(&str, &[&str]); 4] = [
    ("regular, plain faces", &["cloud.arrangement=regular", "effects.pressure.divergence=faces"]),
    ("jittered, plain faces", &["effects.pressure.divergence=faces"]),
    ("jittered", &[]),
    ("random", &["cloud.arrangement=random", "method.radius=2.8"]),
];

/// Pressures are compared too, and short steps leave more of them within the tolerance.
const TIGHT: &str = "effects.pressure.tolerance=1e-8";

/// Errors over the spacing, the step in proportion.
fn spacings() -> Result<(), Box<dyn Error>> {
    println!("| case | points | spacings a metre | steps | velocity error | order | pressure error | order |");
    println!("|---|---|---|---|---|---|---|---|");
    for case in ["taylor_green", "kovasznay"] {
        for (name, keys) in ARRANGEMENTS {
            table(case, name, &[16, 32, 64], &[keys, &[TIGHT, "time.courant=0.2"]].concat())?;
        }
    }
    println!();
    Ok(())
}

fn table(case: &str, name: &str, cells: &[u32], keys: &[&str]) -> Result<(), Box<dyn Error>> {
    let mut before: Option<(u32, Row)> = None;
    for &cells in cells {
        let row = run(case, cells, keys)?;
        let order = |pick: fn(&Row) -> f64| {
            before.as_ref().map_or("".to_owned(), |(coarse, from)| {
                let order = (pick(from) / pick(&row)).ln() / (f64::from(cells) / f64::from(*coarse)).ln();
                format!("{order:.2}")
            })
        };
        let Row { steps, velocity, pressure } = row;
        println!(
            "| {case} | {name} | {cells} | {steps} | {velocity:.2e} | {} | {pressure:.2e} | {} |",
            order(|row| row.velocity),
            order(|row| row.pressure),
        );
        before = Some((cells, row));
    }
    Ok(())
}

/// Errors over the step at one spacing: both remaps, both splittings.
fn steps() -> Result<(), Box<dyn Error>> {
    const COURANT: [&str; 7] = ["0.8", "0.4", "0.2", "0.1", "0.05", "0.02", "0.01"];
    println!("| points | remap | splitting | {} |", COURANT.join(" | "));
    println!("|---|---|---|{}", "---|".repeat(COURANT.len()));
    for (name, arrangement) in ARRANGEMENTS {
        for remap in ["departure", "forward"] {
            for splitting in ["reflection", "projection"] {
                let mut errors = Vec::new();
                for courant in COURANT {
                    let keys = [
                        format!("effects.advection.remap={remap}"),
                        format!("time.splitting={splitting}"),
                        format!("time.courant={courant}"),
                    ];
                    let keys = arrangement.iter().copied().chain(keys.iter().map(String::as_str));
                    let keys: Vec<&str> = keys.chain([TIGHT]).collect();
                    let error = run("taylor_green", 32, &keys)?.velocity;
                    errors.push(if error < 1.0 { format!("{error:.2e}") } else { "diverged".to_owned() });
                }
                println!("| {name} | {remap} | {splitting} | {} |", errors.join(" | "));
            }
        }
    }
    Ok(())
}

fn own(case: &str, cells: &[u32], keys: &[String]) -> Result<(), Box<dyn Error>> {
    table(case, "", cells, &keys.iter().map(String::as_str).collect::<Vec<_>>())
}
