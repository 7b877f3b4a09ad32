//! Fields whose value and derivatives are known at every place: what operators and the pressure equation are measured against.

use std::f64::consts::PI;

use glam::DVec2;

use crate::case::{Case, Field, Problem};

/// One field on a rectangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Known {
    field: Field,
    /// Along x and y, 1/m.
    wave_number: DVec2,
}

impl Known {
    /// The field of a case's problem; `None` for a flow.
    pub fn of(case: &Case) -> Option<Self> {
        match case.problem() {
            Problem::Flow => None,
            Problem::Derivatives(field) | Problem::Poisson(field) => {
                Some(Self::new(field, DVec2::new(case.domain.width, case.domain.height)))
            }
        }
    }

    /// `size` is the rectangle's, m.
    pub fn new(field: Field, size: DVec2) -> Self {
        let waves = match field {
            Field::Waves => 2.0 * PI,
            Field::Cosines => PI,
        };
        Self { field, wave_number: waves / size }
    }

    /// No unit.
    pub fn value(&self, place: DVec2) -> f64 {
        let at = self.wave_number * place;
        match self.field {
            Field::Waves => at.x.sin() * at.y.cos(),
            Field::Cosines => at.x.cos() * at.y.cos(),
        }
    }

    /// 1/m
    pub fn gradient(&self, place: DVec2) -> DVec2 {
        let at = self.wave_number * place;
        self.wave_number
            * match self.field {
                Field::Waves => DVec2::new(at.x.cos() * at.y.cos(), -at.x.sin() * at.y.sin()),
                Field::Cosines => DVec2::new(-at.x.sin() * at.y.cos(), -at.x.cos() * at.y.sin()),
            }
    }

    /// 1/m^2
    pub fn laplacian(&self, place: DVec2) -> f64 {
        -self.wave_number.length_squared() * self.value(place)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_are_those_of_the_value() {
        let (size, h) = (DVec2::new(1.0, 2.5), 1e-4);
        for field in [Field::Waves, Field::Cosines] {
            let known = Known::new(field, size);
            for k in 0..30 {
                let place = DVec2::new(0.033 * f64::from(k), 2.4 - 0.07 * f64::from(k));
                let at = |x: f64, y: f64| known.value(place + h * DVec2::new(x, y));
                let gradient = DVec2::new(at(1.0, 0.0) - at(-1.0, 0.0), at(0.0, 1.0) - at(0.0, -1.0)) / (2.0 * h);
                let around = at(1.0, 0.0) + at(-1.0, 0.0) + at(0.0, 1.0) + at(0.0, -1.0);
                assert!((gradient - known.gradient(place)).length() < 1e-5, "{field:?}");
                assert!(((around - 4.0 * at(0.0, 0.0)) / (h * h) - known.laplacian(place)).abs() < 1e-4, "{field:?}");
            }
        }
    }

    #[test]
    fn waves_repeat_and_cosines_are_level_at_the_walls() {
        let size = DVec2::new(1.0, 2.5);
        let (waves, cosines) = (Known::new(Field::Waves, size), Known::new(Field::Cosines, size));
        for k in 0..20 {
            let s = 0.05 * f64::from(k);
            let place = DVec2::new(s, 2.5 * s);
            assert!((waves.value(place) - waves.value(place + size)).abs() < 1e-12);
            for x in [0.0, 1.0] {
                assert!(cosines.gradient(DVec2::new(x, place.y)).x.abs() < 1e-12);
                assert!(cosines.gradient(DVec2::new(place.x, 2.5 * x)).y.abs() < 1e-12);
            }
        }
    }
}
