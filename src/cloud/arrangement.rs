//! Interior points: on a lattice, on a jittered lattice, or at random with a minimum distance.

use glam::{DVec2, USizeVec2};
use rand_core::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

use super::{CloudError, wall};
use crate::case::{Arrangement, Cloud};

/// Throws per wanted point after which random placement gives up.
const THROWS_PER_POINT: usize = 400;

pub(super) fn interior(
    cloud: &Cloud,
    size: DVec2,
    cells: [usize; 2],
    boundary: &[DVec2],
) -> Result<Vec<DVec2>, CloudError> {
    let mut random = Uniform(Xoshiro256PlusPlus::seed_from_u64(cloud.seed()));
    match cloud.arrangement {
        Arrangement::Regular => Ok(lattice(size, cells).collect()),
        Arrangement::Jittered => {
            let reach = cloud.jitter() * cloud.spacing;
            Ok(lattice(size, cells).map(|place| place + reach * random.in_square()).collect())
        }
        Arrangement::Random => random_points(
            cloud.minimum_distance(),
            cloud.spacing,
            size,
            (cells[0] - 1) * (cells[1] - 1),
            boundary,
            &mut random,
        ),
    }
}

fn lattice(size: DVec2, [nx, ny]: [usize; 2]) -> impl Iterator<Item = DVec2> {
    (1..ny).flat_map(move |j| (1..nx).map(move |i| wall::lattice(size, [nx, ny], i, j)))
}

/// Random sequential addition: places are thrown one after another, and kept where no point is too near.
///
/// A grid of squares whose diagonal is the minimum distance holds at most one point a square, so a throw looks at
/// the 5 x 5 squares around it.
fn random_points(
    minimum_distance: f64,
    spacing: f64,
    size: DVec2,
    wanted: usize,
    boundary: &[DVec2],
    random: &mut Uniform,
) -> Result<Vec<DVec2>, CloudError> {
    const EMPTY: u32 = u32::MAX;
    let least = minimum_distance * spacing;
    let square = least * std::f64::consts::FRAC_1_SQRT_2;
    let squares = (size / square).floor().as_usizevec2() + 1;
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
        let at = square_of(place);
        let low = USizeVec2::new(at.x.saturating_sub(2), at.y.saturating_sub(2));
        let high = (at + 3).min(squares);
        let crowded = (low.y..high.y).any(|row| {
            grid[row * squares.x + low.x..row * squares.x + high.x]
                .iter()
                .any(|&other| other != EMPTY && placed[other as usize].distance_squared(place) < least * least)
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
struct Uniform(Xoshiro256PlusPlus);

impl Uniform {
    fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    }

    fn in_unit_square(&mut self) -> DVec2 {
        let x = self.unit();
        DVec2::new(x, self.unit())
    }

    /// In [-1, 1) x [-1, 1).
    fn in_square(&mut self) -> DVec2 {
        2.0 * self.in_unit_square() - 1.0
    }
}
