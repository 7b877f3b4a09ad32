//! How dense the points stand, and which of them are the free surface.
//!
//! Number density: `c_i = sum_j w_ij / n0`, `n0` that of a full lattice; `w` is MPS's `r_e / r - 1`, or `(1 - (r/r_e)^2)^2`
//! beside fits. Surface: of circles of radius `R` about all points, the one about a point of the surface is not covered by
//! the others. A place `R e` on it lies in the circle about the neighbour at `d` if `|R e - d| < R`, which is
//! `d.d < 2 R e.d`. [`DIRECTIONS`] places are looked at; [`GAP`] uncovered in a row make a surface. MPS asks for a
//! density below [`THRESHOLD`] too. Sources: Dilts, Int. J. Numer. Meth. Eng. 48 (2000) 1503-1524 (circles); Koshizuka and
//! Oka (1996) (density).

use super::mirror::{Around, Stencil};
use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::operations::integral::weight;
use crate::cpu::real::{Pack, Real};

/// Places on the circle about a point; their number is that of the bits of a word.
pub const DIRECTIONS: usize = 32;
/// Uncovered places in a row that make a surface.
pub const GAP: u32 = 2;
/// Radius of the circles, in spacings.
pub const REACH: f64 = 1.5;
/// Number density below which MPS takes a point for the surface, over that of a full lattice.
pub const THRESHOLD: f64 = 0.97;

/// Beside fits a point is spray where its density is below this, or where it has fewer than [`FEW`] of a lattice's neighbours:
/// images behind a wall cover it, and do not carry a fit.
pub const THIN: f64 = 0.65;
pub const FEW: f64 = 0.25;

/// The directions as unit vectors.
pub fn directions() -> [[f64; 2]; DIRECTIONS] {
    std::array::from_fn(|k| {
        let (y, x) = (std::f64::consts::TAU * k as f64 / DIRECTIONS as f64).sin_cos();
        [x, y]
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

/// Fills the density over that of a lattice, and 1 for points of the surface. Points that have no pressure are none.
pub fn find_surface<T: Real>(
    around: Around<T>,
    crowd: Crowd<T>,
    pressured: usize,
    crowding: &mut [T],
    surface: &mut [u32],
) {
    let directions = directions().map(|e| e.map(|e| T::Pack::splat(T::from_f64(2.0 * e) * crowd.reach)));
    let one = T::Pack::splat(T::from_f64(1.0));
    let zero = T::Pack::zero();
    blocks::for_each_2((crowding, 1), (surface, 1), &|block, crowding, surface| {
        for first in (0..BLOCK).step_by(T::Pack::LANES) {
            let i = block * BLOCK + first;
            let mut density = zero;
            let mut covered = [zero; DIRECTIONS];
            Stencil::new(around, i).for_each(|near| {
                let crowding = match crowd.integral {
                    true => weight::<T>(near.square),
                    // Unused slots hold the point itself.
                    false => {
                        let rest = (one - near.square).max(zero);
                        near.square.select_above(zero, rest * rest, zero)
                    }
                };
                density += near.counts * crowding;
                let [x, y] = near.offset;
                for (covered, [ex, ey]) in covered.iter_mut().zip(&directions) {
                    *covered = covered.max(near.counts * ((*ex * x + *ey * y) - near.square));
                }
            });
            (density * T::Pack::splat(crowd.per_density)).store(&mut crowding[first..]);
            for lane in 0..T::Pack::LANES {
                let mut uncovered = 0_u32;
                for (k, covered) in covered.iter().enumerate() {
                    uncovered |= u32::from(covered.lane(lane) <= T::zero()) << k;
                }
                let density = crowding[first + lane];
                let free = match crowd.integral {
                    true => density < T::from_f64(THRESHOLD) && has_gap(uncovered),
                    false => {
                        let few = around.lists.count[i + lane] < crowd.fewest;
                        few || density < T::from_f64(THIN) || has_gap(uncovered)
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
