//! Derivatives as sums over neighbours, made once where the points stand: the factors of each neighbour's difference.
//!
//! Continuous: `lap phi`, `grad phi`. Discrete: `lap phi = sum_j l_ij (phi_j - phi_i)`, `grad phi = sum_j g_ij (phi_j - phi_i)`.
//! The least-squares fit (2.5) of the paper is linear in the field: with `N a = sum_j w_j b_j (phi_j - phi_i)`, `N` its normal
//! matrix and `b_j` the monomials at `d_ij / r_e`, a derivative `c . a` has the factors `w_j (N^-1 c) . b_j`; (2.6).
//! Shapes: `capacity` slots a point, blocked, as the neighbours; twice as many for the gradient. Units: 1/m^2, 1/m.

use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::operations::fits::Fits;
use crate::cpu::operations::moments::{self, COEFFICIENTS, WeightFunction};
use crate::cpu::operations::space::Space;
use crate::cpu::real::{Pack, Real};

/// The neighbours of every point, slot by slot as the rows are.
#[derive(Clone, Copy)]
pub struct Lists<'a> {
    pub neighbours: &'a [u32],
    pub count: &'a [u32],
    pub capacity: usize,
}

impl Lists<'_> {
    /// Calls `body(slot, indexes)` for every slot of the points `i..i + LANES`; unused slots hold the point itself.
    #[inline(always)]
    pub fn for_each<T: Real>(&self, i: usize, mut body: impl FnMut(usize, &[u32])) {
        let rows = self.count[i..i + T::Pack::LANES].iter().copied().max().unwrap_or(0) as usize;
        let first = blocks::at(i, 0, self.capacity);
        for slot in 0..rows.min(self.capacity) {
            let start = first + slot * BLOCK;
            body(slot, &self.neighbours[start..start + T::Pack::LANES]);
        }
    }
}

/// Fills the rows of the fitted Laplacian: `lap phi = 2 (a3 + a5) / r_e^2`.
pub fn assemble_laplacian<T: Real, W: WeightFunction, S: Space<T>>(fits: Fits<T, W, S>, row: &mut [T]) {
    let slots = fits.capacity;
    let (two, zero) = (T::Pack::splat(T::from_f64(2.0)), T::Pack::zero());
    blocks::for_each(row, slots, &|block, out| {
        for first in (0..BLOCK).step_by(T::Pack::LANES) {
            let i = block * BLOCK + first;
            let stencil = fits.stencil(i);
            let second = two * stencil.per_support * stencil.per_support;
            let c = moments::solve(&fits.factor(i), [zero, zero, second, zero, second]);
            let mut place = first;
            stencil.for_each(|_, [x, y], square| {
                (fits.weight.weight(square) * dot(&c, moments::basis(x, y))).store(&mut out[place..]);
                place += BLOCK;
            });
        }
    });
}

/// Fills the rows of the fitted gradient: `grad phi = (a1, a2) / r_e`.
pub fn assemble_gradient<T: Real, W: WeightFunction, S: Space<T>>(fits: Fits<T, W, S>, row: &mut [T]) {
    let slots = fits.capacity;
    let zero = T::Pack::zero();
    blocks::for_each(row, 2 * slots, &|block, out| {
        for first in (0..BLOCK).step_by(T::Pack::LANES) {
            let i = block * BLOCK + first;
            let (stencil, factor) = (fits.stencil(i), fits.factor(i));
            let per = stencil.per_support;
            let along = [[per, zero, zero, zero, zero], [zero, per, zero, zero, zero]];
            let c = along.map(|along| moments::solve(&factor, along));
            let mut place = first;
            stencil.for_each(|_, [x, y], square| {
                let (weight, basis) = (fits.weight.weight(square), moments::basis(x, y));
                (weight * dot(&c[0], basis)).store(&mut out[place..]);
                (weight * dot(&c[1], basis)).store(&mut out[slots * BLOCK + place..]);
                place += BLOCK;
            });
        }
    });
}

#[inline(always)]
fn dot<P: Copy>(c: &[P; COEFFICIENTS], b: [P; COEFFICIENTS]) -> P
where
    P: std::ops::Mul<Output = P> + std::ops::Add<Output = P>,
{
    (1..COEFFICIENTS).fold(c[0] * b[0], |sum, k| sum + c[k] * b[k])
}
