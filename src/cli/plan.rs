//! `plan`: the operations of one time step and the arrays they need, as both engines run them.

use std::sync::Arc;

use super::args::{PlanArguments, Precision};
use super::{CliError, load, print};
use crate::cpu;
use crate::scene::Scene;
use crate::simulation::prices;
use crate::step::Operation;

pub(super) fn plan(arguments: &PlanArguments) -> Result<(), CliError> {
    let case = load(&arguments.case)?;
    let path = arguments.case.case.clone();
    let scene = Scene::build(&case).map_err(|source| CliError::Scene { path, source })?;
    let (name, real) = match arguments.precision {
        Some(Precision::F64) => ("f64", 8),
        Some(Precision::F32) | None => ("f32", 4),
    };
    print(&case.title)?;
    for (title, operations) in [
        ("setup, once", &scene.plan.setup),
        ("when the step changes", &scene.plan.on_step),
        ("drift, every step", &scene.plan.drift),
        ("kick, every step", &scene.plan.kick),
    ] {
        if title == "when the step changes" && operations.is_empty() {
            continue;
        }
        print(format_args!("\n{title}"))?;
        for &operation in operations {
            print(format_args!("  {}{}", operation.name(), places(operation)))?;
        }
    }
    let points = scene.sizes.points as f64;
    print(format_args!("\nbuffers, {name}{:>24} {:>14}", "bytes per point", "bytes"))?;
    for buffer in scene.plan.buffers() {
        let bytes = scene.plan.bytes(buffer, &scene.sizes, real);
        print(format_args!("  {:<24} {:>9.1} {bytes:>14}", buffer.name(), bytes as f64 / points))?;
    }
    let total = scene.plan.total_bytes(&scene.sizes, real);
    print(format_args!("  {:<24} {:>9.1} {total:>14}", "total", total as f64 / points))?;
    print(format_args!(
        "\n{} points, {} inside; at most {} neighbours and {} faces a point",
        scene.sizes.points, scene.sizes.interior, scene.sizes.capacity, scene.sizes.face_capacity
    ))?;
    if arguments.measure { measure(scene, arguments.precision) } else { Ok(()) }
}

/// Steps of the case, timed: what each operation and each effect takes of one, on the CPU engine.
fn measure(scene: Scene, precision: Option<Precision>) -> Result<(), CliError> {
    if !scene.plan.flows {
        return print("\na problem without time has no step to measure");
    }
    let scene = Arc::new(scene);
    let (name, engine) = match precision {
        Some(Precision::F32) => ("f32", cpu::single(&scene)),
        Some(Precision::F64) | None => ("f64", cpu::double(&scene)),
    };
    let mut engine = engine?;
    let prices = prices(&scene, engine.as_mut())?;
    let points = scene.sizes.points as f64;
    let row = |name: &str, seconds: f64| {
        let (micro, nano, share) = (1e6 * seconds, 1e9 * seconds / points, 100.0 * seconds / prices.step);
        print(format_args!("  {name:<24} {micro:>12.2} {nano:>14.2} {share:>8.1}%"))
    };
    let cores = rayon::current_num_threads();
    print(format_args!(
        "\n{} steps, cpu {name}, {cores} threads{:>18} {:>14} {:>9}",
        prices.steps, "us a step", "ns a point", "share"
    ))?;
    for &(operation, seconds) in &prices.operations {
        row(&format!("{}{}", operation.name(), of(operation)), seconds)?;
    }
    print("")?;
    for (effect, seconds) in prices.effects() {
        row(&effect.to_string(), seconds)?;
    }
    row("all operations", prices.sum())?;
    row("a step", prices.step)
}

/// Which field, where one operation serves several.
fn of(operation: Operation) -> String {
    match operation {
        Operation::FitScalar(field) | Operation::CarryScalar(field) => format!(" {}", field.name()),
        Operation::Diffuse(field, stage) => format!(" {} {stage:?}", field.name()).to_lowercase(),
        Operation::HeatWalls(stage) | Operation::Viscosity(stage) => format!(" {stage:?}").to_lowercase(),
        Operation::OpenSides(kicked) => format!(" {kicked:?}").to_lowercase(),
        _ => String::new(),
    }
}

/// Says so where an operation works on the moved points.
fn places(operation: Operation) -> &'static str {
    if operation.is_of_moved_points() { " (moved points)" } else { "" }
}
