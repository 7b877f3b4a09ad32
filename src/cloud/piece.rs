//! Pieces of outlines: straight ones, and those of ellipses, circles among them. A place of a piece is counted by `t` from 0
//! to 1, not in lengths. Units: m, m^2.

use std::f64::consts::TAU;

use glam::DVec2;

/// Places looked at for the one nearest to a place, and halvings from there.
const LOOKS: usize = 16;
const HALVINGS: usize = 52;

/// A piece of a closed curve, run through from `t = 0` to `t = 1`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Piece {
    Straight(DVec2, DVec2),
    /// `centre + turn * (a cos s, b sin s)`, `s` from `from` to `to`, either of them the larger.
    Bow {
        centre: DVec2,
        axes: DVec2,
        /// Direction of the first axis.
        turn: DVec2,
        from: f64,
        to: f64,
    },
}

impl Piece {
    pub fn at(&self, t: f64) -> DVec2 {
        match *self {
            Piece::Straight(from, to) => from + t * (to - from),
            Piece::Bow { centre, axes, turn, from, to } => {
                centre + (axes * DVec2::from_angle(from + t * (to - from))).rotate(turn)
            }
        }
    }

    /// Change of the place over that of `t`.
    pub fn velocity(&self, t: f64) -> DVec2 {
        match *self {
            Piece::Straight(from, to) => to - from,
            Piece::Bow { axes, turn, from, to, .. } => {
                (to - from) * (axes * DVec2::from_angle(from + t * (to - from)).perp()).rotate(turn)
            }
        }
    }

    /// The part from `begin` to `end`.
    pub fn part(&self, begin: f64, end: f64) -> Self {
        match *self {
            Piece::Straight(..) => Piece::Straight(self.at(begin), self.at(end)),
            Piece::Bow { centre, axes, turn, from, to } => {
                Piece::Bow { centre, axes, turn, from: from + begin * (to - from), to: from + end * (to - from) }
            }
        }
    }

    /// The same the other way.
    pub fn reversed(&self) -> Self {
        self.part(1.0, 0.0)
    }

    /// `(1/2) int p x dp`: over the pieces of a closed curve the area that it goes round anticlockwise.
    pub fn swept(&self) -> f64 {
        match *self {
            Piece::Straight(from, to) => 0.5 * from.perp_dot(to),
            Piece::Bow { centre, axes, from, to, .. } => {
                0.5 * (axes.x * axes.y * (to - from) + centre.perp_dot(self.at(1.0) - self.at(0.0)))
            }
        }
    }

    /// Distance of a place from the piece.
    pub fn distance(&self, place: DVec2) -> f64 {
        match *self {
            Piece::Straight(from, to) => {
                let (along, way) = (to - from, place - from);
                let share = (way.dot(along) / along.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
                (way - share * along).length()
            }
            Piece::Bow { .. } => self.at(self.nearest(place)).distance(place),
        }
    }

    /// Whether it ends where it begins, and goes on there.
    fn is_closed(&self) -> bool {
        matches!(*self, Piece::Bow { from, to, .. } if (to - from).abs() >= (1.0 - 1e-12) * TAU)
    }

    /// The place of a bow nearest to another, by `t`.
    fn nearest(&self, place: DVec2) -> f64 {
        let looked = (0..=LOOKS).map(|k| k as f64 / LOOKS as f64);
        let square = |t: f64| self.at(t).distance_squared(place);
        let best = looked.min_by(|a, b| square(*a).total_cmp(&square(*b))).unwrap_or_default();
        let recedes = |t: f64| (self.at(t) - place).dot(self.velocity(t)) > 0.0;
        let (mut low, mut high) = (best - 1.0 / LOOKS as f64, best + 1.0 / LOOKS as f64);
        if !self.is_closed() {
            (low, high) = (low.max(0.0), high.min(1.0));
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            (low, high) = if recedes(middle) { (low, middle) } else { (middle, high) };
        }
        0.5 * (low + high)
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use super::*;

    fn bow(axes: DVec2, from: f64, to: f64) -> Piece {
        Piece::Bow { centre: DVec2::new(2.0, 1.0), axes, turn: DVec2::from_angle(0.3), from, to }
    }

    #[test]
    fn distances_from_bows_are_exact() {
        let quarter = bow(DVec2::splat(0.5), 0.0, FRAC_PI_2);
        let at = |angle: f64, radius: f64| DVec2::new(2.0, 1.0) + radius * DVec2::from_angle(0.3 + angle);
        for (angle, radius) in [(0.1, 0.2), (0.7, 0.5), (1.5, 1.7)] {
            assert!((quarter.distance(at(angle, radius)) - (radius - 0.5_f64).abs()).abs() < 1e-14);
        }
        // Beyond its ends the end is nearest.
        assert!((quarter.distance(at(-1.0, 0.5)) - (2.0_f64 * (1.0 - 1.0_f64.cos())).sqrt() * 0.5).abs() < 1e-14);
        // A place off an ellipse along its normal.
        let ellipse = bow(DVec2::new(0.5, 0.2), 0.0, TAU);
        for t in [0.01, 0.05, 0.31, 0.64, 0.93, 0.98] {
            let outward = -ellipse.velocity(t).perp().normalize();
            for way in [0.3, 0.01, 0.0, -0.02] {
                let found = ellipse.distance(ellipse.at(t) + way * outward);
                assert!((found - way.abs()).abs() < 1e-12, "{t}, {way}: {found}");
            }
        }
    }

    #[test]
    fn areas_and_parts_add_up() {
        let ellipse = bow(DVec2::new(0.5, 0.2), 0.0, TAU);
        assert!((ellipse.swept() - PI * 0.1).abs() < 1e-15);
        assert!((ellipse.reversed().swept() + PI * 0.1).abs() < 1e-15);
        let cuts = [0.0, 0.2, 0.7, 1.0];
        let parts: f64 = cuts.windows(2).map(|pair| ellipse.part(pair[0], pair[1]).swept()).sum();
        assert!((parts - PI * 0.1).abs() < 1e-14);
    }
}
