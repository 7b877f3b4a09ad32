//! The velocity on slip sides and at outlets, from the fluid before them.
//!
//! Continuous: `d u / dn = 0`, and `n . u = 0` on slip sides. Discrete: `v = sum_j s_ij u_j`, `u_i = v - n_i (n_i . v)`, the shares of
//! `src/cloud/open.rs`, `n_i` zero at outlets. Units: m/s.

use crate::cpu::blocks;
use crate::cpu::real::Real;

/// Points, shares and normals, `capacity` slots a point, blocked.
#[derive(Clone, Copy)]
pub struct Open<'a, T> {
    pub points: &'a [u32],
    pub row: &'a [T],
    pub count: &'a [u32],
    pub normal: &'a [T],
    pub capacity: usize,
}

/// Gives the boundary points that follow the fluid their velocity; reads none of theirs.
pub fn open_sides<T: Real>(open: Open<T>, interior: usize, end: usize, velocity: &mut [T]) {
    for i in interior..end {
        let count = open.count[i] as usize;
        if count == 0 {
            continue;
        }
        let mut sum = [T::zero(); 2];
        for slot in 0..count.min(open.capacity) {
            let at = blocks::at(i, slot, open.capacity);
            let (j, share) = (open.points[at] as usize, open.row[at]);
            sum = [sum[0] + share * velocity[2 * j], sum[1] + share * velocity[2 * j + 1]];
        }
        let normal = [open.normal[2 * i], open.normal[2 * i + 1]];
        let through = normal[0] * sum[0] + normal[1] * sum[1];
        velocity[2 * i] = sum[0] - through * normal[0];
        velocity[2 * i + 1] = sum[1] - through * normal[1];
    }
}
