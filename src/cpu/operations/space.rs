//! The shape of the domain, as offsets and places see it: a rectangle between walls, or one that repeats.
//!
//! Along an axis that repeats after `L` the offset between two points is the shortest one, in `[-L/2, L/2]`, and a place `x`
//! stands for `x mod L`. Chosen once an operation: between walls neither costs anything. Units: m.

use glam::DVec2;

use crate::cpu::real::{Pack, Real};

/// What the operations ask of the domain.
pub trait Space<T: Real>: Copy + Send + Sync {
    /// The shortest way that `offset`, the difference of two places in the domain, stands for.
    fn shortest<P: Pack<T>>(self, offset: [P; 2]) -> [P; 2];

    /// The place that `place` stands for where the domain repeats. What is no number stays none.
    fn wrapped(self, place: [T; 2]) -> [T; 2];

    /// The same, or the nearest place in the domain where it ends.
    fn inside(self, place: [T; 2]) -> [T; 2];
}

/// A rectangle with walls all round.
#[derive(Debug, Clone, Copy)]
pub struct Walled<T> {
    size: [T; 2],
}

/// A rectangle that repeats along x, y or both.
#[derive(Debug, Clone, Copy)]
pub struct Periodic<T> {
    walls: Walled<T>,
    /// 0 along an axis that ends at walls.
    period: [T; 2],
    /// Its reciprocal, or 0, 1/m.
    per_period: [T; 2],
}

/// Either.
#[derive(Debug, Clone, Copy)]
pub enum Domain<T> {
    Walled(Walled<T>),
    Periodic(Periodic<T>),
}

impl<T: Real> Domain<T> {
    /// Of `size` along x and y, m; `period` is the same along an axis that repeats, 0 along another.
    pub fn new(size: DVec2, period: DVec2) -> Self {
        let walls = Walled { size: size.to_array().map(T::from_f64) };
        match period == DVec2::ZERO {
            true => Domain::Walled(walls),
            false => {
                let per_period = period.to_array().map(|length| if length > 0.0 { 1.0 / length } else { 0.0 });
                let [period, per_period] = [period.to_array(), per_period].map(|pair| pair.map(T::from_f64));
                Domain::Periodic(Periodic { walls, period, per_period })
            }
        }
    }
}

/// Calls `$body` with `$space` bound to the shape that `$domain` has.
#[macro_export]
#[doc(hidden)]
macro_rules! with_space {
    ($domain:expr, $space:ident => $body:expr) => {
        match $domain {
            $crate::cpu::operations::space::Domain::Walled($space) => $body,
            $crate::cpu::operations::space::Domain::Periodic($space) => $body,
        }
    };
}

/// The nearest place of `[0, length]`. Comparisons that leave NaN as it is: a lost velocity must be seen, not replaced by that
/// of a corner.
#[inline(always)]
fn clamp<T: Real>(x: T, length: T) -> T {
    match x {
        low if low < T::zero() => T::zero(),
        high if high > length => length,
        x => x,
    }
}

impl<T: Real> Space<T> for Walled<T> {
    #[inline(always)]
    fn shortest<P: Pack<T>>(self, offset: [P; 2]) -> [P; 2] {
        offset
    }

    #[inline(always)]
    fn wrapped(self, place: [T; 2]) -> [T; 2] {
        place
    }

    #[inline(always)]
    fn inside(self, [x, y]: [T; 2]) -> [T; 2] {
        [clamp(x, self.size[0]), clamp(y, self.size[1])]
    }
}

impl<T: Real> Space<T> for Periodic<T> {
    #[inline(always)]
    fn shortest<P: Pack<T>>(self, [x, y]: [P; 2]) -> [P; 2] {
        let along = |d: P, period: T| {
            let (half, period) = (P::splat(T::from_f64(0.5) * period), P::splat(period));
            let beyond = d.select_above(half, period, P::zero());
            let short = (-d).select_above(half, period, P::zero());
            d - beyond + short
        };
        [along(x, self.period[0]), along(y, self.period[1])]
    }

    #[inline(always)]
    fn wrapped(self, place: [T; 2]) -> [T; 2] {
        let along = |axis: usize| {
            let (x, period) = (place[axis], self.period[axis]);
            let within = x - period * (x * self.per_period[axis]).floor();
            // A rounding unit off either end.
            let off = within < T::zero() || within >= period;
            if period > T::zero() && off { T::zero() } else { within }
        };
        [along(0), along(1)]
    }

    #[inline(always)]
    fn inside(self, place: [T; 2]) -> [T; 2] {
        self.walls.inside(self.wrapped(place))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cloud;
    use crate::cpu::real::One;

    /// Along x it repeats after 2 m, along y it ends at 3 m.
    const SIZE: DVec2 = DVec2::new(2.0, 3.0);
    const PERIOD: DVec2 = DVec2::new(2.0, 0.0);

    #[test]
    fn offsets_are_those_of_the_host() {
        let Domain::Periodic(space) = Domain::<f64>::new(SIZE, PERIOD) else { panic!("it repeats") };
        for k in -19..=19 {
            let d = DVec2::splat(0.1 * f64::from(k));
            let [x, y] = space.shortest([One(d.x), One(d.y)]);
            assert_eq!(DVec2::new(x.0, y.0), cloud::shortest(d, PERIOD));
        }
    }

    #[test]
    fn places_come_back_round_the_period_and_stop_at_the_walls() {
        let Domain::Periodic(space) = Domain::<f32>::new(SIZE, PERIOD) else { panic!("it repeats") };
        assert_eq!(space.inside([-0.5, -0.5]), [1.5, 0.0]);
        assert_eq!(space.inside([9.25, 3.5]), [1.25, 3.0]);
        assert_eq!(space.inside([-1e-30, 1.0]), [0.0, 1.0]);
        assert!(space.inside([f32::NAN, f32::NAN]).iter().all(|x| x.is_nan()));
    }

    #[test]
    fn between_walls_offsets_stay_and_places_stop() {
        let Domain::Walled(space) = Domain::<f64>::new(SIZE, DVec2::ZERO) else { panic!("it ends") };
        let [x, y] = space.shortest([One(1.9), One(-2.9)]);
        assert_eq!([x.0, y.0], [1.9, -2.9]);
        assert_eq!(space.inside([2.5, -1.0]), [2.0, 0.0]);
        assert!(space.inside([f64::NAN, 1.0])[0].is_nan());
    }
}
