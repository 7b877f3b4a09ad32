//! What the engines store: every array by name, with its unit, its shape, and what it takes per point.

use serde::Serialize;

use super::coarse::ENTRIES;
use super::{BLOCK, Carried, Sizes};
use crate::cpu::operations::moments::entries;

/// Which places of the points an array or an operation belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
pub enum Points {
    /// Where the points stand: their initial places. Computed once.
    Standing,
    /// Where the flow has moved them within this step: the paper's forward remap alone.
    Moved,
}

/// One array in an engine's memory.
///
/// "Interleaved" holds x and y of one point side by side. "Blocked" holds `k` numbers a point, in blocks of
/// [`BLOCK`] points, number by number: entry `n` of point `i` stands at `(i / BLOCK) BLOCK k + n BLOCK + i % BLOCK`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
pub enum Buffer {
    /// Places, m; interleaved.
    Position(Points),
    /// Where each cell's points begin in `CellPoints`; one more entry than cells.
    CellStart(Points),
    /// The points, cell by cell, ascending within a cell.
    CellPoints(Points),
    /// Neighbours of each point, blocked, `capacity` slots; unused slots hold the point itself.
    Neighbours(Points),
    /// Slots of `Neighbours` in use.
    NeighbourCount(Points),
    /// Radius of each point's neighbourhood, m: `r_e`, or wider where the fit needed more points.
    Support(Points),
    /// Cholesky factor of each point's normal matrix, 15 numbers for the 5x5 one of order 2, blocked.
    Factor(Points),
    /// How far down the ladder each point's fit stands: see [`super::Rung`].
    Rung(Points),
    /// Volume of each point's cell, m^2.
    Volume,
    /// Points across the faces of each Voronoi cell, blocked, `face_capacity` slots; unused slots hold the point itself.
    FaceNeighbours,
    /// `w_ij = A_ij / |d_ij|` of those faces, no unit, blocked; zero in unused slots.
    FaceWeight,
    /// Slots of `FaceNeighbours` in use.
    FaceCount,
    /// Points whose velocities make up the volume flux out of every cell, blocked, `flux_capacity` slots; unused slots hold the
    /// point itself.
    FluxPoints,
    /// What each is multiplied by, m, blocked: of u, then of v, `2 flux_capacity` slots; zero in unused ones.
    FluxRow,
    /// Slots of `FluxPoints` in use.
    FluxCount,
    /// Volume flux out of every cell through the walls that it has a piece of, m^2/s. Through-flow alone.
    WallFlux,
    /// Points whose velocities make up that of a boundary point which follows the fluid, blocked, `open_capacity` slots; unused slots
    /// hold the point itself. Slip sides and outlets alone.
    OpenPoints,
    /// Their shares, no unit, blocked; zero in unused slots.
    OpenRow,
    /// Slots of `OpenPoints` in use: none at any other point.
    OpenCount,
    /// What is taken out of that velocity: the normal of a slip side, else zero; interleaved.
    OpenNormal,
    /// 1 at points of outlets, 0 elsewhere. The collocated pressure alone.
    Outlet,
    /// Outward unit normal at boundary points, zero inside; interleaved.
    Normal,
    /// Laplacian as a sum: the factor of `phi_j - phi_i` for every neighbour slot, 1/m^2, blocked.
    LaplacianRow,
    /// Gradient as a sum: the same for the derivatives along x, then along y, 1/m; blocked, `2 capacity` slots.
    GradientRow,
    /// Collocated pressure matrix: the factor of `p_j - p_i` for every neighbour slot, 1/m^2, blocked.
    MatrixRow,
    /// Collocated pressure matrix: what each row was multiplied by, 1 inside, 1/m at the boundary, 0 at outlets.
    RowScale,
    /// Diagonal of the pressure matrix: no unit (conservative, `sum_j w_ij`) or 1/m^2 (collocated, `-sum_j a_ij`); 1 in padding.
    Diagonal,
    /// `u` after the points were carried back, before forces, m/s; interleaved.
    Velocity,
    /// Change of `u` by the forces of half a step (reflection) or a whole one (projection), m/s; interleaved.
    Kick,
    /// Divergence-free velocity: what is reported, m/s; interleaved. Within the step first `u*`.
    Projected,
    /// Velocity that moves the points, m/s; interleaved. Reflection and implicit viscosity.
    Reflected,
    /// Relaxed mean of the pressure's kicks, m/s; interleaved. Reflection and implicit viscosity.
    PressureKick,
    /// The scaled coefficients of the fit of u, five for order 2, then of v, m/s, blocked.
    Coefficients,
    /// A scalar field that the flow carries along, in its own unit.
    Carried(Carried),
    /// How fast its neighbours' values reach a point, `D / V_i`, 1/(m^2 s); 0 where the value is held.
    Reach(Carried),
    /// What the heat flux through the walls adds to the temperature of the cells there, K/s. Prescribed fluxes alone.
    HeatSupply,
    /// Where the fluid that arrives at each point came from, m; interleaved.
    Departure,
    /// The point nearest to there.
    DepartureNearest,
    /// The value of a carried field at every point, then the scaled coefficients of its fit, blocked; of one field after another.
    ScalarFit,
    /// A carried field in the middle of a step of its diffusion; of one field after another.
    ScalarMiddle,
    /// Pressure `p`, Pa.
    Pressure,
    /// Right side of the pressure equation.
    Source,
    /// What a porous body takes of a velocity, `nu / k`, 1/s; 0 where there is none. Drag alone.
    Resistance,
    /// The velocity in the middle of the kick, viscosity taken there, m/s; interleaved. Implicit viscosity alone, as the
    /// five below.
    Middle,
    /// Its solver's vectors, m^3/s, m/s and m^3/s; interleaved.
    ViscousResidual,
    ViscousDirection,
    ViscousProduct,
    /// Divergence that is to be taken off `Middle`, 1/s.
    Dilation,
    /// Relaxed mean of the pressures, Pa, whose kick is `PressureKick`.
    MeanPressure,
    /// Solver vectors.
    Residual,
    Direction,
    Product,
    /// BiCGStab alone.
    Shadow,
    Stabilised,
    StabilisedProduct,
    Preconditioned,
    /// `Projected` at the last report, m/s, to measure the rate of change from; interleaved.
    Reported,
    /// Number density over that of a full lattice, no unit. Points that move alone, as the two below.
    Crowding,
    /// 1 at free-surface points, 0 elsewhere.
    Surface,
    /// How far each point moves beside `dt u*`, m; interleaved.
    Displacement,
    /// In how many steps the pressure's push on each point was bounded, since the beginning. Shifted points alone.
    Bounded,
    /// The pressure equation over cells, or over aggregates of points that stand still. Which place each point's cell has; 0 where
    /// the pressure is held.
    CoarseCell,
    /// Rows of that over cells, number by number: of the nine cells around, then what a smoothing step multiplies with; ten times all places.
    CoarseMatrix,
    /// Where the parts of each aggregate begin in `AggregateParts`; one more entry than places.
    AggregateStart,
    /// The parts: points, or places of smaller aggregates.
    AggregateParts,
    /// The place of the aggregate that each is part of; 0 of the largest.
    AggregateParent,
    /// Places of the aggregates that each is linked to, level by level, slot by slot.
    AggregateNeighbours,
    /// The matrix over aggregates, no unit: the diagonal at all places, what a smoothing step multiplies with, then these links.
    AggregateMatrix,
    /// A known field, no unit.
    Field,
    /// Its mean over neighbours, no unit; its gradient, 1/m, interleaved; its Laplacian, 1/m^2.
    FieldAverage,
    FieldGradient,
    FieldLaplacian,
}

/// What an array's entries are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub enum Element {
    /// The engine's float type.
    Real,
    /// `u32`.
    Index,
}

impl Buffer {
    /// Name in snake case, as WGSL and `plan` spell it.
    pub fn name(self) -> String {
        let (name, points) = match self {
            Buffer::Position(points) => ("position", Some(points)),
            Buffer::CellStart(points) => ("cell_start", Some(points)),
            Buffer::CellPoints(points) => ("cell_points", Some(points)),
            Buffer::Neighbours(points) => ("neighbours", Some(points)),
            Buffer::NeighbourCount(points) => ("neighbour_count", Some(points)),
            Buffer::Support(points) => ("support", Some(points)),
            Buffer::Factor(points) => ("factor", Some(points)),
            Buffer::Rung(points) => ("rung", Some(points)),
            Buffer::Volume => ("volume", None),
            Buffer::FaceNeighbours => ("face_neighbours", None),
            Buffer::FaceWeight => ("face_weight", None),
            Buffer::FaceCount => ("face_count", None),
            Buffer::FluxPoints => ("flux_points", None),
            Buffer::FluxRow => ("flux_row", None),
            Buffer::FluxCount => ("flux_count", None),
            Buffer::WallFlux => ("wall_flux", None),
            Buffer::OpenPoints => ("open_points", None),
            Buffer::OpenRow => ("open_row", None),
            Buffer::OpenCount => ("open_count", None),
            Buffer::OpenNormal => ("open_normal", None),
            Buffer::Outlet => ("outlet", None),
            Buffer::Normal => ("normal", None),
            Buffer::LaplacianRow => ("laplacian_row", None),
            Buffer::GradientRow => ("gradient_row", None),
            Buffer::MatrixRow => ("matrix_row", None),
            Buffer::RowScale => ("row_scale", None),
            Buffer::Diagonal => ("diagonal", None),
            Buffer::Velocity => ("velocity", None),
            Buffer::Kick => ("kick", None),
            Buffer::Projected => ("projected", None),
            Buffer::Reflected => ("reflected", None),
            Buffer::PressureKick => ("pressure_kick", None),
            Buffer::Coefficients => ("coefficients", None),
            Buffer::Carried(carried) => return carried.name(),
            Buffer::Reach(carried) => return format!("{}_reach", carried.name()),
            Buffer::HeatSupply => ("heat_supply", None),
            Buffer::Departure => ("departure", None),
            Buffer::DepartureNearest => ("departure_nearest", None),
            Buffer::ScalarFit => ("scalar_fit", None),
            Buffer::ScalarMiddle => ("scalar_middle", None),
            Buffer::Pressure => ("pressure", None),
            Buffer::Source => ("source", None),
            Buffer::Resistance => ("resistance", None),
            Buffer::Middle => ("middle", None),
            Buffer::ViscousResidual => ("viscous_residual", None),
            Buffer::ViscousDirection => ("viscous_direction", None),
            Buffer::ViscousProduct => ("viscous_product", None),
            Buffer::Dilation => ("dilation", None),
            Buffer::MeanPressure => ("mean_pressure", None),
            Buffer::Residual => ("residual", None),
            Buffer::Direction => ("direction", None),
            Buffer::Product => ("product", None),
            Buffer::Shadow => ("shadow", None),
            Buffer::Stabilised => ("stabilised", None),
            Buffer::StabilisedProduct => ("stabilised_product", None),
            Buffer::Preconditioned => ("preconditioned", None),
            Buffer::Reported => ("reported", None),
            Buffer::Crowding => ("crowding", None),
            Buffer::Surface => ("surface", None),
            Buffer::Displacement => ("displacement", None),
            Buffer::Bounded => ("bounded", None),
            Buffer::CoarseCell => ("coarse_cell", None),
            Buffer::CoarseMatrix => ("coarse_matrix", None),
            Buffer::AggregateStart => ("aggregate_start", None),
            Buffer::AggregateParts => ("aggregate_parts", None),
            Buffer::AggregateParent => ("aggregate_parent", None),
            Buffer::AggregateNeighbours => ("aggregate_neighbours", None),
            Buffer::AggregateMatrix => ("aggregate_matrix", None),
            Buffer::Field => ("field", None),
            Buffer::FieldAverage => ("field_average", None),
            Buffer::FieldGradient => ("field_gradient", None),
            Buffer::FieldLaplacian => ("field_laplacian", None),
        };
        match points {
            Some(Points::Moved) => format!("moved_{name}"),
            _ => name.to_owned(),
        }
    }

    pub fn element(self) -> Element {
        match self {
            Buffer::CellStart(_)
            | Buffer::CellPoints(_)
            | Buffer::Neighbours(_)
            | Buffer::NeighbourCount(_)
            | Buffer::Rung(_)
            | Buffer::FaceNeighbours
            | Buffer::FaceCount
            | Buffer::FluxPoints
            | Buffer::FluxCount
            | Buffer::Surface
            | Buffer::Bounded
            | Buffer::CoarseCell
            | Buffer::AggregateStart
            | Buffer::AggregateParts
            | Buffer::AggregateParent
            | Buffer::AggregateNeighbours
            | Buffer::OpenPoints
            | Buffer::OpenCount
            | Buffer::Outlet
            | Buffer::DepartureNearest => Element::Index,
            _ => Element::Real,
        }
    }

    /// Numbers a point; `None` for what has one a cell, or more.
    pub fn per_point(self, sizes: &Sizes) -> Option<usize> {
        Some(match self {
            Buffer::CellStart(_)
            | Buffer::CoarseMatrix
            | Buffer::AggregateStart
            | Buffer::AggregateParts
            | Buffer::AggregateParent
            | Buffer::AggregateNeighbours
            | Buffer::AggregateMatrix => return None,
            Buffer::Position(_)
            | Buffer::Normal
            | Buffer::Velocity
            | Buffer::Kick
            | Buffer::Projected
            | Buffer::Reflected
            | Buffer::PressureKick
            | Buffer::Middle
            | Buffer::ViscousResidual
            | Buffer::ViscousDirection
            | Buffer::ViscousProduct
            | Buffer::Reported
            | Buffer::Displacement
            | Buffer::Departure
            | Buffer::OpenNormal
            | Buffer::FieldGradient => 2,
            Buffer::Neighbours(_) | Buffer::LaplacianRow | Buffer::MatrixRow => sizes.capacity,
            Buffer::GradientRow => 2 * sizes.capacity,
            Buffer::FaceNeighbours | Buffer::FaceWeight => sizes.face_capacity,
            Buffer::OpenPoints | Buffer::OpenRow => sizes.open_capacity,
            Buffer::FluxPoints => sizes.flux_capacity,
            Buffer::FluxRow => 2 * sizes.flux_capacity,
            Buffer::Factor(_) => entries(sizes.coefficients),
            Buffer::Coefficients => 2 * sizes.coefficients,
            Buffer::ScalarFit => 1 + sizes.coefficients,
            _ => 1,
        })
    }

    /// Entries of the array: whole blocks of points, one a cell and one more, or so many a place of the coarse pressure and a link
    /// of its aggregates.
    pub fn length(self, sizes: &Sizes) -> usize {
        match (self.per_point(sizes), self) {
            (Some(count), _) => sizes.points.div_ceil(BLOCK) * BLOCK * count,
            (None, Buffer::CoarseMatrix) => ENTRIES * sizes.coarse,
            (None, Buffer::AggregateStart) => sizes.coarse + 1,
            (None, Buffer::AggregateParts) => sizes.parts,
            (None, Buffer::AggregateParent) => sizes.coarse,
            (None, Buffer::AggregateNeighbours) => sizes.links,
            (None, Buffer::AggregateMatrix) => 2 * sizes.coarse + sizes.links,
            (None, _) => sizes.cells + 1,
        }
    }
}
