//! Where the points are: a rectangle filled with points, on its walls, on the outlines of obstacles in it, and between.

mod arrangement;
mod error;
mod figure;
mod fill;
pub mod flux;
pub mod grid;
mod groups;
mod layers;
mod open;
mod outline;
mod period;
mod piece;
mod relaxation;
pub(crate) mod shape;
mod sizing;
pub mod voronoi;
mod wall;

use glam::DVec2;

use crate::case;
use arrangement::Room;
pub use error::CloudError;
pub use groups::first_apart;
pub use open::{OpenPoint, open_points};
pub use outline::{Outline, Traced, outlines};
pub use period::{inside, shortest};
pub use shape::Shape;
pub use sizing::Sizing;
pub use wall::Side;

/// The points of a scene at their initial places, interior points first, boundary points last.
///
/// With that order "interior" and "boundary" are two ranges, and no kernel asks a point which it is.
#[derive(Debug, Clone, PartialEq)]
pub struct Cloud {
    /// Places of all points, m.
    pub position: Vec<DVec2>,
    /// Number of interior points: `position[..interior]`.
    pub interior: usize,
    /// Number of points that have a pressure, `position[..pressured]`: all but those behind the walls of MPS.
    pub pressured: usize,
    /// The volume of an interior point where the fluid fills a part of the rectangle alone, m^2.
    pub filled: Option<f64>,
    /// Outward unit normals of the boundary points, `position[interior..]`; at a corner, of the mean of its two sides.
    pub normal: Vec<DVec2>,
    /// The sides of the rectangle that each boundary point lies on: one, two at a corner, none on an outline.
    pub sides: Vec<Vec<Side>>,
    /// The outlines of obstacles; their points follow those on the sides.
    pub outlines: Vec<Outline>,
    /// Mean distance of neighbouring points, `l0`, m; the largest where it varies.
    pub spacing: f64,
    /// The same around every point, m; `None` where it is `spacing` everywhere.
    pub local: Option<Vec<f64>>,
    /// Width and height of the rectangle, m.
    pub size: DVec2,
    /// Lengths after which it repeats along x and y, m: its own, or 0 along an axis that ends at walls.
    pub period: DVec2,
}

/// What rounding may put a point on a wall beside it, in spacings.
const ROUNDING: f64 = 1e-6;

impl Cloud {
    /// Lays out the points that `case` asks for. The same case gives the same points on every machine.
    pub fn build(case: &case::Case) -> Result<Self, CloudError> {
        let size = DVec2::new(case.domain.width, case.domain.height);
        let cells = wall::cells(size, case.cloud.spacing);
        let period = case.domain.period();
        if let Some(fill) = &case.cloud.fill {
            return Ok(fill::build(case, fill));
        }
        let lattice = wall::Lattice { size, cells, periodic: case.domain.periodic.each() };
        let sizing = Sizing::of(case);
        let relaxed = case.cloud.arrangement == case::Arrangement::Relaxed;
        let (mut boundary, mut sides) = match relaxed {
            true => wall::graded_points(&sizing, lattice.periodic),
            false => wall::points(&lattice),
        };
        let mut normal: Vec<DVec2> =
            sides.iter().map(|sides| sides.iter().map(|side| side.normal()).sum::<DVec2>().normalize()).collect();
        let mut outlines = outline::place(case, &mut boundary, &mut normal)?;
        sides.resize(boundary.len(), Vec::new());
        let mut cloud = Self {
            interior: 0,
            normal,
            position: vec![],
            sides,
            outlines: outlines.clone(),
            pressured: 0,
            filled: None,
            spacing: case.cloud.spacing,
            local: None,
            size,
            period,
        };
        let layers = match relaxed {
            true => {
                let distance = |place: DVec2| cloud.beside(place).min(cloud.clearance(place));
                layers::layers(&boundary, &cloud.normal, &sizing, period, &distance)
            }
            false => vec![],
        };
        let taken = grid::Grid::new(&layers, size, period, sizing.least());
        let free = |place: DVec2| {
            let spacing = sizing.at(place);
            let room = relaxation::CLEARANCE * spacing;
            let reach = relaxation::APART * spacing;
            let mut near = taken.within(place, reach);
            cloud.clearance(place) > room
                && (!relaxed || cloud.beside(place) > room)
                && !near.any(|other| shortest(layers[other] - place, period).length() < reach)
        };
        let room = Room { free: &free, taken: cloud.taken() };
        let mut position = arrangement::interior(&case.cloud, &lattice, &boundary, &sizing, &room)?;
        let scattered = position.len();
        position.extend(&layers);
        cloud.interior = position.len();
        outlines.iter_mut().for_each(|outline| {
            outline.points.start += position.len();
            outline.points.end += position.len();
        });
        position.extend(boundary);
        (cloud.position, cloud.outlines) = (position, outlines);
        outline::check(&cloud, &sizing)?;
        match relaxed {
            true => relaxation::relax(&mut cloud, scattered, &sizing),
            false => relaxation::relax_near_outlines(&mut cloud, &sizing),
        }
        arrangement::sort_by_cell(&mut cloud.position[..cloud.interior], 2.0 * case.cloud.spacing);
        cloud.pressured = cloud.position.len();
        if !sizing.is_even() {
            cloud.local = Some(cloud.position.iter().map(|&place| sizing.at(place)).collect());
        }
        Ok(cloud)
    }

    /// About how many points [`Cloud::build`] puts into the fluid, without laying them out; obstacles are not taken off.
    pub fn estimate(case: &case::Case) -> f64 {
        if let Some(fill) = &case.cloud.fill {
            let way = DVec2::from(fill.to) - DVec2::from(fill.from);
            return (way / case.cloud.spacing).element_product();
        }
        let sizing = Sizing::of(case);
        if sizing.is_even() { case.point_estimate() } else { sizing.points().max(case.point_estimate()) }
    }

    /// Distance from a place to the nearest outline, negative inside an obstacle, m; infinite without obstacles.
    pub fn clearance(&self, place: DVec2) -> f64 {
        self.outlines.iter().map(|outline| outline.shape.distance(place)).fold(f64::INFINITY, f64::min)
    }

    /// Distance from a place to the nearest side, m; infinite where the domain repeats.
    fn beside(&self, place: DVec2) -> f64 {
        let beside = place.min(self.size - place);
        DVec2::select(self.period.cmpgt(DVec2::ZERO), DVec2::INFINITY, beside).min_element()
    }

    /// The mean distance of neighbouring points around one, m.
    pub fn spacing_at(&self, point: usize) -> f64 {
        self.local.as_ref().map_or(self.spacing, |local| local[point])
    }

    /// Area of the fluid, m^2.
    pub fn area(&self) -> f64 {
        self.size.x * self.size.y - self.outlines.iter().map(|outline| outline.shape.area()).sum::<f64>()
    }

    /// About how many interior points of a lattice the obstacles take the room of.
    fn taken(&self) -> usize {
        let of = |outline: &Outline| {
            outline.shape.area() / (self.spacing * self.spacing) + 0.5 * outline.points.len() as f64
        };
        self.outlines.iter().map(of).sum::<f64>().round() as usize
    }

    /// What every cloud has to be, whoever laid it out.
    ///
    /// # Errors
    /// No points, no spacing, a wall without its normals, a point outside the rectangle or nowhere.
    pub fn check(&self) -> Result<(), CloudError> {
        let walls = self.len().checked_sub(self.interior);
        let positive = |length: f64| length.is_finite() && length > 0.0;
        let malformed = match self {
            _ if self.interior == 0 => Some("the cloud has no points inside"),
            _ if !positive(self.spacing) => Some("the cloud's spacing is not a length above 0"),
            _ if !(positive(self.size.x) && positive(self.size.y)) => Some("the cloud's domain has no area"),
            _ if walls != Some(self.normal.len()) || walls != Some(self.sides.len()) => {
                Some("the cloud's boundary points are not as many as their normals and sides")
            }
            _ => None,
        };
        if let Some(reason) = malformed {
            return Err(CloudError::Malformed(reason));
        }
        let slack = ROUNDING * self.spacing;
        let along = |at: f64, length: f64| at >= -slack && at <= length + slack;
        let outside = |place: &DVec2| !(along(place.x, self.size.x) && along(place.y, self.size.y));
        // Points behind walls of points lie beyond it.
        match self.position[..self.pressured.min(self.len())].iter().position(outside) {
            Some(point) => {
                let (DVec2 { x, y }, DVec2 { x: width, y: height }) = (self.position[point], self.size);
                Err(CloudError::Outside { point, x, y, width, height })
            }
            None => Ok(()),
        }
    }

    /// Number of points, interior and boundary.
    pub fn len(&self) -> usize {
        self.position.len()
    }

    pub fn is_empty(&self) -> bool {
        self.position.is_empty()
    }

    /// The volume that each point stands for where no cells are built, m^2: `l0^2` inside, half on a side, a quarter
    /// at a corner. Without obstacles it sums to the area of the rectangle.
    pub fn nominal_volume(&self) -> Vec<f64> {
        if let Some(volume) = self.filled {
            let others = std::iter::repeat_n(0.0, self.len() - self.interior);
            return std::iter::repeat_n(volume, self.interior).chain(others).collect();
        }
        let [nx, ny] = wall::cells(self.size, self.spacing);
        let cell = self.size.x * self.size.y / (nx * ny) as f64;
        let boundary = self.sides.iter().map(|sides| cell / f64::from(1u32 << sides.len().max(1)));
        std::iter::repeat_n(cell, self.interior).chain(boundary).collect()
    }

    /// The velocity that the sides prescribe at each boundary point, m/s. A corner takes what its sides agree on, of those that
    /// prescribe one, else it rests: below a lid it belongs to the side wall. Rest where no side does, and on obstacles.
    pub fn wall_velocity(&self, boundaries: &case::Boundaries) -> Vec<DVec2> {
        let agreed = |(sides, &place): (&Vec<Side>, &DVec2)| {
            let mut given = sides.iter().filter_map(|side| side.velocity(boundaries, place, self.size));
            let first = given.next().unwrap_or(DVec2::ZERO);
            if given.all(|velocity| velocity == first) { first } else { DVec2::ZERO }
        };
        self.sides.iter().zip(&self.position[self.interior..]).map(agreed).collect()
    }
}

/// Small clouds of every arrangement, square and 4 : 1, between walls and periodic, for tests.
#[cfg(test)]
pub(crate) fn test_clouds() -> Vec<Cloud> {
    let mut clouds = Vec::new();
    for (width, periodic) in [(1.0, "none"), (4.0, "none"), (4.0, "x"), (4.0, "y"), (1.0, "both"), (0.6875, "both")] {
        for arrangement in ["regular", "jittered", "random"] {
            let text = format!(
                "title = 'test'\nfluid.density = 1.0\ntime.end = 1.0\neffects.advection = {{}}\n\
                 domain = {{ width = {width:?}, height = 1.0, periodic = '{periodic}' }}\n\
                 cloud = {{ arrangement = '{arrangement}', spacing = 0.0625 }}\n"
            );
            let case = case::Case::from_text(&text, std::path::Path::new("test.toml"), &[]).expect("a case");
            clouds.push(Cloud::build(&case).expect("a cloud"));
        }
    }
    clouds
}
