//! `plan`: the operations of one time step and the arrays they need, as both engines run them.

use super::args::{PlanArguments, Precision};
use super::{CliError, load, print};
use crate::scene::Scene;
use crate::step::{Operation, Points};

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
        ("drift, every step", &scene.plan.drift),
        ("kick, every step", &scene.plan.kick),
    ] {
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
    ))
}

/// Says so where an operation works on the moved points.
fn places(operation: Operation) -> &'static str {
    match operation {
        Operation::BuildCells(Points::Moved)
        | Operation::FindNeighbours(Points::Moved)
        | Operation::Factorise(Points::Moved)
        | Operation::WidenSupport(Points::Moved)
        | Operation::FitVelocity(Points::Moved) => " (moved points)",
        _ => "",
    }
}
