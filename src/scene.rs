//! A case made ready to run: its points, its geometry, its plan, and the numbers that every operation shares.

mod aggregates;
mod carried;
mod drag;
mod sides;

use glam::DVec2;
use rayon::prelude::*;

pub use aggregates::Aggregates;

use crate::case::{Case, PressureForm, Problem, SideKind, Solver, Splitting, Wall, Weight};
use crate::cloud::flux::Fluxes;
use crate::cloud::voronoi::{Boundary, Cells};
use crate::cloud::{Cloud, CloudError, OpenPoint, Side, first_apart, grid, open_points, shortest};
use crate::cpu::blocks;
use crate::cpu::operations::bicgstab::Shift;
use crate::cpu::operations::integral::{self, Lattice};
use crate::cpu::operations::moments;
use crate::cpu::operations::moving::{collide, surface};
use crate::cpu::operations::pressure::Stop;
use crate::engine::{Clock, Data};
use crate::exact::Exact;
use crate::known::Known;
use crate::step::{BLOCK, Buffer, Element, Grid, Operation, Plan, Points, Sizes, coarse};

/// Everything about a run that does not change while it runs, in f64, on the host.
#[derive(Debug, Clone)]
pub struct Scene {
    pub case: Case,
    pub cloud: Cloud,
    pub plan: Plan,
    pub sizes: Sizes,
    pub constants: Constants,
    /// The flow that the case knows.
    exact: Option<Exact>,
    /// Voronoi cells, where the plan has faces.
    cells: Option<Cells>,
    /// The flux out of them, where the plan fits it.
    fluxes: Option<Fluxes>,
    /// Aggregates of points, where the plan has a coarse pressure over them.
    aggregates: Option<Aggregates>,
    /// Groups of points out of each other's sight; 1 where all hang together.
    pub groups: usize,
    /// The points of slip sides and outlets.
    open: Vec<OpenPoint>,
}

/// Numbers that both engines use; each stands here alone and reaches WGSL from here.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constants {
    /// `r_e`, m; the largest where the spacing varies.
    pub radius: f64,
    pub weight: Weight,
    /// Degree of the fitted polynomial, 1 to 4.
    pub order: usize,
    /// Cells of the neighbour search.
    pub grid: Grid,
    /// Width and height of the rectangle, m.
    pub size: DVec2,
    /// Lengths after which it repeats along x and y, m; 0 along an axis that ends at walls.
    pub period: DVec2,
    /// `l0`, m.
    pub spacing: f64,
    /// What the integral form divides by.
    pub lattice: Lattice,
    /// The same sum of the weight that fits measure density with, `(1 - (r/r_e)^2)^2`.
    pub crowd: f64,
    /// Fewest neighbours of a point inside a fluid that moves.
    pub fewest: u32,
    /// Share of an error in density that a step takes out, on points that move.
    pub relaxation: f64,
    /// kg/m^3
    pub density: f64,
    /// Kinematic viscosity, m^2/s; 0 without viscosity.
    pub viscosity: f64,
    /// Forchheimer's coefficient over Darcy's, `F k / nu`, s/m; 0 without drag.
    pub drag_inertia: f64,
    /// Where on the way back to a departure point the velocity is taken, over the step.
    pub trace: f64,
    /// m/s^2; 0 without gravity.
    pub gravity: DVec2,
    /// What a degree above the reference adds to it, `-beta g`, m/(s^2 K); 0 without buoyancy.
    pub lift: DVec2,
    /// K
    pub reference_temperature: f64,
    /// Largest stable step of the diffusion of the carried fields, s.
    pub diffusion_limit: f64,
    /// Volume change left in a step, `|div u| dt`, at which a pressure solve is done.
    pub tolerance: f64,
    pub max_iterations: u32,
    /// What the solve of implicit viscosity leaves in a step of its velocities, as a way, m.
    pub viscous_tolerance: f64,
    /// Rounding units of the diagonal's product below which no pressure residual falls.
    pub floor: f64,
    /// Whether the pressure is found but for a constant: not where fluid leaves at pressure 0.
    pub singular: bool,
    /// The rank-one shift of a singular pressure matrix.
    pub shift: Shift,
}

/// Why a case cannot be made ready.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SceneError {
    #[error(transparent)]
    Cloud(#[from] CloudError),
    #[error(
        "method.radius = {radius}: point {point} at ({x}, {y}) m has {found} neighbours; allowed: a radius that gives every point {needed}"
    )]
    TooFewNeighbours { radius: f64, point: usize, x: f64, y: f64, found: usize, needed: usize },
    #[error(
        "effects.pressure.form = \"collocated\": the points fall into {groups} groups out of each other's sight, and point {point} \
         at ({x}, {y}) m is not of the first: nothing ties their pressures together; allowed: \"conservative\", or a larger \
         method.radius"
    )]
    Apart { groups: usize, point: usize, x: f64, y: f64 },
}

/// Two points nearer than this, in spacings, coincide: no derivative exists between them.
const COINCIDENT: f64 = 1e-8;

impl Scene {
    /// Lays out the points, measures their neighbourhoods, and plans the step.
    pub fn build(case: &Case) -> Result<Self, SceneError> {
        Self::with_cloud(case, Cloud::build(case)?)
    }

    /// The same on points laid out by the caller.
    pub fn with_cloud(case: &Case, cloud: Cloud) -> Result<Self, SceneError> {
        cloud.check()?;
        let plan = Plan::new(case);
        let radius = case.method.radius() * cloud.spacing;
        // Where the fluid ends a point may have few neighbours.
        let needed = if plan.moves() { 0 } else { moments::coefficients(case.method.order) };
        let (most, apart) = survey(&cloud, case.method.radius(), needed)?;
        if let (Some((point, groups)), Some(PressureForm::Collocated), false) = (apart, plan.form, plan.moves()) {
            let DVec2 { x, y } = cloud.position[point];
            return Err(SceneError::Apart { groups, point, x, y });
        }
        // Not many more cells than points, however far these lie apart.
        let room = (cloud.size.x * cloud.size.y / (4 * cloud.len() + 16) as f64).sqrt();
        let grid = Grid::new(cloud.size, cloud.period, cell(&cloud, case.method.radius()).max(room));
        let capacity = if plan.moves() {
            (2 * most).max(12)
        } else if plan.drift.contains(&Operation::MovePoints) {
            most + most / 3 + 2
        } else {
            most.max(12)
        };
        let conservative = plan.form == Some(PressureForm::Conservative);
        let cells = plan.has_faces().then(|| Cells::build(&cloud));
        let fits_faces = plan.kick.contains(&Operation::DivergenceByFit);
        let fluxes =
            cells.as_ref().filter(|_| fits_faces).map(|cells| Fluxes::build(&cloud, cells, case.method.radius()));
        let opens = plan.buffers().contains(&Buffer::OpenRow);
        let open = if opens { open_points(&cloud, &case.boundaries, case.method.radius()) } else { Vec::new() };
        let sizes = Sizes {
            points: cloud.len(),
            interior: cloud.interior,
            pressured: cloud.pressured,
            capacity,
            face_capacity: cells.as_ref().map_or(0, Cells::most_faces),
            flux_capacity: fluxes.as_ref().map_or(0, Fluxes::most_terms),
            open_capacity: open.iter().map(|open| open.row.len()).max().unwrap_or(0),
            cells: grid.count(),
            coefficients: moments::coefficients(case.method.order),
            coarse: if plan.coarsens_over_cells() { coarse::places(&grid) } else { 0 },
            parts: 0,
            links: 0,
        };
        let pressure = case.effects.pressure.clone().unwrap_or_default();
        let mut constants = Constants {
            radius,
            weight: case.method.weight,
            order: case.method.order,
            grid,
            size: cloud.size,
            period: cloud.period,
            spacing: cloud.spacing,
            lattice: Lattice::new(radius, cloud.spacing),
            crowd: integral::lattice_sum(radius, cloud.spacing, |_, square| (1.0 - square).powi(2)),
            fewest: (surface::FEW * integral::lattice_sum(radius, cloud.spacing, |_, _| 1.0)).round() as u32,
            relaxation: case.relaxation(),
            density: case.fluid.density,
            viscosity: case.effects.viscosity.as_ref().map_or(0.0, |viscosity| viscosity.kinematic),
            gravity: case.effects.gravity.as_ref().map_or(DVec2::ZERO, |gravity| gravity.acceleration.into()),
            drag_inertia: 0.0,
            trace: if case.velocity_changes() { 1.0 } else { 0.5 },
            lift: DVec2::ZERO,
            reference_temperature: 0.0,
            diffusion_limit: carried::limit(case, cells.as_ref()),
            tolerance: case.tolerance(),
            max_iterations: pressure.max_iterations,
            viscous_tolerance: case.viscous_tolerance() * cloud.spacing,
            floor: if conservative { Stop::CONSERVATIVE_FLOOR } else { Stop::COLLOCATED_FLOOR },
            singular: !plan.outlets && !plan.moves(),
            shift: match plan.outlets || plan.moves() {
                true => Shift { factor: 0.0, rows: 0 },
                false if conservative => Shift { factor: 4.0, rows: cloud.len() },
                // On walls the left null vector has both signs, which may make up for what it has inside.
                false => Shift { factor: -4.0 / cloud.spacing.powi(2), rows: cloud.interior },
            },
        };
        if let Some(buoyancy) = &case.effects.buoyancy {
            constants.lift = -buoyancy.expansion * constants.gravity;
            constants.reference_temperature = buoyancy.reference;
        }
        if let Some(drag) = &case.effects.drag {
            constants.drag_inertia = drag.inertia * drag.permeability / constants.viscosity;
        }
        let (exact, groups) = (Exact::of(case), apart.map_or(1, |(_, groups)| groups));
        let case = case.clone();
        let aggregates = None;
        let mut scene = Self { case, cloud, plan, sizes, constants, exact, cells, fluxes, aggregates, groups, open };
        if scene.plan.aggregates {
            scene.aggregates = Aggregates::build(&scene);
        }
        if let Some(aggregates) = &scene.aggregates {
            let sizes = &mut scene.sizes;
            [sizes.coarse, sizes.parts, sizes.links] = aggregates.sizes();
        }
        Ok(scene)
    }

    /// The Voronoi cells of the pressure; `None` unless its form is conservative.
    pub fn cells(&self) -> Option<&Cells> {
        self.cells.as_ref().filter(|_| self.plan.form == Some(PressureForm::Conservative))
    }

    /// The flux out of the cells; `None` unless the plan fits it.
    pub fn fluxes(&self) -> Option<&Fluxes> {
        self.fluxes.as_ref()
    }

    /// The aggregates of the coarse pressure of points that stand still; `None` without it.
    pub fn aggregates(&self) -> Option<&Aggregates> {
        self.aggregates.as_ref()
    }

    /// True of a point where fluid leaves at pressure 0.
    pub fn is_outlet(&self, point: usize) -> bool {
        let sides = point.checked_sub(self.cloud.interior).and_then(|point| self.cloud.sides.get(point));
        let leaves = |side: &Side| side.wall(&self.case.boundaries).kind == SideKind::Outlet;
        self.plan.outlets && sides.is_some_and(|sides| sides.iter().any(leaves))
    }

    /// The velocity at every point that a run begins with, m/s: the exact solution's, or rest between the walls.
    pub fn initial_velocity(&self) -> Vec<DVec2> {
        let cloud = &self.cloud;
        match &self.exact {
            Some(exact) => cloud.position.iter().map(|&place| exact.velocity(place, 0.0)).collect(),
            None if self.plan.moves() => {
                let rotation = self.case.initial.rotation;
                let middle = self
                    .case
                    .cloud
                    .fill
                    .as_ref()
                    .map_or(DVec2::ZERO, |fill| 0.5 * (DVec2::from(fill.from) + DVec2::from(fill.to)));
                let fluid = cloud.position[..cloud.interior].iter().map(|&place| rotation * (place - middle).perp());
                fluid.chain(std::iter::repeat_n(DVec2::ZERO, cloud.len() - cloud.interior)).collect()
            }
            None => {
                let rest = std::iter::repeat_n(DVec2::ZERO, cloud.interior);
                rest.chain(cloud.wall_velocity(&self.case.boundaries)).collect()
            }
        }
    }

    /// Kinetic energy of the whole domain moving as fast as the fastest wall, or as the fastest fluid at first, and as if it had
    /// fallen through the domain, m^4/s^2: walls that drag it along give it no more. `None` where nothing moves it, and where
    /// it may fall for ever, rise by its heat, or come in.
    pub fn energy_scale(&self) -> Option<f64> {
        let square = self.initial_velocity().iter().map(|velocity| velocity.length_squared()).fold(0.0, f64::max);
        let (gravity, size) = (self.constants.gravity, self.cloud.size);
        let square = square + 2.0 * (gravity.abs() * size).element_sum();
        let falls = self.balanced_gravity() != gravity;
        let driven = self.case.effects.buoyancy.is_some()
            || self.case.has_side(SideKind::Inlet)
            || self.case.has_side(SideKind::Outlet);
        // Points that move have a watch of their own.
        (square > 0.0 && !falls && !driven && !self.plan.moves()).then_some(0.5 * size.x * size.y * square)
    }

    /// The part of gravity that the pressure of a fluid at rest takes off, m/s^2: what the relaxed mean of the pressure's kicks
    /// begins with. Along an axis that has no walls, or ends at outlets on both sides, nothing does.
    pub fn balanced_gravity(&self) -> DVec2 {
        let sides = &self.case.boundaries;
        let held = |length: f64, ends: [&Wall; 2]| {
            let open = ends.iter().all(|side| side.kind == SideKind::Outlet);
            f64::from(u8::from(length == 0.0 && !open))
        };
        let period = self.constants.period;
        let [x, y] = [held(period.x, [&sides.left, &sides.right]), held(period.y, [&sides.bottom, &sides.top])];
        DVec2::new(x, y) * self.constants.gravity
    }

    /// Part of the mean pressure's kick that the source of the pressure sees after implicit viscosity, `1 / (1 + 8 h nu / l0^2)`;
    /// `h` in s.
    pub fn seen_share(&self, kick: f64) -> f64 {
        let area = self.cloud.size.x * self.cloud.size.y / self.sizes.points as f64;
        1.0 / (1.0 + 8.0 * kick * self.constants.viscosity / area)
    }

    /// What an error in density weighs in the source of the pressure, `relaxation rho / dt^2`, Pa/m^2.
    pub fn stiffness(&self, clock: &Clock) -> f64 {
        clock.share * self.constants.relaxation * self.constants.density / (clock.dt * clock.dt)
    }

    /// Distance below which points that approach each other bounce, m.
    pub fn bounce_distance(&self) -> f64 {
        let spacings = if self.plan.mirrors() { collide::SHIFTED_DISTANCE } else { collide::DISTANCE };
        spacings * self.constants.spacing
    }

    /// Lengths in time of a step of `dt` s.
    pub fn clock(&self, dt: f64) -> Clock {
        match self.plan.splitting {
            Splitting::Reflection => Clock { dt, kick: 0.5 * dt, second_kick: 1.0, share: 1.0 },
            Splitting::Projection => Clock { dt, kick: dt, second_kick: 0.0, share: 1.0 },
        }
    }

    /// True where a stalled iterative solve can be handed to the direct one.
    pub fn has_direct_fallback(&self) -> bool {
        self.case.effects.pressure.as_ref().is_some_and(|pressure| pressure.solver() != Solver::Direct)
    }

    /// What an engine's arrays hold before the setup operations run; an array not named holds zeros.
    pub fn initial(&self) -> Vec<(Buffer, Data)> {
        let cloud = &self.cloud;
        let velocity = self.initial_velocity();
        let mut normal = vec![DVec2::ZERO; cloud.interior];
        normal.extend_from_slice(&cloud.normal);
        let volume = self.cells.as_ref().map_or_else(|| cloud.nominal_volume(), |cells| cells.volume.clone());
        let last = cloud.position.last().copied().unwrap_or_default();
        let position = self.vectors(&cloud.position, last);
        let mut data = vec![
            (Buffer::Position(Points::Standing), position.clone()),
            (Buffer::Position(Points::Moved), position),
            (Buffer::Support(Points::Standing), self.scalars(&self.supports(), self.constants.radius)),
            (Buffer::Support(Points::Moved), Data::Real(vec![self.constants.radius; self.padded()])),
            (Buffer::Normal, self.vectors(&normal, DVec2::ZERO)),
            (Buffer::Volume, self.scalars(&volume, 1.0)),
        ];
        for buffer in [Buffer::Velocity, Buffer::Middle, Buffer::Projected, Buffer::Reflected, Buffer::Reported] {
            data.push((buffer, self.vectors(&velocity, DVec2::ZERO)));
        }
        if let Some(cells) = &self.cells {
            data.extend(self.faces(cells));
            data.extend(self.fluxes.iter().flat_map(|fluxes| self.flux_rows(fluxes)));
            if let (true, Some(exact)) = (self.plan.through_flow, &self.exact) {
                let flux = cells.wall_flux(&|piece| exact.velocity(piece.middle, 0.0));
                data.push((Buffer::WallFlux, self.scalars(&flux, 0.0)));
            }
            if self.exact.is_none() {
                data.push((Buffer::WallFlux, self.scalars(&sides::wall_flux(self, cells), 0.0)));
            }
        }
        // That of a fluid at rest: where the mean pressure begins.
        let weight = self.constants.density * self.balanced_gravity();
        let hydrostatic: Vec<f64> = cloud.position.iter().map(|place| weight.dot(*place)).collect();
        data.push((Buffer::MeanPressure, self.scalars(&hydrostatic, 0.0)));
        data.extend(self.aggregates.iter().flat_map(|aggregates| aggregates.arrays(self.padded())));
        data.extend(drag::resistance(self));
        data.extend(carried::initial(self, &volume));
        data.extend(sides::rows(self, &self.open));
        data.push(sides::outlets(self));
        data.extend(self.known(&volume));
        let used = self.plan.buffers();
        data.retain(|(buffer, _)| used.contains(buffer));
        data
    }

    /// Radius of each point's neighbourhood, m.
    fn supports(&self) -> Vec<f64> {
        let spacings = self.case.method.radius();
        (0..self.cloud.len()).map(|point| spacings * self.cloud.spacing_at(point)).collect()
    }

    /// A known field, or the source that makes the pressure equation give it.
    fn known(&self, volume: &[f64]) -> Option<(Buffer, Data)> {
        let (known, cloud) = (Known::of(&self.case)?, &self.cloud);
        if !matches!(self.case.problem(), Problem::Poisson(_)) {
            let values: Vec<f64> = cloud.position.iter().map(|&place| known.value(place)).collect();
            return Some((Buffer::Field, self.scalars(&values, 0.0)));
        }
        // No slope across the sides: nothing stands in their rows.
        let source = |point: usize| match self.cells {
            Some(_) => -volume[point] * known.laplacian(cloud.position[point]),
            None if point < cloud.interior => known.laplacian(cloud.position[point]),
            None => 0.0,
        };
        let mut source: Vec<f64> = (0..cloud.len()).map(source).collect();
        // Outlines stand at a slope.
        for piece in self.cells.iter().flat_map(|cells| &cells.walls) {
            if matches!(piece.of, Boundary::Obstacle(_)) {
                source[piece.point] += known.gradient(piece.middle).dot(piece.area);
            }
        }
        Some((Buffer::Source, self.scalars(&source, 0.0)))
    }

    fn faces(&self, cells: &Cells) -> Vec<(Buffer, Data)> {
        let slots = self.sizes.face_capacity;
        let length = self.padded() * slots;
        let (mut neighbour, mut weight) = (vec![0; length], vec![0.0; length]);
        let (mut count, mut diagonal) = (vec![0; self.padded()], vec![1.0; self.padded()]);
        let at = |point: usize, slot: usize| blocks::at(point, slot, slots);
        for point in 0..self.padded() {
            let own = point.min(self.sizes.points - 1);
            (0..slots).for_each(|slot| neighbour[at(point, slot)] = own as u32);
        }
        for point in 0..self.sizes.points {
            // The pressure is known there: no equation.
            if self.is_outlet(point) {
                continue;
            }
            for (slot, (other, face)) in cells.faces(point).enumerate() {
                neighbour[at(point, slot)] = other as u32;
                weight[at(point, slot)] = face;
                count[point] += 1;
            }
            diagonal[point] = cells.faces(point).map(|(_, face)| face).sum();
        }
        vec![
            (Buffer::FaceNeighbours, Data::Index(neighbour)),
            (Buffer::FaceWeight, Data::Real(weight)),
            (Buffer::FaceCount, Data::Index(count)),
            (Buffer::Diagonal, Data::Real(diagonal)),
        ]
    }

    fn flux_rows(&self, fluxes: &Fluxes) -> Vec<(Buffer, Data)> {
        let slots = self.sizes.flux_capacity;
        let (mut points, mut row) = (vec![0; self.padded() * slots], vec![0.0; 2 * self.padded() * slots]);
        let mut count = vec![0; self.padded()];
        let at = blocks::at;
        for point in 0..self.padded() {
            let own = point.min(self.sizes.points - 1);
            (0..slots).for_each(|slot| points[at(point, slot, slots)] = own as u32);
        }
        for (point, count) in count.iter_mut().enumerate().take(self.sizes.points) {
            if self.is_outlet(point) {
                continue;
            }
            for (slot, (other, factor)) in fluxes.row(point).enumerate() {
                points[at(point, slot, slots)] = other as u32;
                row[at(point, slot, 2 * slots)] = factor.x;
                row[at(point, slots + slot, 2 * slots)] = factor.y;
                *count += 1;
            }
        }
        vec![
            (Buffer::FluxPoints, Data::Index(points)),
            (Buffer::FluxCount, Data::Index(count)),
            (Buffer::FluxRow, Data::Real(row)),
        ]
    }

    /// Points rounded up to whole blocks.
    pub fn padded(&self) -> usize {
        self.sizes.points.div_ceil(BLOCK) * BLOCK
    }

    /// One number a point as an array, `filler` in the padding.
    pub fn scalars(&self, values: &[f64], filler: f64) -> Data {
        let mut values = values.to_vec();
        values.resize(self.padded(), filler);
        Data::Real(values)
    }

    /// One vector a point as an interleaved array, `filler` in the padding.
    pub fn vectors(&self, values: &[DVec2], filler: DVec2) -> Data {
        let padding = self.padded() - values.len();
        let all = values.iter().copied().chain(std::iter::repeat_n(filler, padding));
        Data::Real(all.flat_map(|value| value.to_array()).collect())
    }

    /// Zeros in the shape of `buffer`.
    pub fn zeros(&self, buffer: Buffer) -> Data {
        let length = buffer.length(&self.sizes);
        match buffer.element() {
            Element::Real => Data::Real(vec![0.0; length]),
            Element::Index => Data::Index(vec![0; length]),
        }
    }
}

type Survey = (usize, Option<(usize, usize)>);

/// Side of a cell of the neighbour search, m: the radius, or, where that varies, the least, as long as there are not many
/// more cells than points. A search looks at as many cells as its own radius takes.
fn cell(cloud: &Cloud, spacings: f64) -> f64 {
    let least = (0..cloud.len()).map(|point| cloud.spacing_at(point)).fold(cloud.spacing, f64::min);
    match cloud.local {
        Some(_) => (spacings * least).max((cloud.size.x * cloud.size.y / cloud.len() as f64).sqrt()),
        None => spacings * cloud.spacing,
    }
}

/// The most neighbours that any point has within its radius of so many spacings, and the first point that hangs together with no
/// other group, with the number of groups; refuses points that coincide or stand alone.
fn survey(cloud: &Cloud, spacings: f64, needed: usize) -> Result<Survey, SceneError> {
    let grid = grid::Grid::new(&cloud.position, cloud.size, cloud.period, cell(cloud, spacings));
    let count = |point: usize| -> Result<usize, SceneError> {
        let own = cloud.position[point];
        let (radius, least) = (spacings * cloud.spacing_at(point), COINCIDENT * cloud.spacing_at(point));
        let mut found = 0;
        for other in grid.within(own, radius).filter(|&other| other != point) {
            let square = shortest(cloud.position[other] - own, cloud.period).length_squared();
            found += usize::from(square < radius * radius);
            if square < least * least {
                let (first, second) = (point.min(other), point.max(other));
                return Err(CloudError::Coincident { first, second, x: own.x, y: own.y, least }.into());
            }
        }
        if found < needed {
            return Err(SceneError::TooFewNeighbours { radius: spacings, point, x: own.x, y: own.y, found, needed });
        }
        Ok(found)
    };
    let most = (0..cloud.len()).into_par_iter().map(count).try_reduce(|| 0, |a, b| Ok(a.max(b)));
    // Of several that are wrong the first is told of, whichever thread found its own first.
    let most = most.or_else(|error| (0..cloud.len()).find_map(|point| count(point).err()).map_or(Err(error), Err))?;
    // Where the spacing varies, by the widest reach: groups that hang together by less are not told apart.
    Ok((most, first_apart(&cloud.position, &grid, cloud.period, spacings * cloud.spacing)))
}
