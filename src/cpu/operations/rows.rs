//! Derivatives as sums over neighbours, made once where the points stand: the factors of each neighbour's difference.
//!
//! Continuous: `lap phi`, `grad phi`. Discrete: `lap phi = sum_j l_ij (phi_j - phi_i)`, `grad phi = sum_j g_ij (phi_j - phi_i)`.
//! The least-squares fit (2.5) of the paper is linear in the field: with `N a = sum_j w_j b_j (phi_j - phi_i)`, `N` its normal
//! matrix and `b_j` the monomials at `d_ij / r_e`, a derivative `c . a` has the factors `w_j (N^-1 c) . b_j`; (2.6).
//! Shapes: `capacity` slots a point, blocked, as the neighbours; twice as many for the gradient. Units: 1/m^2, 1/m.

use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::operations::fits::Fits;
use crate::cpu::operations::moments;
use crate::cpu::operations::space::Space;
use crate::cpu::real::{Pack, Real};

/// Fills the rows of the fitted Laplacian: `lap phi = 2 (a3 + a5) / r_e^2`.
///
/// # Panics
/// With a fit of order 1, which has no second derivatives; no plan asks for it.
pub fn assemble_laplacian<T: Real, S: Space<T>, const N: usize, const F: usize>(fits: Fits<T, S, N, F>, row: &mut [T]) {
    let slots = fits.lists.capacity;
    blocks::for_each(row, slots, &|block, out| {
        for first in (0..BLOCK).step_by(T::Pack::LANES) {
            let i = block * BLOCK + first;
            let stencil = fits.stencil(i);
            let mut of = [T::Pack::zero(); N];
            of[2] = T::Pack::splat(T::from_f64(2.0)) * stencil.per_support * stencil.per_support;
            of[4] = of[2];
            let c = moments::solve(&fits.factor(i), of);
            stencil.for_each(|slot, _, [x, y], square| {
                let factor = moments::weight(fits.weight, square) * dot(&c, moments::basis(x, y));
                factor.store(&mut out[slot * BLOCK + first..]);
            });
        }
    });
}

/// Fills the rows of the fitted gradient: `grad phi = (a1, a2) / r_e`.
pub fn assemble_gradient<T: Real, S: Space<T>, const N: usize, const F: usize>(fits: Fits<T, S, N, F>, row: &mut [T]) {
    let slots = fits.lists.capacity;
    blocks::for_each(row, 2 * slots, &|block, out| {
        for first in (0..BLOCK).step_by(T::Pack::LANES) {
            let i = block * BLOCK + first;
            let (stencil, factor) = (fits.stencil(i), fits.factor(i));
            let c = [0, 1].map(|axis| {
                let mut of = [T::Pack::zero(); N];
                of[axis] = stencil.per_support;
                moments::solve(&factor, of)
            });
            stencil.for_each(|slot, _, [x, y], square| {
                let (weight, basis) = (moments::weight(fits.weight, square), moments::basis(x, y));
                (weight * dot(&c[0], basis)).store(&mut out[slot * BLOCK + first..]);
                (weight * dot(&c[1], basis)).store(&mut out[(slots + slot) * BLOCK + first..]);
            });
        }
    });
}

#[inline(always)]
fn dot<T: Real, P: Pack<T>, const N: usize>(c: &[P; N], b: [P; N]) -> P {
    (1..N).fold(c[0] * b[0], |sum, k| c[k].mul_add(b[k], sum))
}
