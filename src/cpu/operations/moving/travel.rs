//! Points on their way: with the velocity, and by what the pressure and the shift add to it.
//!
//! Continuous: `dr/dt = u`. Discrete: `r* = r + dt u*`, then `r' = r* + displacement`. Units: m.
//! Between mirrors a point that would come nearer to a wall than [`CLEARANCE`] spacings is put back as far as it came too near, so that
//! no two meet in a corner, and loses its velocity towards the wall. Where walls are made of points, one that has passed them is lost: it stays where it is, at rest.

use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::real::Real;

/// Least distance of a point from a wall that mirrors, in spacings.
pub const CLEARANCE: f64 = 0.1;

/// Where points may go.
#[derive(Debug, Clone, Copy)]
pub struct Tank<T> {
    /// Width and height, m.
    pub size: [T; 2],
    /// Least distance from the walls, m; of lost points, how far beyond them they are.
    pub clearance: T,
    /// Walls mirror; else they are made of points.
    pub mirrors: bool,
}

impl<T: Real> Tank<T> {
    /// The place and velocity of a point that would be at `place`, having been at `from`.
    #[inline(always)]
    fn keep(self, from: [T; 2], place: [T; 2], velocity: [T; 2]) -> ([T; 2], [T; 2]) {
        let outside =
            |at: [T; 2]| (0..2).any(|axis| at[axis] < -self.clearance || at[axis] > self.size[axis] + self.clearance);
        if !self.mirrors {
            return if outside(from) { (from, [T::zero(); 2]) } else { (place, velocity) };
        }
        let (mut place, mut velocity) = (place, velocity);
        for axis in 0..2 {
            let (low, high) = (self.clearance, self.size[axis] - self.clearance);
            if place[axis] < low {
                (place[axis], velocity[axis]) = ((low + low - place[axis]).min(high), velocity[axis].max(T::zero()));
            } else if place[axis] > high {
                (place[axis], velocity[axis]) = ((high + high - place[axis]).max(low), velocity[axis].min(T::zero()));
            }
        }
        (place, velocity)
    }
}

/// `r* = r + dt u*` below `interior`.
pub fn advance<T: Real>(tank: Tank<T>, dt: T, interior: usize, position: &mut [T], projected: &mut [T]) {
    blocks::for_each_2((position, 2), (projected, 2), &|block, position, projected| {
        for k in 0..BLOCK.min(interior.saturating_sub(block * BLOCK)) {
            let (from, velocity) = ([position[2 * k], position[2 * k + 1]], [projected[2 * k], projected[2 * k + 1]]);
            let place = [from[0] + dt * velocity[0], from[1] + dt * velocity[1]];
            let (place, velocity) = tank.keep(from, place, velocity);
            position[2 * k..2 * k + 2].copy_from_slice(&place);
            projected[2 * k..2 * k + 2].copy_from_slice(&velocity);
        }
    });
}

/// `r' = r* + displacement` below `interior`.
pub fn displace<T: Real>(tank: Tank<T>, displacement: &[T], interior: usize, position: &mut [T], projected: &mut [T]) {
    blocks::for_each_2((position, 2), (projected, 2), &|block, position, projected| {
        for k in 0..BLOCK.min(interior.saturating_sub(block * BLOCK)) {
            let way = &displacement[2 * (block * BLOCK + k)..];
            let (from, velocity) = ([position[2 * k], position[2 * k + 1]], [projected[2 * k], projected[2 * k + 1]]);
            let (place, velocity) = tank.keep(from, [from[0] + way[0], from[1] + way[1]], velocity);
            position[2 * k..2 * k + 2].copy_from_slice(&place);
            projected[2 * k..2 * k + 2].copy_from_slice(&velocity);
        }
    });
}
