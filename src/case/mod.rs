//! What a case file says: the scene, the method, the effects it asks for, and what it is expected to give.
//!
//! A case is nested TOML. Every table below is one `[table]` of the file, every field one key, and an unknown key
//! is an error. Lengths are in metres, times in seconds, velocities in m/s, pressures in Pa.

mod check;
pub(crate) mod decode;
mod defaults;
mod derived;
pub(crate) mod document;
pub(crate) mod error;
pub(crate) mod fault;
pub(crate) mod keys;
pub(crate) mod load;
mod moving;
mod obstacle;
mod reference;
pub(crate) mod text;
mod tracer;

pub use check::{LARGEST_CLOUD, LARGEST_RADIUS, LONGEST_FORWARD, MOST_STEPS, SMALLEST_RADIUS, WIDEST_LADDER};
pub use defaults::{DEFAULT_JITTER, DEFAULT_MINIMUM_DISTANCE, DEFAULT_RADIUS, DEFAULT_SEED, MOVING_COURANT};
pub use error::{CaseError, KeyError, KeyTrouble, Place};
pub use moving::{Fill, Initial, Motion, Sensor, Wave};
pub use obstacle::{Block, Capsule, Circle, Combine, Ellipse, Obstacle, Part, Refine, SIDES};
pub use reference::{Profile, ReferenceError};
pub use text::TextError;

use std::collections::BTreeMap;
use std::path::PathBuf;

use glam::DVec2;
use serde::{Deserialize, Serialize};

/// A whole case file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// One line that names the scene in pictures and summaries.
    pub title: String,
    pub domain: Domain,
    pub cloud: Cloud,
    pub fluid: Fluid,
    #[serde(default)]
    pub boundaries: Boundaries,
    /// Bodies in the fluid.
    #[serde(default)]
    pub obstacles: Vec<Obstacle>,
    #[serde(default)]
    pub initial: Initial,
    #[serde(default)]
    pub method: Method,
    /// The physics of the scene: an effect whose table is absent adds no operation and no buffer.
    #[serde(default)]
    pub effects: Effects,
    #[serde(default)]
    pub time: Time,
    #[serde(default)]
    pub guard: Guard,
    /// A flow that is known: where the run begins, what its walls prescribe, and what it may be measured against.
    pub exact: Option<Exact>,
    /// In place of a flow: derivatives of a known field, once.
    pub derivatives: Option<KnownField>,
    /// In place of a flow: the pressure equation with the source of a known field, once.
    pub poisson: Option<KnownField>,
    #[serde(default)]
    pub output: Output,
    /// Published values that the run is held to, by name.
    #[serde(default)]
    pub expect: BTreeMap<String, Expectation>,
}

/// The rectangle `[0, width] x [0, height]`, m.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Domain {
    pub width: f64,
    pub height: f64,
    #[serde(default)]
    pub periodic: Axes,
}

/// The axes along which the domain repeats: what leaves one side comes in at the other.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Axes {
    #[default]
    None,
    X,
    Y,
    Both,
}

impl Axes {
    /// Whether x and y are among them.
    pub fn each(self) -> [bool; 2] {
        [matches!(self, Axes::X | Axes::Both), matches!(self, Axes::Y | Axes::Both)]
    }
}

impl Domain {
    /// The lengths after which the domain repeats along x and y, m; 0 along an axis that ends at walls.
    pub fn period(&self) -> DVec2 {
        let [x, y] = self.periodic.each();
        DVec2::new(if x { self.width } else { 0.0 }, if y { self.height } else { 0.0 })
    }
}

/// How the points are laid out.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cloud {
    pub arrangement: Arrangement,
    /// Mean distance of neighbouring points, `l0`, m.
    pub spacing: f64,
    /// `jittered` alone: largest displacement along each axis, in spacings, below 0.5; [`DEFAULT_JITTER`] where absent.
    pub jitter: Option<f64>,
    /// `random` alone: least distance of two points, in spacings, up to 0.75; [`DEFAULT_MINIMUM_DISTANCE`] where absent.
    pub minimum_distance: Option<f64>,
    /// All but `regular`: the same seed gives the same points; [`DEFAULT_SEED`] where absent.
    pub seed: Option<u64>,
    /// Points that move alone: the part of the domain that holds fluid at the start.
    pub fill: Option<Fill>,
    /// `relaxed` alone: where the points lie closer.
    #[serde(default)]
    pub refine: Vec<Refine>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Arrangement {
    /// A square lattice.
    Regular,
    /// A square lattice, every interior point displaced at random.
    Jittered,
    /// Random points with a minimum distance and the lattice's mean density.
    Random,
    /// Random points moved apart until they lie evenly; the arrangement whose spacing may vary.
    Relaxed,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fluid {
    /// kg/m^3
    pub density: f64,
}

/// The four sides of the rectangle.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Boundaries {
    pub left: Wall,
    pub right: Wall,
    pub bottom: Wall,
    pub top: Wall,
}

impl Boundaries {
    /// The sides by name.
    pub fn each(&self) -> [(&'static str, &Wall); 4] {
        let Self { left, right, bottom, top } = self;
        [("left", left), ("right", right), ("bottom", bottom), ("top", top)]
    }
}

/// One side: a solid wall that moves along itself unless its kind says otherwise.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Wall {
    pub kind: SideKind,
    /// Velocity of the wall, m/s, tangent to it; or that of the fluid that comes in, the largest of a parabola.
    pub velocity: [f64; 2],
    /// How the velocity goes along the side.
    pub profile: SideProfile,
    /// Temperature that is held there, K; a side that says nothing of heat lets none through.
    pub temperature: Option<f64>,
    /// Heat that flows in, over density and heat capacity, K m/s.
    pub heat_flux: Option<f64>,
}

/// What a side does to the velocity and to the pressure.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SideKind {
    /// The fluid has its velocity.
    #[default]
    Wall,
    /// Nothing passes, and nothing drags: a plane of symmetry.
    Slip,
    /// Fluid comes in with its velocity.
    Inlet,
    /// Fluid leaves as it comes, at pressure 0.
    Outlet,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SideProfile {
    #[default]
    Uniform,
    /// `4 s (1 - s)` times the velocity, `s` from 0 to 1 along the side.
    Parabola,
}

/// How derivatives become sums over neighbours.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Method {
    pub operators: Operators,
    /// Degree of the polynomial that is fitted, 1 to 4; with 1 there are no second derivatives.
    pub order: usize,
    /// Radius of the neighbourhood, `r_e`, in spacings; where absent one that supports the order.
    pub radius: Option<f64>,
    pub weight: Weight,
}

impl Default for Method {
    fn default() -> Self {
        Self { operators: Operators::Interpolation, order: 2, radius: None, weight: Weight::Smooth }
    }
}

/// The two families of the paper's section 2.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Operators {
    /// Least-squares fits, (2.5) and (2.6).
    Interpolation,
    /// Weighted means, (2.2) to (2.4): right on lattices alone.
    Integral,
}

/// Weight of a neighbour at distance `r` in the least squares.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Weight {
    /// 1: the paper's.
    None,
    /// `(1 - r/r_e)^2`.
    Quadratic,
    /// `(1 - (r/r_e)^2)^4`: no square root, and nearer neighbours count for more.
    Smooth,
}

/// The physics of a scene; a table that is absent costs nothing.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Effects {
    pub viscosity: Option<Viscosity>,
    pub pressure: Option<Pressure>,
    pub advection: Option<Advection>,
    pub gravity: Option<Gravity>,
    pub drag: Option<Drag>,
    pub heat: Option<Heat>,
    pub buoyancy: Option<Buoyancy>,
    #[serde(default)]
    pub tracers: Vec<Tracer>,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Viscosity {
    /// Kinematic viscosity, m^2/s.
    pub kinematic: f64,
    #[serde(default)]
    pub scheme: Scheme,
    /// `implicit` alone: what its solve leaves of a velocity, as a way in a step over the spacing (rms over the points).
    pub tolerance: Option<f64>,
}

/// When in a step the viscous force is taken.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Scheme {
    /// Of velocities at hand: steps have a limit.
    #[default]
    Explicit,
    /// Of the velocity that is looked for: a solve in every step, and no limit.
    Implicit,
}

/// Incompressibility: `div u = 0`, held by the pressure.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Pressure {
    /// `conservative` on points that stand; on points that move `collocated` with fits, `integral` with weighted means.
    pub form: Option<PressureForm>,
    /// `conservative` alone; `faces` where absent.
    pub divergence: Option<Divergence>,
    /// `conservative`: `fit` where absent, or `adjoint`; `integral`: `least` where absent, or `corrected`.
    pub gradient: Option<Gradient>,
    /// `conjugate_gradient` for the conservative form and `bicgstab` for the collocated one where absent.
    pub solver: Option<Solver>,
    /// Of the iterative solvers: `multigrid` where absent, `jacobi` of BiCGStab on points that stand.
    pub preconditioner: Option<Preconditioner>,
    /// Volume change left in a step, `|div u| dt` (rms over the points); the solver stops there.
    pub tolerance: Option<f64>,
    pub max_iterations: u32,
    /// Points that move: the share of an error in density that a step takes out.
    pub relaxation: Option<f64>,
}

impl Default for Pressure {
    fn default() -> Self {
        Self {
            form: None,
            divergence: None,
            gradient: None,
            solver: None,
            preconditioner: None,
            tolerance: None,
            max_iterations: 2000,
            relaxation: None,
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PressureForm {
    /// Fluxes through Voronoi faces: symmetric, compatible.
    Conservative,
    /// The paper's: the fitted Laplacian inside, the fitted normal derivative at walls; not symmetric.
    Collocated,
    /// MPS's: the Laplacian of weighted means, the source from the number density; symmetric.
    Integral,
}

/// How the volume flux through the faces of the cells is formed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Divergence {
    /// From the mean of a face's two points: exact for the middle between them, of which the face's own lies beside on
    /// scattered points.
    Faces,
    /// From a quadratic fitted on every face: second order on scattered points.
    Fit,
}

/// How the pressure gradient of the correction is formed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Gradient {
    /// The least-squares fit's.
    Fit,
    /// Minus the adjoint of the divergence: the pressure step never adds kinetic energy.
    Adjoint,
    /// MPS: the weighted mean, over the least pressure around a point.
    Least,
    /// The same, put right by the moments of the neighbours that a point has.
    Corrected,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Solver {
    /// Symmetric matrices alone.
    ConjugateGradient,
    /// With the rank-one shift.
    Bicgstab,
    /// Sparse factorisation, made once.
    Direct,
}

/// What an iterative solver divides a residual by.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Preconditioner {
    /// The matrix's diagonal.
    Jacobi,
    /// That, and a coarse pressure beside it: a cycle of aggregation multigrid.
    Multigrid,
}

/// The material derivative: the points move with the flow and the fields are carried back.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Advection {
    pub motion: Motion,
    /// `fixed` alone.
    pub remap: Remap,
}

#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Remap {
    /// Evaluate the fit of the point nearest to where the fluid came from.
    #[default]
    Departure,
    /// The paper's: fit at the moved points, evaluate each fit at its point's old place.
    Forward,
}

/// A force that is the same everywhere.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Gravity {
    /// m/s^2
    pub acceleration: [f64; 2],
}

/// A porous body that the fluid passes through: everywhere, or in a circle or a polygon.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Drag {
    /// Darcy's permeability, m^2.
    pub permeability: f64,
    /// Forchheimer's coefficient, 1/m.
    #[serde(default)]
    pub inertia: f64,
    pub circle: Option<Circle>,
    /// Corners in order, either way round, m.
    pub polygon: Option<Vec<[f64; 2]>>,
}

/// A temperature that the flow carries and that conducts.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Heat {
    /// m^2/s
    pub diffusivity: f64,
    /// Temperature that the run begins with, K.
    #[serde(default)]
    pub initial: f64,
}

/// The force of Boussinesq: warm fluid is lighter, and the difference counts for nothing but its weight.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Buoyancy {
    /// Relative expansion, 1/K.
    pub expansion: f64,
    /// Temperature at which the density is `fluid.density`, K.
    #[serde(default)]
    pub reference: f64,
}

/// Something that the flow carries and that does not change it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tracer {
    /// What its column and its picture are called.
    pub name: String,
    /// m^2/s
    #[serde(default)]
    pub diffusivity: f64,
    /// What the run begins with; 1 at most.
    pub shape: Shape,
    /// m
    pub centre: [f64; 2],
    /// `gaussian` and `disc`: m.
    pub radius: Option<f64>,
    /// `box`: width and height, m.
    pub size: Option<[f64; 2]>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Shape {
    /// `exp(-r^2 / radius^2)`, `r` the distance from the centre.
    Gaussian,
    /// 1 within the radius, else 0.
    Disc,
    /// 1 within half the size of the centre along x and y, else 0.
    Box,
}

/// A field whose value and derivatives are known everywhere.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KnownField {
    pub field: Field,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Field {
    /// `sin(2 pi x / width) cos(2 pi y / height)`: periodic.
    Waves,
    /// `cos(pi x / width) cos(pi y / height)`: no slope across the walls.
    Cosines,
}

/// What a case computes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Problem {
    /// A flow in time.
    Flow,
    /// Derivatives of a known field.
    Derivatives(Field),
    /// The pressure that a known field is.
    Poisson(Field),
}

impl Case {
    pub fn problem(&self) -> Problem {
        match (&self.derivatives, &self.poisson) {
            (Some(known), _) => Problem::Derivatives(known.field),
            (None, Some(known)) => Problem::Poisson(known.field),
            (None, None) => Problem::Flow,
        }
    }
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Time {
    /// s
    pub end: f64,
    /// Largest distance a point moves in one step, in spacings.
    pub courant: Option<f64>,
    /// A fixed step, s, in place of one chosen from `courant` and the viscous limit.
    pub step: Option<f64>,
    /// Stop when no velocity changes faster than this, m/s^2.
    pub steady: Option<f64>,
    #[serde(default)]
    pub splitting: Splitting,
}

/// How advection and forces follow each other in time.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Splitting {
    /// Forces of half a step, projection, and the same half step again (Zehnder, Narain and Thomaszewski 2018): second
    /// order, and a steady state that depends on dt as dt^2.
    #[default]
    Reflection,
    /// The paper's: forces of a whole step, then projection; first order.
    Projection,
}

/// What a run that goes wrong does.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Guard {
    /// Times that it goes back to its last good state and on with half the step, before it gives up.
    pub retries: u32,
    /// Kinetic energy that counts as wrong, over that of the whole domain moving as fast as its walls, or its fluid at first.
    pub energy: f64,
}

impl Default for Guard {
    fn default() -> Self {
        Self { retries: 3, energy: 10.0 }
    }
}

/// A flow whose velocity and pressure are known at every place and time.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Exact {
    pub solution: Solution,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Solution {
    /// Decaying vortices in a periodic box.
    TaylorGreen,
    /// The steady flow behind a row of cylinders, through a box.
    Kovasznay,
    /// A velocity that is prescribed and stays: one turn a second about the middle of the domain.
    Rotation,
    /// The flow between two plates of which one begins to move.
    Couette,
    /// The flow between two plates along which gravity begins to act.
    Poiseuille,
    /// Heat between two sides that are held at their temperatures from the beginning on.
    Conduction,
}

/// No time: of a problem without.
impl Default for Time {
    fn default() -> Self {
        Self { end: 0.0, courant: None, step: None, steady: None, splitting: Splitting::default() }
    }
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Output {
    /// Steps between two rows of diagnostics.
    pub report_every: u32,
    /// Draw the pictures: pressure.png, speed.png and centreline.png of a flow.
    pub pictures: bool,
    /// Points that move: time between two frames that are kept, s.
    pub frame_every: Option<f64>,
    /// Points that move: places where the pressure is recorded, by name.
    pub sensors: BTreeMap<String, Sensor>,
}

impl Default for Output {
    fn default() -> Self {
        Self { report_every: 50, pictures: true, frame_every: None, sensors: BTreeMap::new() }
    }
}

/// One published value, or a published profile, along a line through the domain; or the error against the exact solution.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Expectation {
    /// `minimum`, `maximum`, `profile` and `error`: what is looked at.
    pub component: Option<Component>,
    /// `minimum`, `maximum` and `profile`: the line that is looked along.
    pub line: Option<Line>,
    pub measure: Measure,
    /// All but `profile` and `error`: the published value, m/s, Pa, N/m or m^2/s.
    pub value: Option<f64>,
    /// `profile`: a CSV file, `#` comments, a header, then the coordinate along the line and values. The case file
    /// gives its path from its own folder; [`Case::load`] leaves it as seen from the working directory.
    pub profile: Option<PathBuf>,
    /// `profile`: the column of values; the first after the coordinate where absent.
    pub column: Option<String>,
    /// `sensor` and `noise`: one of `output.sensors`.
    pub sensor: Option<String>,
    /// `front`: what the profile's values are measured in, m.
    pub length: Option<f64>,
    /// `front`: what the profile's times are measured in, s.
    pub duration: Option<f64>,
    /// `front`: added to the run's time, in units of `duration`; 0 where absent.
    pub delay: Option<f64>,
    /// `front`, `sensor`, `noise`, `area`, `energy` and `period`: what comes before is left out, s; 0 where absent.
    pub after: Option<f64>,
    /// `force`: the name of an obstacle; `flux`: that or a side.
    pub on: Option<String>,
    /// `difference`: the value at the first place less that at the second, m.
    pub between: Option<[[f64; 2]; 2]>,
    /// Largest relative error (extremes), rms error over the profile's largest magnitude (profiles), or rms error over the rms
    /// of the exact field (errors).
    pub tolerance: f64,
    /// `loss` and `error` of the component `tracer`: which one, by its name.
    pub tracer: Option<String>,
    /// `slope`: the side across which it is taken.
    pub side: Option<SideName>,
    /// Where the value was published.
    pub source: String,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Component {
    /// Velocity along x, m/s.
    U,
    /// Velocity along y, m/s.
    V,
    /// Pressure, Pa, relative to its value at the middle of the line, or to its mean over the points (errors).
    P,
    /// Both components of the velocity, m/s: `error` alone.
    Velocity,
    /// K
    Temperature,
    /// No unit: `error` and `loss` alone.
    Tracer,
    /// The gradient of a known field, 1/m: `error` alone.
    Gradient,
    /// Its Laplacian, 1/m^2: `error` alone.
    Laplacian,
    /// Along x, N/m: `force` alone.
    X,
    /// Along y, N/m: `force` alone.
    Y,
}

/// `{ x = 0.5 }`, the vertical line there, or `{ y = 0.5 }`, the horizontal one; m.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "snake_case")]
pub enum Line {
    X(f64),
    Y(f64),
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Measure {
    Minimum,
    Maximum,
    /// Root mean square difference from a published profile.
    Profile,
    /// Root mean square difference from the exact solution over all points, at the end of the run.
    Error,
    /// Of the fluid on an obstacle, per metre of depth.
    Force,
    /// Between two places.
    Difference,
    /// Volume flux out of the fluid through a side or an outline, per metre of depth.
    Flux,
    /// The mean slope of the temperature across a side, into the domain, K/m.
    Slope,
    /// What has been lost of a tracer since the beginning, over what there was; of the velocity, what comes in and does not go out, over
    /// what comes in.
    Loss,
    /// Points that move: largest relative difference of how far the fluid reaches from a published course in time.
    Front,
    /// Points that move: mean pressure at a sensor.
    Sensor,
    /// Points that move: root mean square of the pressure at a sensor about its mean, over that mean.
    Noise,
    /// Points that move: largest change of the area that the fluid covers, over that at the start.
    Area,
    /// Points that move: largest change of the kinetic and potential energy, over that at the start.
    Energy,
    /// Points that move: the time from one rise of the fluid beside the left wall through its mean height to the next.
    Period,
}

/// A side of the rectangle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SideName {
    Left,
    Right,
    Bottom,
    Top,
}

impl Measure {
    /// True of what is measured over the whole of a run of points that move.
    pub fn of_motion(self) -> bool {
        use Measure::{Area, Energy, Front, Noise, Period, Sensor};
        matches!(self, Front | Sensor | Noise | Area | Energy | Period)
    }

    /// The word of a case file.
    pub fn word(self) -> &'static str {
        match self {
            Measure::Minimum => "minimum",
            Measure::Maximum => "maximum",
            Measure::Profile => "profile",
            Measure::Error => "error",
            Measure::Force => "force",
            Measure::Difference => "difference",
            Measure::Flux => "flux",
            Measure::Slope => "slope",
            Measure::Loss => "loss",
            Measure::Front => "front",
            Measure::Sensor => "sensor",
            Measure::Noise => "noise",
            Measure::Area => "area",
            Measure::Energy => "energy",
            Measure::Period => "period",
        }
    }
}
