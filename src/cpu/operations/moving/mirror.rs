//! Walls as mirrors: beside a wall every point has an image behind it, and sums over neighbours run over the images too.
//!
//! The image of `(x, y)` behind the wall at `x = w` is `(2 w - x, y)`; in a corner there is one behind each wall and one behind
//! both. A velocity's image has its part across the wall turned round, so that fluid slips along the wall and never passes
//! it; a pressure's image is as much higher as gravity makes it. An image is never nearer than its point, so that the
//! list of neighbours has every point whose image counts. Source: Monaghan, J. Comput. Phys. 110 (1994) 399-406, for the
//! idea of wall images in particle methods.

use crate::cpu::blocks::BLOCK;
use crate::cpu::operations::lists::Lists;
use crate::cpu::real::{Pack, Real};

/// A rectangle whose four walls mirror, or one without mirrors.
#[derive(Debug, Clone, Copy)]
pub struct Mirrors<T> {
    /// Width and height, m.
    pub size: [T; 2],
    /// Radius of a neighbourhood, m.
    pub radius: T,
    /// False where walls are made of points.
    pub present: bool,
}

/// The points, their neighbours and the mirrors.
#[derive(Clone, Copy)]
pub struct Around<'a, T> {
    pub position: &'a [T],
    pub lists: Lists<'a>,
    pub mirrors: Mirrors<T>,
}

/// One neighbour of a pack of points, or its image.
pub struct Neighbour<'a, P> {
    /// Its slot in the list; [`OWN`] for the image of the point itself.
    pub slot: usize,
    pub index: &'a [u32],
    /// Offset and its square, over the radius.
    pub offset: [P; 2],
    pub square: P,
    /// The axes along which it is an image.
    pub flipped: [bool; 2],
    /// From the point to its image, m; zero for the point itself.
    pub way: [P; 2],
    /// 1 where the neighbour counts, 0 in unused slots and beyond the radius; 1 everywhere for points themselves.
    pub counts: P,
}

/// The slot of a point's own image.
pub const OWN: usize = usize::MAX;

/// A pack of points that looks at its neighbours and at the images.
pub struct Stencil<'a, T: Real> {
    around: Around<'a, T>,
    i: usize,
    own: [T::Pack; 2],
    /// `1 / r_e`, 1/m.
    pub per_radius: T::Pack,
    /// Twice the nearest wall's coordinate along x and y, m; far away for points that see none.
    twice: [T::Pack; 2],
    /// Whether any of the points sees a wall across x, across y.
    sees: [bool; 2],
}

impl<'a, T: Real> Stencil<'a, T> {
    /// The points `i..i + LANES`.
    #[inline(always)]
    pub fn new(around: Around<'a, T>, i: usize) -> Self {
        let own = T::Pack::load_vectors(&around.position[2 * i..]);
        let Mirrors { size, radius, present } = around.mirrors;
        // Beyond every neighbourhood, and still exact enough in f32.
        let far = T::from_f64(-64.0) * (radius + size[0] + size[1]);
        let wall = |axis: usize| {
            let (x, end) = (own[axis], T::Pack::splat(size[axis]));
            let reach = T::Pack::splat(if present { radius } else { T::zero() });
            let high = reach.select_above(end - x, end + end, T::Pack::splat(far));
            (reach.select_above(x, T::Pack::zero(), high), reach.above(x) | reach.above(end - x) != 0)
        };
        let (across_x, across_y) = (wall(0), wall(1));
        let (twice, sees) = ([across_x.0, across_y.0], [present && across_x.1, present && across_y.1]);
        let per_radius = T::Pack::splat(T::from_f64(1.0) / radius);
        Self { around, i, own, per_radius, twice, sees }
    }

    /// Whether any of the points has images around it.
    #[inline(always)]
    pub fn sees_walls(&self) -> bool {
        self.sees[0] || self.sees[1]
    }

    /// Calls `body` for every slot, each followed by its images, then for the images of the points themselves.
    #[inline(always)]
    pub fn for_each(&self, mut body: impl FnMut(Neighbour<'_, T::Pack>)) {
        let one = T::Pack::splat(T::from_f64(1.0));
        let zero = T::Pack::zero();
        let images = self.sees_walls();
        self.around.lists.for_each::<T>(self.i, |slot, index| {
            // SAFETY: every stored neighbour is below the number of points.
            let place = unsafe { T::Pack::gather_vectors(self.around.position, index) };
            let offset = [(place[0] - self.own[0]) * self.per_radius, (place[1] - self.own[1]) * self.per_radius];
            let square = offset[0] * offset[0] + offset[1] * offset[1];
            let way = [zero; 2];
            body(Neighbour { slot, index, offset, square, flipped: [false; 2], way, counts: one });
            if images {
                self.images(slot, index, place, square, &mut body);
            }
        });
        if images {
            let own: [u32; BLOCK] = std::array::from_fn(|lane| (self.i + lane) as u32);
            self.images(OWN, &own[..T::Pack::LANES], self.own, one, &mut body);
        }
    }

    /// The images of one neighbour; `square` is zero where the slot is unused.
    #[inline(always)]
    fn images(
        &self,
        slot: usize,
        index: &[u32],
        place: [T::Pack; 2],
        square: T::Pack,
        body: &mut impl FnMut(Neighbour<'_, T::Pack>),
    ) {
        let one = T::Pack::splat(T::from_f64(1.0));
        let zero = T::Pack::zero();
        let used = square.select_above(zero, one, zero);
        let [across_x, across_y] = self.sees;
        for (flipped, seen) in
            [([true, false], across_x), ([false, true], across_y), ([true, true], across_x && across_y)]
        {
            if seen {
                let way = [0, 1].map(|axis| match flipped[axis] {
                    true => self.twice[axis] - place[axis] - place[axis],
                    false => zero,
                });
                let offset = [0, 1].map(|axis| (place[axis] + way[axis] - self.own[axis]) * self.per_radius);
                let square = offset[0] * offset[0] + offset[1] * offset[1];
                let counts = square.select_above(one, zero, used);
                if counts.above(zero) == 0 {
                    continue;
                }
                body(Neighbour { slot, index, offset, square, flipped, way, counts });
            }
        }
    }
}

impl<P: Copy + std::ops::Neg<Output = P>> Neighbour<'_, P> {
    /// The image of a velocity.
    #[inline(always)]
    pub fn mirrored(&self, velocity: [P; 2]) -> [P; 2] {
        [0, 1].map(|axis| if self.flipped[axis] { -velocity[axis] } else { velocity[axis] })
    }

    /// True for a point itself, not an image.
    #[inline(always)]
    pub fn is_point(&self) -> bool {
        self.flipped == [false; 2]
    }
}

/// Whether the points of a pack have a neighbour on the surface.
#[derive(Default)]
pub struct Shore([u32; BLOCK]);

impl Shore {
    /// Takes the neighbours of one slot; `surface` is 1 at the points of the surface.
    #[inline(always)]
    pub fn meet(&mut self, surface: &[u32], index: &[u32]) {
        for (met, &j) in self.0.iter_mut().zip(index) {
            *met |= surface[j as usize];
        }
    }

    /// 1 where one has been met, 0 elsewhere.
    #[inline(always)]
    pub fn beside<T: Real>(&self) -> T::Pack {
        T::Pack::from_lanes(|lane| T::from_f64(f64::from(self.0[lane])))
    }
}
