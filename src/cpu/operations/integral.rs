//! The integral form of MPS: derivatives as weighted means over the neighbours, the weight that of a full lattice.
//!
//! Continuous: `phi(r) = integral of phi(r') delta(r' - r)`; (2.1) of the paper. Discrete, `D = 2` dimensions:
//! value     `(1 / n0) sum_j phi_j w_ij`                                  (2.2)
//! gradient  `(D / n0) sum_j (phi_j - phi_i) d_ij / |d_ij|^2 w_ij`        (2.3)
//! Laplacian `(2 D / (lambda n0)) sum_j (phi_j - phi_i) w_ij`             (2.4)
//! `w(r) = r_e / r - 1` below `r_e`, `n0 = sum w`, `lambda = sum w r^2 / sum w`, both of a point of the full lattice, whatever
//! neighbours a point has. Source: Koshizuka and Oka, Nucl. Sci. Eng. 123 (1996) 421-434.
//! Shapes and units of the rows as those of the fit.

use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::operations::fit::Stencil;
use crate::cpu::operations::lists::Lists;
use crate::cpu::operations::space::Space;
use crate::cpu::real::{Pack, Real};

/// Dimensions of space, `D`.
pub const DIMENSIONS: f64 = 2.0;

/// Sums over the neighbours of a point of the square lattice.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lattice {
    /// Number density `n0`, no unit.
    pub density: f64,
    /// `lambda`, m^2.
    pub spread: f64,
}

/// The sum of `weight(r / r_e, (r / r_e)^2)` over the neighbours of a point of the square lattice.
pub fn lattice_sum(radius: f64, spacing: f64, weight: impl Fn(f64, f64) -> f64) -> f64 {
    let reach = (radius / spacing).ceil() as i64;
    let offsets = (-reach..=reach).flat_map(|i| (-reach..=reach).map(move |j| (i, j)));
    let distances = offsets.map(|(i, j)| spacing / radius * (i as f64).hypot(j as f64));
    distances.filter(|&q| q > 0.0 && q < 1.0).map(|q| weight(q, q * q)).sum()
}

impl Lattice {
    /// Of points `spacing` apart and a neighbourhood of `radius`, both in m.
    pub fn new(radius: f64, spacing: f64) -> Self {
        let reach = (radius / spacing).ceil() as i64;
        let (mut density, mut spread) = (0.0, 0.0);
        for (i, j) in (-reach..=reach).flat_map(|i| (-reach..=reach).map(move |j| (i, j))) {
            let distance = spacing * (i as f64).hypot(j as f64);
            if distance > 0.0 && distance < radius {
                let weight = radius / distance - 1.0;
                density += weight;
                spread += weight * distance * distance;
            }
        }
        Self { density, spread: spread / density }
    }
}

/// `w = r_e / r - 1` below `r_e`, from the square of `r / r_e`; nothing for the point itself, which stands in unused slots.
#[inline(always)]
pub fn weight<T: Real>(square: T::Pack) -> T::Pack {
    let (one, zero) = (T::Pack::splat(T::from_f64(1.0)), T::Pack::zero());
    square.select_above(zero, one / square.sqrt() - one, zero).max(zero)
}

/// The points and their neighbours, and what the sums are divided by.
#[derive(Clone, Copy)]
pub struct Means<'a, T, S> {
    pub position: &'a [T],
    pub support: &'a [T],
    pub lists: Lists<'a>,
    pub lattice: Lattice,
    pub space: S,
}

impl<T: Real, S: Space<T>> Means<'_, T, S> {
    /// Calls `body(slot, indexes, d / r_e, its square, w)` for every slot of the points `i..i + LANES`; the point itself, in
    /// unused slots, weighs nothing.
    #[inline(always)]
    fn for_each(&self, i: usize, mut body: impl FnMut(usize, &[u32], [T::Pack; 2], T::Pack, T::Pack)) {
        let stencil = Stencil::new(self.space, self.position, self.support, self.lists, i);
        stencil.for_each(|slot, index, d, square| body(slot, index, d, square, weight::<T>(square)));
    }
}

/// (2.2): the weighted mean of a field over the neighbours of every point.
pub fn average<T: Real, S: Space<T>>(means: Means<T, S>, field: &[T], out: &mut [T]) {
    let factor = T::Pack::splat(T::from_f64(1.0 / means.lattice.density));
    blocks::for_each(out, 1, &|block, out| {
        for first in (0..BLOCK).step_by(T::Pack::LANES) {
            let mut sum = T::Pack::zero();
            means.for_each(block * BLOCK + first, |_, index, _, _, weight| {
                // SAFETY: every stored neighbour is below the number of points.
                sum = weight.mul_add(unsafe { T::Pack::gather(field, index) }, sum);
            });
            (factor * sum).store(&mut out[first..]);
        }
    });
}

/// Fills the rows of (2.4).
pub fn assemble_integral_laplacian<T: Real, S: Space<T>>(means: Means<T, S>, row: &mut [T]) {
    let Lattice { density, spread } = means.lattice;
    let factor = T::Pack::splat(T::from_f64(2.0 * DIMENSIONS / (spread * density)));
    blocks::for_each(row, means.lists.capacity, &|block, out| {
        for first in (0..BLOCK).step_by(T::Pack::LANES) {
            means.for_each(block * BLOCK + first, |slot, _, _, _, weight| {
                (factor * weight).store(&mut out[slot * BLOCK + first..]);
            });
        }
    });
}

/// Fills the rows of (2.3).
pub fn assemble_integral_gradient<T: Real, S: Space<T>>(means: Means<T, S>, row: &mut [T]) {
    let slots = means.lists.capacity;
    let (scale, zero) = (T::Pack::splat(T::from_f64(DIMENSIONS / means.lattice.density)), T::Pack::zero());
    blocks::for_each(row, 2 * slots, &|block, out| {
        for first in (0..BLOCK).step_by(T::Pack::LANES) {
            let i = block * BLOCK + first;
            let per_support = T::Pack::splat(T::from_f64(1.0)) / T::Pack::load(&means.support[i..]);
            means.for_each(i, |slot, _, [x, y], square, weight| {
                let factor = square.select_above(zero, scale * weight * per_support / square, zero);
                (factor * x).store(&mut out[slot * BLOCK + first..]);
                (factor * y).store(&mut out[(slots + slot) * BLOCK + first..]);
            });
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand: at 2.1 spacings 4 neighbours at 1, 4 at the root of 2, 4 at 2.
    #[test]
    fn the_lattice_has_the_density_and_the_spread_computed_by_hand() {
        let weights = [1.1, 2.1 / 2.0_f64.sqrt() - 1.0, 0.05];
        let density = 4.0 * (weights[0] + weights[1] + weights[2]);
        let spread = 4.0 * (weights[0] * 1.0 + weights[1] * 2.0 + weights[2] * 4.0) / density;
        assert!((density - 6.539_697).abs() < 1e-6 && (spread - 1.388_351).abs() < 1e-6, "{density} {spread}");
        let lattice = Lattice::new(2.1, 1.0);
        assert!((lattice.density - density).abs() < 1e-14 && (lattice.spread - spread).abs() < 1e-14);
        // The same lattice in millimetres.
        let small = Lattice::new(2.1e-3, 1e-3);
        assert!((small.density - density).abs() < 1e-12 && (small.spread - 1e-6 * spread).abs() < 1e-18);
    }
}
