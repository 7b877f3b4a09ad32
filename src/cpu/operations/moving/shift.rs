//! The shift: points move apart where they stand closer than elsewhere, and the fields are carried to where they go.
//!
//! Continuous: none; the fluid stays what it is, only where it is looked at changes. Discrete:
//! `delta_i = strength l0 sum_j -(d_ij / |d_ij|) (1 - |d_ij| / r_s)^2` over `|d_ij| < r_s`, zero on a lattice, at most
//! [`LONGEST`] spacings. At the surface its part along the normal is left out, which would make the fluid swell; beside the
//! surface it is that of points closer than one spacing alone. Steps shorter than usual take a share of it, see [`crate::engine::Clock::share`]. `u(r + delta)` is that of the fit (2.5).
//! Sources: Xu, Stansby and Laurence, J. Comput. Phys. 228 (2009) 6703-6725; Lind et al., J. Comput. Phys. 231 (2012)
//! 1499-1523 (free surfaces).

use super::N;
use super::fits::coefficient;
use super::mirror::{Around, Shore, Stencil};
use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::operations::moments;
use crate::cpu::real::{Pack, Real};

/// Radius of the shift's neighbourhood, `r_s`, in spacings.
pub const REACH: f64 = 2.1;
/// `strength` of a step.
pub const STRENGTH: f64 = 0.2;
/// Share by which two points closer than a spacing part beside the surface.
pub const PARTING: f64 = 0.25;
/// Longest shift of a step, in spacings.
pub const LONGEST: f64 = 0.1;

/// Adds `share` of the shift to the displacement, and to `projected` what the velocity changes along it, at the points below `interior`.
pub fn shift<T: Real>(
    around: Around<T>,
    spacing: T,
    share: T,
    surface: &[u32],
    coefficients: &[T],
    interior: usize,
    projected: &mut [T],
    displacement: &mut [T],
) {
    let constant = |value: f64| T::Pack::splat(T::from_f64(value));
    let (zero, one) = (T::Pack::zero(), constant(1.0));
    let tiny = constant(1e-12);
    let in_spacings = T::Pack::splat(around.mirrors.radius / spacing);
    blocks::for_each_2((projected, 2), (displacement, 2), &|block, projected, displacement| {
        for i in blocks::packs::<T>(block, interior) {
            let stencil = Stencil::new(around, i);
            let (mut full, mut parting, mut normal) = ([zero; 2], [zero; 2], [zero; 2]);
            let mut shore = Shore::default();
            stencil.for_each(|near| {
                let distance = near.square.max(tiny).sqrt();
                let spacings = distance * in_spacings;
                let even = (one - spacings * constant(1.0 / REACH)).max(zero);
                let close = (one - spacings).max(zero);
                let rest = (one - near.square).max(zero);
                let per_distance = near.counts / distance;
                let weights = [even * even, close, rest * rest].map(|weight| weight * per_distance);
                for axis in 0..2 {
                    full[axis] -= weights[0] * near.offset[axis];
                    parting[axis] -= weights[1] * near.offset[axis];
                    normal[axis] -= weights[2] * near.offset[axis];
                }
                shore.meet(surface, near.index);
            });
            let own = T::Pack::from_lanes(|lane| T::from_f64(f64::from(surface[i + lane])));
            let length = (normal[0] * normal[0] + normal[1] * normal[1]).max(tiny).sqrt();
            let normal = normal.map(|n| n / length);
            let along = |v: [T::Pack; 2]| v[0] * normal[0] + v[1] * normal[1];
            let full = full.map(|d| d * constant(STRENGTH));
            let parting = parting.map(|d| d * constant(PARTING));
            // Along the normal: all inside, of close points beside the surface, nothing on it.
            let beside = (own + shore.beside::<T>()).select_above(zero, along(parting) - along(full), zero);
            let change = own.select_above(zero, -along(full), beside);
            let mut delta = [0, 1].map(|axis| full[axis] + change * normal[axis]);
            let length = (delta[0] * delta[0] + delta[1] * delta[1]).max(tiny).sqrt();
            let scale = length.select_above(constant(LONGEST), constant(LONGEST) / length, one);
            delta = delta.map(|d| d * scale * T::Pack::splat(share * spacing));
            let [x, y] = delta.map(|d| d * stencil.per_radius);
            let basis: [T::Pack; N] = moments::basis(x, y);
            let carried = [0, 1]
                .map(|axis| (0..N).fold(zero, |sum, k| coefficient(coefficients, i, axis, k).mul_add(basis[k], sum)));
            blocks::add_vectors::<T>(projected, block * BLOCK, i, interior, carried);
            blocks::add_vectors::<T>(displacement, block * BLOCK, i, interior, delta);
        }
    });
}
