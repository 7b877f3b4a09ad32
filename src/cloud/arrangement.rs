//! Interior points: on a lattice, on a jittered lattice, at random with a minimum distance, or at random and then relaxed.

use glam::DVec2;
use rand_core::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

use super::sizing::Sizing;
use super::wall::Lattice;
use super::{CloudError, relaxation, shortest};
use crate::case::{Arrangement, Cloud};

/// Throws per wanted point after which random placement gives up.
const THROWS_PER_POINT: usize = 400;

/// The room that obstacles take: true of places that are free, and what it is worth in points.
pub(super) struct Room<'a> {
    pub free: &'a dyn Fn(DVec2) -> bool,
    pub taken: usize,
}

pub(super) fn interior(
    cloud: &Cloud,
    lattice: &Lattice,
    boundary: &[DVec2],
    sizing: &Sizing,
    room: &Room,
) -> Result<Vec<DVec2>, CloudError> {
    let mut random = Uniform(Xoshiro256PlusPlus::seed_from_u64(cloud.seed()));
    let free = |place: &DVec2| (room.free)(*place);
    match cloud.arrangement {
        Arrangement::Regular => Ok(places(lattice).filter(free).collect()),
        Arrangement::Jittered => {
            let reach = cloud.jitter() * cloud.spacing;
            Ok(places(lattice).map(|place| place + reach * random.in_square()).filter(free).collect())
        }
        Arrangement::Random => {
            random_points(cloud.minimum_distance(), cloud.spacing, lattice, boundary, room, &mut random)
        }
        Arrangement::Relaxed => relaxation::scatter(sizing, &mut random, room.free),
    }
}

/// Displaces the places that `may` move, as jittered points are.
pub(super) fn jitter(cloud: &Cloud, position: &mut [DVec2], may: impl Fn(DVec2) -> bool) {
    let mut random = Uniform(Xoshiro256PlusPlus::seed_from_u64(cloud.seed()));
    let reach = cloud.jitter() * cloud.spacing;
    for place in position.iter_mut().filter(|place| may(**place)) {
        *place += reach * random.in_square();
    }
}

fn places(lattice: &Lattice) -> impl Iterator<Item = DVec2> {
    lattice.inner(1).flat_map(move |j| lattice.inner(0).map(move |i| lattice.place(i, j)))
}

/// Random sequential addition: places are thrown one after another, and kept where no point is too near.
///
/// A grid of squares whose diagonal is the minimum distance holds at most one point a square, so a throw looks at
/// the 5 x 5 squares around it, across the seam where an axis repeats.
fn random_points(
    minimum_distance: f64,
    spacing: f64,
    lattice: &Lattice,
    boundary: &[DVec2],
    room: &Room,
    random: &mut Uniform,
) -> Result<Vec<DVec2>, CloudError> {
    const EMPTY: u32 = u32::MAX;
    let least = minimum_distance * spacing;
    let (size, wanted) = (lattice.size, lattice.interior().saturating_sub(room.taken));
    let [x, y] = lattice.periodic;
    let period = DVec2::new(if x { size.x } else { 0.0 }, if y { size.y } else { 0.0 });
    let mut square = DVec2::splat(least * std::f64::consts::FRAC_1_SQRT_2);
    let mut squares = (size / square).floor().as_usizevec2() + 1;
    // A whole number of them, a little smaller, fills a period.
    for axis in (0..2).filter(|&axis| lattice.periodic[axis]) {
        squares[axis] = squares[axis].max(5);
        square[axis] = size[axis] / squares[axis] as f64;
    }
    let square_of = |place: DVec2| (place / square).as_usizevec2().min(squares - 1);
    let mut grid = vec![EMPTY; squares.x * squares.y];
    let mut placed: Vec<DVec2> = Vec::with_capacity(boundary.len() + wanted);
    for &place in boundary {
        let at = square_of(place);
        grid[at.y * squares.x + at.x] = placed.len() as u32;
        placed.push(place);
    }
    let full = boundary.len() + wanted;
    let mut throws = THROWS_PER_POINT * wanted;
    while placed.len() < full && throws > 0 {
        throws -= 1;
        let place = random.in_unit_square() * size;
        if !(room.free)(place) {
            continue;
        }
        let at = square_of(place);
        let near = |axis: usize| {
            let (at, count) = (at[axis], squares[axis]);
            let wraps = lattice.periodic[axis];
            (0..5).filter_map(move |k| match at + k {
                beyond if wraps => Some((beyond + count - 2) % count),
                k => (2..count + 2).contains(&k).then(|| k - 2),
            })
        };
        let crowded = near(1).any(|row| {
            near(0)
                .map(|column| grid[row * squares.x + column])
                .filter(|&other| other != EMPTY)
                .any(|other| shortest(placed[other as usize] - place, period).length_squared() < least * least)
        });
        if !crowded {
            grid[at.y * squares.x + at.x] = placed.len() as u32;
            placed.push(place);
        }
    }
    if placed.len() < full {
        return Err(CloudError::Jammed { minimum_distance, placed: placed.len() - boundary.len(), wanted });
    }
    Ok(placed.split_off(boundary.len()))
}

/// Puts points that are close in space close in memory: row by row of square cells.
pub(super) fn sort_by_cell(position: &mut [DVec2], cell: f64) {
    position.sort_by_cached_key(|place| {
        let at = (*place / cell).as_usizevec2();
        (at.y, at.x)
    });
}

/// Uniform numbers in [0, 1) with 53 bits.
pub(super) struct Uniform(Xoshiro256PlusPlus);

impl Uniform {
    pub fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn in_unit_square(&mut self) -> DVec2 {
        let x = self.unit();
        DVec2::new(x, self.unit())
    }

    /// In [-1, 1) x [-1, 1).
    fn in_square(&mut self) -> DVec2 {
        2.0 * self.in_unit_square() - 1.0
    }
}
