//! Diffusion of a carried field through the faces of the Voronoi cells.
//!
//! Continuous: `d phi / dt = D lap phi`, on walls held, or `D n . grad phi = q`.
//! Discrete:   `d phi_i / dt = (D / V_i) sum_j w_ij (phi_j - phi_i) + q A_i / V_i`: what leaves one cell enters another, and a wall
//! needs no row of its own. By the midpoint rule over half a step `h`: `phi_m = phi + (h/2) r(phi)`, `phi += h r(phi_m)`.
//! Source: finite volumes on Voronoi cells (Eymard, Gallouet and Herbin, Handbook of Numerical Analysis VII, 2000, chapter 3).
//! Units: `D / V_i` 1/(m^2 s), 0 where the value is held; `q A_i / V_i` that of the field a second.

use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::operations::conservative::Faces;
use crate::cpu::real::{Pack, Real};

/// How fast the values of neighbours reach a point.
#[derive(Clone, Copy)]
pub struct Exchange<'a, T> {
    pub faces: Faces<'a, T>,
    pub reach: &'a [T],
}

/// `out = base + time rate(field)`; without a base `out` itself is what is added to.
pub fn diffuse<T: Real>(exchange: Exchange<T>, field: &[T], base: Option<&[T]>, time: T, out: &mut [T]) {
    let Exchange { faces, reach } = exchange;
    let time = T::Pack::splat(time);
    blocks::for_each(out, 1, &|block, out| {
        for first in (0..BLOCK).step_by(T::Pack::LANES) {
            let i = block * BLOCK + first;
            let own = T::Pack::load(&field[i..]);
            let mut sum = T::Pack::zero();
            faces.for_each(i, |index, weight| {
                // SAFETY: every stored face neighbour is below the number of points.
                sum += weight * (unsafe { T::Pack::gather(field, index) } - own);
            });
            let rate = T::Pack::load(&reach[i..]) * sum;
            let before = T::Pack::load(base.map_or(&out[first..], |base| &base[i..]));
            (before + time * rate).store(&mut out[first..]);
        }
    });
}

/// `out += time supply`: heat through the walls.
pub fn heat_walls<T: Real>(supply: &[T], time: T, out: &mut [T]) {
    blocks::for_each(out, 1, &|block, out| {
        out.iter_mut().zip(&supply[block * BLOCK..]).for_each(|(out, &supply)| *out += time * supply);
    });
}
