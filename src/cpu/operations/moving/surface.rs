//! How dense the points stand, and which of them are the free surface.
//!
//! Number density: `c_i = sum_j w_ij / n0`, `n0` that of a full lattice; `w` is MPS's `r_e / r - 1`, or `(1 - (r/r_e)^2)^2`
//! beside fits. Surface: of circles of radius `R` about all points, the one about a point of the surface is not covered by
//! the others. A place `R e` on it lies in the circle about the neighbour at `d` if `|R e - d| < R`, which is
//! `d.d < 2 R e.d`. [`DIRECTIONS`] places are looked at; [`GAP`] uncovered in a row make a surface. MPS asks for a
//! density below [`THRESHOLD`] too. Sources: Dilts, Int. J. Numer. Meth. Eng. 48 (2000) 1503-1524 (circles); Koshizuka and
//! Oka (1996) (density).

use super::mirror::{Around, Neighbour, Stencil};
use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::operations::integral::weight;
use crate::cpu::real::{Pack, Real};

/// Places on the circle about a point; their number is that of the bits of a word.
pub const DIRECTIONS: usize = 32;
const HALF: usize = DIRECTIONS / 2;
/// Uncovered places in a row that make a surface.
pub const GAP: u32 = 2;
const _: () = assert!(GAP >= 2, "every gap has an even place");
/// Radius of the circles, in spacings.
pub const REACH: f64 = 1.5;
/// Number density below which MPS takes a point for the surface, over that of a full lattice.
pub const THRESHOLD: f64 = 0.97;

/// Beside fits a point is spray where its density is below this, or where it has fewer than [`FEW`] of a lattice's neighbours:
/// images behind a wall cover it, and do not carry a fit.
pub const THIN: f64 = 0.65;
pub const FEW: f64 = 0.25;

/// The directions as unit vectors, the second half the first one's negatives.
pub fn directions() -> [[f64; 2]; DIRECTIONS] {
    std::array::from_fn(|k| {
        let (y, x) = (std::f64::consts::TAU * (k % HALF) as f64 / DIRECTIONS as f64).sin_cos();
        if k < HALF { [x, y] } else { [-x, -y] }
    })
}

/// How the density is formed and judged.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crowd<T> {
    /// MPS's weight and threshold.
    pub integral: bool,
    /// `1 / n0`.
    pub per_density: T,
    /// Fewest neighbours of a point inside the fluid.
    pub fewest: u32,
    /// Radius of the circles over that of the neighbourhood.
    pub reach: T,
}

/// True if a word of uncovered directions has a gap of [`GAP`] in a row, round the end too.
pub fn has_gap(uncovered: u32) -> bool {
    (1..GAP).fold(uncovered, |rows, step| rows & uncovered.rotate_left(step)) != 0
}

/// Every other direction that has an opposite one: those at even places, those at odd ones.
type Sides<P> = [[P; 2]; HALF / 2];

/// How far the circles about neighbours reach beyond places on that about a point: above 0 where one covers it.
struct Reach<P> {
    ahead: [P; HALF / 2],
    behind: [P; HALF / 2],
}

impl<P> Reach<P> {
    #[inline(always)]
    fn none<T: Real>() -> Self
    where
        P: Pack<T>,
    {
        Self { ahead: [P::zero(); HALF / 2], behind: [P::zero(); HALF / 2] }
    }

    #[inline(always)]
    fn add<T: Real>(&mut self, sides: &Sides<P>, near: &Neighbour<P>)
    where
        P: Pack<T>,
    {
        let ([x, y], square) = (near.offset.map(|d| near.counts * d), near.counts * near.square);
        for (k, [ex, ey]) in sides.iter().enumerate() {
            let along = *ex * x + *ey * y;
            self.ahead[k] = self.ahead[k].max(along - square);
            self.behind[k] = self.behind[k].max(-along - square);
        }
    }

    /// The lanes that have an uncovered place.
    #[inline(always)]
    fn open<T: Real>(&self) -> u32
    where
        P: Pack<T>,
    {
        let both = self.ahead.iter().chain(&self.behind);
        let least = both.fold(self.ahead[0], |least, reach| least.min(*reach));
        !least.above(P::zero()) & ((1 << P::LANES) - 1)
    }

    /// The uncovered places of a lane, the first of them at the place `first`.
    #[inline(always)]
    fn uncovered<T: Real>(&self, lane: usize, first: usize) -> u32
    where
        P: Pack<T>,
    {
        let bit = |reach: &P, place: usize| u32::from(reach.lane(lane) <= T::zero()) << place;
        let places = self.ahead.iter().zip(&self.behind).enumerate();
        places
            .fold(0, |word, (k, (ahead, behind))| word | bit(ahead, 2 * k + first) | bit(behind, 2 * k + first + HALF))
    }
}

/// Fills the density over that of a lattice, and 1 for points of the surface. Points that have no pressure are none.
pub fn find_surface<T: Real>(
    around: Around<T>,
    crowd: Crowd<T>,
    pressured: usize,
    crowding: &mut [T],
    surface: &mut [u32],
) {
    let directions = directions().map(|e| e.map(|e| T::Pack::splat(T::from_f64(2.0 * e) * crowd.reach)));
    let [even, odd]: [Sides<T::Pack>; 2] = [0, 1].map(|first| std::array::from_fn(|k| directions[2 * k + first]));
    let one = T::Pack::splat(T::from_f64(1.0));
    let zero = T::Pack::zero();
    blocks::for_each_2((crowding, 1), (surface, 1), &|block, crowding, surface| {
        for first in (0..BLOCK).step_by(T::Pack::LANES) {
            let i = block * BLOCK + first;
            let stencil = Stencil::new(around, i);
            let mut density = zero;
            let mut reach = Reach::none();
            stencil.for_each(|near| {
                let crowding = match crowd.integral {
                    true => weight::<T>(near.square),
                    // Unused slots hold the point itself.
                    false => {
                        let rest = (one - near.square).max(zero);
                        near.square.select_above(zero, rest * rest, zero)
                    }
                };
                density += near.counts * crowding;
                reach.add(&even, &near);
            });
            (density * T::Pack::splat(crowd.per_density)).store(&mut crowding[first..]);
            // A gap of two or more has an even place: few points need be looked at again.
            let open = reach.open();
            let mut between = Reach::none();
            if open != 0 {
                stencil.for_each(|near| between.add(&odd, &near));
            }
            for lane in 0..T::Pack::LANES {
                let gap = open >> lane & 1 != 0 && has_gap(reach.uncovered(lane, 0) | between.uncovered(lane, 1));
                let density = crowding[first + lane];
                let free = match crowd.integral {
                    true => density < T::from_f64(THRESHOLD) && gap,
                    false => {
                        let few = around.lists.count[i + lane] < crowd.fewest;
                        few || density < T::from_f64(THIN) || gap
                    }
                };
                surface[first + lane] = u32::from(i + lane < pressured && free);
            }
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gaps_are_runs_of_uncovered_places_round_the_end_too() {
        assert!(!has_gap(0) && !has_gap(0b101) && !has_gap(1 << 31));
        assert!(has_gap(0b110) && has_gap(1 | 1 << 31) && has_gap(u32::MAX));
    }
}
