//! Advection by moving the points and carrying the fields back (the paper's section 5).
//!
//! Continuous: `Du/Dt` along the path of a fluid point. Discrete: the values `u'` live at the places the fluid moved
//! to; a fit (2.5) there is evaluated where the points stand.

use crate::cpu::blocks::{self, BLOCK};
use crate::cpu::operations::moments;
use crate::cpu::operations::space::Space;
use crate::cpu::real::{One, Real};

/// A velocity and its fits, by which places are traced back and evaluated.
#[derive(Clone, Copy)]
pub struct Moving<'a, T, S> {
    pub space: S,
    pub position: &'a [T],
    pub support: &'a [T],
    pub values: &'a [T],
    pub coefficients: &'a [T],
    /// Where on the way back the velocity is taken: 1, or 1/2 of one that is prescribed; see [`Moving::departure`].
    pub trace: T,
}

impl<T: Real, S: Space<T>> Moving<'_, T, S> {
    /// Where point `i` stands.
    #[inline(always)]
    pub fn place(&self, i: usize) -> [T; 2] {
        [self.position[2 * i], self.position[2 * i + 1]]
    }

    /// The fit of point `j` at `place`.
    #[inline(always)]
    pub fn evaluate<const N: usize>(&self, j: usize, place: [T; 2]) -> [T; 2] {
        evaluate::<T, S, N>(self.space, self.position, self.support, self.values, self.coefficients, j, place)
    }

    /// Where the fluid at point `i` was `dt` before: `r0 - dt u`. Between two kicks fluid keeps its velocity, which is that at the
    /// departure point itself, to second order; of a prescribed velocity it is that half way (the midpoint rule).
    #[inline(always)]
    pub fn departure<const N: usize>(&self, i: usize, dt: T) -> [T; 2] {
        let here = self.place(i);
        let back = |[u, v]: [T; 2]| self.space.inside([here[0] - dt * u, here[1] - dt * v]);
        let [u, v] = [self.values[2 * i], self.values[2 * i + 1]];
        back(self.evaluate::<N>(i, back([self.trace * u, self.trace * v])))
    }

    /// The point nearest to `place`, found from `from`.
    #[inline(always)]
    pub fn nearest(&self, around: Around, place: [T; 2], from: usize) -> usize {
        nearest(self.space, self.position, around, place, from)
    }
}

/// Departure-point remap: the fit of the point nearest to where the fluid at a standing point came from is evaluated there.
pub fn remap_departure<T: Real, S: Space<T>, const N: usize>(
    moving: Moving<T, S>,
    around: Around,
    dt: T,
    end: usize,
    velocity: &mut [T],
) {
    blocks::for_each(velocity, 2, &|block, out| {
        for i in block * BLOCK..((block + 1) * BLOCK).min(end) {
            let from = moving.departure::<N>(i, dt);
            let value = moving.evaluate::<N>(moving.nearest(around, from, i), from);
            let lane = 2 * (i - block * BLOCK);
            out[lane..lane + 2].copy_from_slice(&value);
        }
    });
}

/// The fit of point `j` at `place`: its value and its `N` coefficients.
#[inline(always)]
fn evaluate<T: Real, S: Space<T>, const N: usize>(
    space: S,
    position: &[T],
    support: &[T],
    values: &[T],
    coefficients: &[T],
    j: usize,
    place: [T; 2],
) -> [T; 2] {
    let per = T::from_f64(1.0) / support[j];
    let [x, y] = offset(space, position, j, place);
    let basis: [One<T>; N] = moments::basis(One(x * per), One(y * per));
    let first = blocks::at(j, 0, 2 * N);
    let (mut u, mut v) = (values[2 * j], values[2 * j + 1]);
    for (k, term) in basis.into_iter().enumerate() {
        u += coefficients[first + k * BLOCK] * term.0;
        v += coefficients[first + (N + k) * BLOCK] * term.0;
    }
    [u, v]
}

/// The way from point `j` to `place`.
#[inline(always)]
pub fn offset<T: Real, S: Space<T>>(space: S, position: &[T], j: usize, place: [T; 2]) -> [T; 2] {
    let [x, y] = space.shortest([One(place[0] - position[2 * j]), One(place[1] - position[2 * j + 1])]);
    [x.0, y.0]
}

/// The points around each point: its neighbours, or those across the faces of its Voronoi cell, which suffice to walk from any
/// point to the one nearest to a place.
#[derive(Clone, Copy)]
pub struct Around<'a> {
    pub neighbours: &'a [u32],
    pub count: &'a [u32],
    pub capacity: usize,
}

/// The point nearest to `place`, found by walking from point to nearer neighbour, beginning at `from`.
#[inline(always)]
fn nearest<T: Real, S: Space<T>>(space: S, position: &[T], around: Around, place: [T; 2], from: usize) -> usize {
    let square = |j: usize| {
        let [dx, dy] = offset(space, position, j, place);
        dx * dx + dy * dy
    };
    let (mut at, mut least) = (from, square(from));
    loop {
        let mut next = at;
        let first = blocks::at(at, 0, around.capacity);
        for slot in 0..(around.count[at] as usize).min(around.capacity) {
            let j = around.neighbours[first + slot * BLOCK] as usize;
            let distance = square(j);
            if distance < least {
                (next, least) = (j, distance);
            }
        }
        if next == at {
            return at;
        }
        at = next;
    }
}

/// Moves the interior points with the flow: `r' = r0 + dt u'`, and round where the domain repeats; walls stand.
pub fn move_points<T: Real, S: Space<T>>(
    space: S,
    standing: &[T],
    velocity: &[T],
    dt: T,
    interior: usize,
    moved: &mut [T],
) {
    blocks::for_each(moved, 2, &|block, out| {
        for (lane, place) in out.chunks_exact_mut(2).enumerate() {
            let k = 2 * (block * BLOCK + lane);
            let here = [standing[k], standing[k + 1]];
            let there = [here[0] + dt * velocity[k], here[1] + dt * velocity[k + 1]];
            place.copy_from_slice(&if k < 2 * interior { space.wrapped(there) } else { here });
        }
    });
}

/// The paper's remap: the fit of each moved point, evaluated at its standing place `r0`, that is at `r0 - r'`.
pub fn remap_forward<T: Real, S: Space<T>, const N: usize>(
    space: S,
    standing: &[T],
    moved: &[T],
    support: &[T],
    values: &[T],
    coefficients: &[T],
    interior: usize,
    velocity: &mut [T],
) {
    blocks::for_each(velocity, 2, &|block, out| {
        for i in block * BLOCK..((block + 1) * BLOCK).min(interior) {
            let place = [standing[2 * i], standing[2 * i + 1]];
            let value = evaluate::<T, S, N>(space, moved, support, values, coefficients, i, place);
            let lane = 2 * (i - block * BLOCK);
            out[lane..lane + 2].copy_from_slice(&value);
        }
    });
}
