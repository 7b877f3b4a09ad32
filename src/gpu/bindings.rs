//! Which arrays a kernel binds, under which names: written from the operation's own lists, never by hand.

use std::collections::BTreeSet;
use std::fmt::Write;

use crate::scene::Scene;
use crate::step::{Buffer, Element, Operation, Points, Sizes};

/// An array that a kernel can bind.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Array {
    /// One of the plan's.
    Field(Buffer),
    /// One of the engine's own.
    Own(Own),
}

/// Arrays that belong to the engine, not to the plan.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Own {
    /// The state of a batch.
    Control,
    /// Workgroups of every kind of dispatch.
    Dispatches,
    /// Lengths in time, and what follows from them.
    Clock,
    /// Numbers that a solve or a measurement hands on.
    Scalars,
    /// Sums over each workgroup's points.
    Partials,
    /// Maxima over each workgroup's points.
    Maxima,
    /// Points a cell.
    Tally,
    /// Points a tile of cells.
    TileSums,
    /// Of the coarse pressure, at all places: its right side, its solution, and that smoothed.
    CoarseRight,
    CoarseValue,
    CoarseSmoothed,
}

impl Own {
    pub const ALL: [Own; 11] = [
        Own::Control,
        Own::Dispatches,
        Own::Clock,
        Own::Scalars,
        Own::Partials,
        Own::Maxima,
        Own::Tally,
        Own::TileSums,
        Own::CoarseRight,
        Own::CoarseValue,
        Own::CoarseSmoothed,
    ];

    pub fn name(self) -> &'static str {
        match self {
            Own::Control => "control",
            Own::Dispatches => "dispatches",
            Own::Clock => "clock",
            Own::Scalars => "scalars",
            Own::Partials => "partials",
            Own::Maxima => "maxima",
            Own::Tally => "tally",
            Own::TileSums => "tile_sums",
            Own::CoarseRight => "coarse_right",
            Own::CoarseValue => "coarse_value",
            Own::CoarseSmoothed => "coarse_smoothed",
        }
    }

    fn element(self) -> &'static str {
        match self {
            Own::Control | Own::Tally => "atomic<u32>",
            Own::Dispatches | Own::TileSums => "u32",
            Own::Clock | Own::Scalars | Own::CoarseRight | Own::CoarseValue | Own::CoarseSmoothed => "real",
            Own::Partials => "sums",
            Own::Maxima => "vector",
        }
    }
}

/// One line of a kernel's bindings; its number is its place in the list.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Binding {
    pub array: Array,
    pub name: String,
    pub written: bool,
}

/// The arrays that `text`, a kernel with its imports, names, out of those that its operation lists and the engine's own.
pub(super) fn bindings(text: &str, reads: &[(Buffer, String)], writes: &[(Buffer, String)]) -> Vec<Binding> {
    let words = words(text);
    let field = |written: bool| {
        move |(buffer, name): &(Buffer, String)| Binding { array: Array::Field(*buffer), name: name.clone(), written }
    };
    let own = Own::ALL.iter().map(|&own| Binding {
        array: Array::Own(own),
        name: own.name().to_owned(),
        written: own != Own::Clock,
    });
    let all = writes.iter().map(field(true)).chain(reads.iter().map(field(false))).chain(own);
    all.filter(|binding| words.contains(binding.name.as_str())).collect()
}

/// What an operation's kernels may bind: arrays read, arrays written.
pub(super) fn arrays_of(operation: Operation, scene: &Scene) -> [Vec<(Buffer, String)>; 2] {
    let plan = &scene.plan;
    let named = |buffer: Buffer| (buffer, name_in(operation, buffer, scene));
    let writes = operation.writes();
    let reads = operation.reads(plan).into_iter().filter(|buffer| !writes.contains(buffer));
    [reads.map(named).collect(), writes.iter().copied().map(named).collect()]
}

/// The name under which an operation's kernels know an array: by its part where the plan says which array plays it, and
/// without "moved" where the same kernel serves standing and moved points.
fn name_in(operation: Operation, buffer: Buffer, scene: &Scene) -> String {
    let plan = &scene.plan;
    let carries = matches!(
        operation,
        Operation::FitVelocity(_)
            | Operation::RemapDeparture
            | Operation::FindDepartures
            | Operation::CarryVelocity
            | Operation::MovePoints
            | Operation::RemapForward
            | Operation::KeepVelocity
    );
    if carries && buffer == plan.moving() {
        return "moving".to_owned();
    }
    if let Operation::Viscosity(stage) = operation
        && buffer == stage.velocity()
    {
        return "diffused".to_owned();
    }
    if let Operation::OpenSides(kicked) = operation
        && buffer == kicked.velocity()
    {
        return "followed".to_owned();
    }
    if matches!(operation, Operation::RemapDeparture | Operation::FindDepartures) {
        let [around, around_count] = plan.around();
        if buffer == around || buffer == around_count {
            return if buffer == around { "around" } else { "around_count" }.to_owned();
        }
    }
    // One kernel serves every field.
    match (operation, buffer) {
        (Operation::Buoyancy, _) => {}
        (_, Buffer::Carried(_)) => return "carried".to_owned(),
        (_, Buffer::Reach(_)) => return "reach".to_owned(),
        _ => {}
    }
    let name = buffer.name();
    match operation {
        Operation::BuildCells(Points::Moved)
        | Operation::FindNeighbours(Points::Moved)
        | Operation::Factorise(Points::Moved)
        | Operation::WidenSupport(Points::Moved)
        | Operation::FitVelocity(Points::Moved) => name.strip_prefix("moved_").map(str::to_owned).unwrap_or(name),
        _ => name,
    }
}

/// The declarations, for the head of the source.
pub(super) fn declare(bindings: &[Binding]) -> String {
    let mut text = String::new();
    for (number, Binding { array, name, written }) in bindings.iter().enumerate() {
        let access = if *written { "read_write" } else { "read" };
        let element = match array {
            Array::Own(own) => own.element(),
            Array::Field(buffer) if buffer.element() == Element::Index => "u32",
            Array::Field(buffer) if interleaved(*buffer) => "vector",
            Array::Field(_) => "real",
        };
        // Writing to a string cannot fail.
        let _ = writeln!(text, "@group(0) @binding({number}) var<storage, {access}> {name}: array<{element}>;");
    }
    text
}

/// x and y of a point side by side.
fn interleaved(buffer: Buffer) -> bool {
    buffer.per_point(&Sizes::default()) == Some(2)
}

/// The identifiers of a source, comments apart.
fn words(text: &str) -> BTreeSet<&str> {
    let code = text.lines().map(|line| line.split("//").next().unwrap_or_default());
    code.flat_map(|line| line.split(|c: char| !c.is_alphanumeric() && c != '_')).collect()
}
