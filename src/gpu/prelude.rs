//! What every kernel's source begins with: the float type and the constants, written from those that Rust uses.

use std::fmt::Write;

use glam::DVec2;

use super::layout::{Ended, Extent, Halted, NO_POINT, Phase, Scalar, Time, Word};
use crate::case::PressureForm;
use crate::cpu::operations::integral::DIMENSIONS;
use crate::cpu::operations::moments::{PIVOT_THRESHOLD, entries};
use crate::cpu::operations::moving::{collide, density, fits, least, pressure, shift, surface, travel};
use crate::cpu::operations::pressure::Stop;
use crate::cpu::operations::{coarse, implicit_viscosity};
use crate::scene::Scene;
use crate::step::coarse::levels;
use crate::step::{BLOCK, Equation, PRESSURE_RELAXATION, Rung};

/// Invocations of a workgroup over points or cells, and those that add up its sum in the middle.
pub(super) const GROUP: u32 = 64;
const GROUP_ROWS: u32 = 8;
/// Invocations of the one workgroup that adds up the partial sums, and those in the middle.
pub(super) const REDUCERS: u32 = 256;
const REDUCER_ROWS: u32 = 16;
/// Most workgroups along one dimension of a dispatch.
const MOST_GROUPS: u32 = 65_535;

/// The float type of the fields.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Precision {
    /// f32: every adapter.
    Single,
    /// f64: adapters with 64-bit floats in shaders.
    Double,
}

impl Precision {
    pub fn bytes(self) -> usize {
        match self {
            Precision::Single => 4,
            Precision::Double => 8,
        }
    }

    /// `f32` or `f64`.
    pub fn name(self) -> &'static str {
        match self {
            Precision::Single => "f32",
            Precision::Double => "f64",
        }
    }

    fn epsilon(self) -> f64 {
        match self {
            Precision::Single => f64::from(f32::EPSILON),
            Precision::Double => f64::EPSILON,
        }
    }
}

/// Workgroups over points, over cells, and over the two finest levels of a coarse pressure where there is one.
#[derive(Debug, Clone, Copy)]
pub(super) struct Shape {
    pub points: u32,
    pub cells: u32,
    pub coarse: u32,
    pub fours: u32,
}

impl Shape {
    pub fn new(scene: &Scene) -> Self {
        let groups = |count: usize| count.div_ceil(GROUP as usize) as u32;
        let (points, cells) = (groups(scene.padded()), groups(scene.sizes.cells + 1));
        let [coarse, fours] = match scene.aggregates() {
            Some(aggregates) => [0, 1].map(|k| aggregates.levels.get(k).map_or(0, |level| groups(level.count))),
            None if scene.plan.coarsens() => {
                let fours = levels(&scene.constants.grid).get(1).map_or(0, |level| groups(level.columns * level.rows));
                [cells, fours]
            }
            None => [0, 0],
        };
        Self { points, cells, coarse, fours }
    }

    /// The same along x and y.
    pub fn extent(groups: u32) -> [u32; 2] {
        [groups.min(MOST_GROUPS), groups.div_ceil(MOST_GROUPS)]
    }
}

/// Types and constants for the kernels of `scene`.
pub(super) fn prelude(scene: &Scene, precision: Precision) -> String {
    let (sizes, constants) = (&scene.sizes, &scene.constants);
    let shape = Shape::new(scene);
    let mut text =
        format!("alias real = {};\nalias vector = vec2<real>;\nalias sums = vec4<real>;\n", precision.name());
    let forced = if scene.plan.forces_reach_walls() { sizes.points } else { sizes.interior };
    let whole: &[(&str, usize)] = &[
        ("BLOCK", BLOCK),
        ("POINTS", sizes.points),
        ("PADDED", scene.padded()),
        ("INTERIOR", sizes.interior),
        ("SHIFTED", constants.shift.rows),
        ("PRESSURED", sizes.pressured),
        ("FEWEST", constants.fewest as usize),
        ("SURFACE_GAP", surface::GAP as usize),
        ("FORCED", forced),
        ("CAPACITY", sizes.capacity),
        ("FACE_CAPACITY", sizes.face_capacity),
        ("FLUX_CAPACITY", sizes.flux_capacity),
        ("OPEN_CAPACITY", sizes.open_capacity),
        ("AROUND_CAPACITY", scene.plan.around_capacity(sizes)),
        ("CELLS", sizes.cells),
        ("CELLS_X", constants.grid.cells[0] as usize),
        ("CELLS_Y", constants.grid.cells[1] as usize),
        ("TILES", sizes.cells.div_ceil(GROUP as usize)),
        ("ORDER", constants.order),
        ("COEFFICIENTS", sizes.coefficients),
        ("FACTOR", entries(sizes.coefficients)),
        ("WIDER_STEPS", Rung::WIDER.len()),
        ("RUNG_LINEAR", Rung::LINEAR as usize),
        ("RUNG_NEAREST", Rung::NEAREST as usize),
        ("RUNG_FAILED", Rung::FAILED as usize),
        ("MAX_ITERATIONS", constants.max_iterations as usize),
        ("VISCOUS_ITERATIONS_ALLOWED", implicit_viscosity::MOST_ITERATIONS as usize),
        ("EQUATION_PRESSURE", Equation::Pressure as usize),
        ("EQUATION_VISCOSITY", Equation::Viscosity as usize),
        ("STOP_PATIENCE", Stop::PATIENCE as usize),
        ("STOP_RESTARTS", Stop::RESTARTS as usize),
        ("GROUP", GROUP as usize),
        ("GROUP_ROWS", GROUP_ROWS as usize),
        ("GROUPS", shape.points as usize),
        ("REDUCERS", REDUCERS as usize),
        ("REDUCER_ROWS", REDUCER_ROWS as usize),
        ("MOST_GROUPS", MOST_GROUPS as usize),
        ("COARSE_GROUPS", shape.coarse as usize),
        ("PLACES", sizes.coarse),
        ("NO_POINT", NO_POINT as usize),
    ];
    let real: &[(&str, f64)] = &[
        ("RADIUS", constants.radius),
        ("SPACING", constants.spacing),
        ("DENSITY", constants.density),
        ("FITTED_DENSITY", constants.crowd),
        ("PER_AREA", density::per_area(constants.lattice)),
        ("MOVING_PIVOT", fits::PIVOT),
        ("SPREAD", fits::SPREAD),
        ("LEAST_DETERMINANT", least::DETERMINANT),
        ("WRONG_SIGN", pressure::WRONG_SIGN),
        ("SHEET", pressure::SHEET),
        ("LONGEST_PUSH", pressure::LONGEST_PUSH),
        ("SURFACE_THRESHOLD", surface::THRESHOLD),
        ("SURFACE_THIN", surface::THIN),
        ("TWICE_CIRCLE", 2.0 * surface::REACH * constants.spacing / constants.radius),
        ("SHIFT_REACH", shift::REACH),
        ("SHIFT_STRENGTH", shift::STRENGTH),
        ("SHIFT_PARTING", shift::PARTING),
        ("SHIFT_LONGEST", shift::LONGEST),
        ("CLEARANCE", travel::CLEARANCE * constants.spacing),
        ("BOUNCE_DISTANCE", scene.bounce_distance()),
        ("BOUNCE_RESTITUTION", collide::RESTITUTION),
        ("TRACE", constants.trace),
        ("DRAG_INERTIA", constants.drag_inertia),
        ("REFERENCE_TEMPERATURE", constants.reference_temperature),
        ("LATTICE_DENSITY", constants.lattice.density),
        ("LATTICE_SPREAD", constants.lattice.spread),
        ("DIMENSIONS", DIMENSIONS),
        ("PIVOT_THRESHOLD", PIVOT_THRESHOLD),
        ("PRESSURE_RELAXATION", PRESSURE_RELAXATION),
        ("COARSE_SCALE", coarse::SCALE),
        ("COARSE_DAMPING", coarse::DAMPING),
        ("COARSE_SIGN", if scene.plan.form == Some(PressureForm::Integral) { 1.0 } else { -1.0 }),
        ("STOP_FLOOR", constants.floor),
        ("VISCOUS_FLOOR", Stop::CONSERVATIVE_FLOOR),
        ("DYNAMIC_VISCOSITY", constants.density * constants.viscosity),
        ("EPSILON", precision.epsilon()),
        ("SHIFT_PER_POINT", constants.shift.factor / sizes.points as f64),
    ];
    for (name, value) in whole {
        line(&mut text, format_args!("const {name}: u32 = {value}u;"));
    }
    for (name, value) in real {
        line(&mut text, format_args!("const {name}: real = {value:e};"));
    }
    let per_period = constants.period.map(|length| if length > 0.0 { 1.0 / length } else { 0.0 });
    let pairs: &[(&str, DVec2)] = &[
        ("CELLS_PER_METRE", constants.grid.per_metre.into()),
        ("SIZE", constants.size),
        ("PERIOD", constants.period),
        ("PER_PERIOD", per_period),
        ("GRAVITY", constants.gravity),
        ("LIFT", constants.lift),
    ];
    for (name, DVec2 { x, y }) in pairs {
        line(&mut text, format_args!("const {name} = vector({x:e}, {y:e});"));
    }
    line(&mut text, format_args!("const MIRRORS: bool = {};", scene.plan.mirrors()));
    line(&mut text, format_args!("const SINGULAR: bool = {};", constants.singular));
    let [x, y] = constants.grid.periodic;
    line(&mut text, format_args!("const PERIODIC = vec2<bool>({x}, {y});"));
    let extents = [("POINTS_EXTENT", shape.points), ("COARSE_EXTENT", shape.coarse), ("FOURS_EXTENT", shape.fours)];
    for (name, groups) in extents {
        let [x, y] = Shape::extent(groups);
        line(&mut text, format_args!("const {name} = vec2<u32>({x}u, {y}u);"));
    }
    let wider = Rung::WIDER.map(|step| format!("{step:e}")).join(", ");
    line(&mut text, format_args!("const WIDER = array<real, WIDER_STEPS>({wider});"));
    for names in [Word::NAMES, Halted::NAMES, Phase::NAMES, Ended::NAMES, Scalar::NAMES, Time::NAMES, Extent::NAMES] {
        for (number, name) in names.iter().enumerate() {
            line(&mut text, format_args!("const {name}: u32 = {number}u;"));
        }
    }
    text
}

fn line(text: &mut String, content: std::fmt::Arguments) {
    // Writing to a string cannot fail.
    let _ = writeln!(text, "{content}");
}
