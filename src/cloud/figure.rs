//! A figure made of parts, each added to those before it, taken from them, or cut with them, and its signed distance.
//!
//! Continuous: `d(x)` is the distance of `x` from the outline, negative inside. That of a union is the lesser of two distances outside
//! and not inside, that of a cut the other way round (Quilez, distfunctions2d, 2020); so the outline is made first and distances are
//! taken from it: exact everywhere. A place of a part's outline is one of the figure's where the figure would end there, were the
//! part all there is: where what is just inside the part is in the figure and what is just outside is not, or the other way.
//! Units: m, m^2.

use glam::DVec2;

use super::piece::Piece;
use crate::case::{Combine, Part};

/// Places looked at along every piece of a part, and halvings between two of them.
const LOOKS: usize = 512;
const HALVINGS: usize = 60;
/// How far from the ends of a piece the first and the last of them lie.
const OFF: f64 = 1e-7;
/// How far apart ends that meet may lie, over the size of the figure.
const MEETS: f64 = 1e-9;
/// Least turn, radians, that is a corner.
const CORNER: f64 = 0.05;

/// A closed figure without holes.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    parts: Vec<Part>,
    /// Its outline, anticlockwise.
    outline: Vec<Piece>,
    /// What is wrong with it.
    fault: Option<&'static str>,
}

/// Pieces from one corner of an outline to the next; a place among them is counted by `s`, whole at every joint.
pub(super) struct Run<'a>(&'a [Piece]);

impl Figure {
    pub fn new(parts: &[Part]) -> Self {
        let mut figure = Self { parts: parts.to_vec(), outline: Vec::new(), fault: None };
        let pieces: Vec<Piece> = (0..parts.len()).flat_map(|part| figure.seen_of(part)).collect();
        match closed(pieces) {
            Ok(outline) => figure.outline = outline,
            Err((pieces, fault)) => (figure.outline, figure.fault) = (pieces, Some(fault)),
        }
        figure
    }

    /// Why it bounds no body.
    pub fn fault(&self) -> Option<&'static str> {
        self.fault
    }

    /// Whether a place is inside, were it or were it not inside the part `given`.
    fn contains(&self, place: DVec2, given: Option<(usize, bool)>) -> bool {
        self.parts.iter().enumerate().fold(false, |inside, (k, part)| {
            let own = match given {
                Some((number, own)) if number == k => own,
                _ => within(part, place),
            };
            match part.combine {
                Combine::Add => inside || own,
                Combine::Subtract => inside && !own,
                Combine::Intersect => inside && own,
            }
        })
    }

    /// What of a part's outline is the figure's, the figure to the left.
    fn seen_of(&self, part: usize) -> Vec<Piece> {
        let mut seen = Vec::new();
        for piece in outline(&self.parts[part]) {
            let side = |t: f64| {
                let place = piece.at(t);
                let [inner, outer] = [true, false].map(|own| self.contains(place, Some((part, own))));
                (inner != outer).then_some(inner)
            };
            let cut = |mut low: f64, mut high: f64| {
                let before = side(low);
                for _ in 0..HALVINGS {
                    let middle = 0.5 * (low + high);
                    (low, high) = if side(middle) == before { (middle, high) } else { (low, middle) };
                }
                0.5 * (low + high)
            };
            // Off the ends, where parts have corners of their own.
            let look = |k: usize| (k as f64 / (LOOKS - 1) as f64).clamp(OFF, 1.0 - OFF);
            let mut begin = 0.0;
            for k in 0..LOOKS {
                let last = k + 1 == LOOKS;
                if !last && side(look(k)) == side(look(k + 1)) {
                    continue;
                }
                let end = if last { 1.0 } else { cut(look(k), look(k + 1)) };
                if let Some(inner) = side(look(k)) {
                    let kept = piece.part(begin, end);
                    seen.push(if inner { kept } else { kept.reversed() });
                }
                begin = end;
            }
        }
        seen
    }

    /// Distance of a place from the outline, negative inside.
    pub fn distance(&self, place: DVec2) -> f64 {
        let nearest = self.outline.iter().map(|piece| piece.distance(place)).fold(f64::INFINITY, f64::min);
        if self.contains(place, None) { -nearest } else { nearest }
    }

    pub fn area(&self) -> f64 {
        self.outline.iter().map(Piece::swept).sum()
    }

    /// About the corners of the box around it.
    pub fn bounds(&self) -> (DVec2, DVec2) {
        let places = self.outline.iter().flat_map(|piece| (0..=16).map(|k| piece.at(f64::from(k) / 16.0)));
        places.fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), place| (low.min(place), high.max(place)))
    }

    /// The outline from corner to corner; all of it where there is none.
    pub(super) fn runs(&self) -> Vec<Run<'_>> {
        let count = self.outline.len();
        let is_corner = |k: &usize| {
            let [before, after] = [self.outline[(k + count - 1) % count].velocity(1.0), self.outline[*k].velocity(0.0)];
            before.angle_to(after).abs() > CORNER
        };
        let mut cuts: Vec<usize> = (0..count).filter(is_corner).collect();
        if cuts.first() != Some(&0) {
            cuts.insert(0, 0);
        }
        cuts.push(count);
        cuts.windows(2).map(|pair| Run(&self.outline[pair[0]..pair[1]])).collect()
    }
}

impl Run<'_> {
    /// Number of pieces: where `s` ends.
    pub fn end(&self) -> f64 {
        self.0.len() as f64
    }

    fn piece(&self, s: f64) -> (&Piece, f64) {
        let k = (s as usize).min(self.0.len() - 1);
        (&self.0[k], s - k as f64)
    }

    pub fn at(&self, s: f64) -> DVec2 {
        let (piece, t) = self.piece(s);
        piece.at(t)
    }

    pub fn velocity(&self, s: f64) -> DVec2 {
        let (piece, t) = self.piece(s);
        piece.velocity(t)
    }

    /// The place between two that is equally far from both.
    pub fn middle(&self, from: f64, to: f64) -> f64 {
        let [first, last] = [from, to].map(|s| self.at(s));
        let (mut low, mut high) = (from, to);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            let place = self.at(middle);
            let nearer = place.distance_squared(first) < place.distance_squared(last);
            (low, high) = if nearer { (middle, high) } else { (low, middle) };
        }
        0.5 * (low + high)
    }

    /// What the figure has beyond the straight way between two places.
    pub fn bulge(&self, from: f64, to: f64) -> f64 {
        let part = |k: usize| {
            let [begin, end] = [from, to].map(|s| (s - k as f64).clamp(0.0, 1.0));
            // Around the first place: what is small is not the difference of what is large.
            if begin < end { moved(&self.0[k].part(begin, end), -self.at(from)).swept() } else { 0.0 }
        };
        (0..self.0.len()).map(part).sum()
    }
}

fn moved(piece: &Piece, by: DVec2) -> Piece {
    match *piece {
        Piece::Straight(from, to) => Piece::Straight(from + by, to + by),
        Piece::Bow { centre, axes, turn, from, to } => Piece::Bow { centre: centre + by, axes, turn, from, to },
    }
}

/// Orders pieces to one closed curve; else gives them back, and why they are none.
fn closed(mut pieces: Vec<Piece>) -> Result<Vec<Piece>, (Vec<Piece>, &'static str)> {
    let Some(first) = pieces.pop() else { return Err((pieces, "leave nothing of the body")) };
    let size = pieces.iter().chain([&first]).map(|piece| piece.at(0.5).distance(first.at(0.0))).fold(0.0, f64::max);
    let mut outline = vec![first];
    loop {
        let end = outline[outline.len() - 1].at(1.0);
        if end.distance(first.at(0.0)) <= MEETS * size {
            break;
        }
        match pieces.iter().position(|piece| piece.at(0.0).distance(end) <= MEETS * size) {
            Some(next) => outline.push(pieces.swap_remove(next)),
            None => {
                let fault = "have outlines that run along each other, or that touch in a place; let the parts overlap";
                return Err((outline, fault));
            }
        }
    }
    match pieces.is_empty() {
        true => Ok(outline),
        false => {
            outline.extend(pieces);
            Err((
                outline,
                "make several bodies, or one with a hole; give each body a table of its own, and leave no hole",
            ))
        }
    }
}

/// Direction of the first axis of what is turned by so many degrees.
fn direction(turn: f64) -> DVec2 {
    DVec2::from_angle(turn.to_radians())
}

/// Whether a place lies in a part on its own.
fn within(part: &Part, place: DVec2) -> bool {
    if let Some(circle) = &part.circle {
        place.distance(circle.centre.into()) < circle.radius
    } else if let Some(ellipse) = &part.ellipse {
        let offset = direction(-ellipse.turn).rotate(place - DVec2::from(ellipse.centre));
        (offset / DVec2::from(ellipse.axes)).length_squared() < 1.0
    } else if let Some(block) = &part.block {
        let offset = direction(-block.turn).rotate(place - DVec2::from(block.centre)).abs();
        let beyond = offset - (0.5 * DVec2::from(block.size) - block.corner);
        let outside = beyond.max(DVec2::ZERO).length();
        if block.corner > 0.0 { outside < block.corner } else { beyond.max_element() < 0.0 }
    } else if let Some(capsule) = &part.capsule {
        let [from, to] = [capsule.from, capsule.to].map(DVec2::from);
        Piece::Straight(from, to).distance(place) < capsule.radius
    } else {
        false
    }
}

/// The outline of a part on its own, anticlockwise.
fn outline(part: &Part) -> Vec<Piece> {
    use std::f64::consts::{FRAC_PI_2, PI, TAU};
    let bow = |centre: DVec2, axes: DVec2, turn: DVec2, from: f64, to: f64| Piece::Bow { centre, axes, turn, from, to };
    if let Some(circle) = &part.circle {
        vec![bow(circle.centre.into(), DVec2::splat(circle.radius), DVec2::X, 0.0, TAU)]
    } else if let Some(ellipse) = &part.ellipse {
        vec![bow(ellipse.centre.into(), ellipse.axes.into(), direction(ellipse.turn), 0.0, TAU)]
    } else if let Some(block) = &part.block {
        let (turn, centre) = (direction(block.turn), DVec2::from(block.centre));
        let half = 0.5 * DVec2::from(block.size);
        let place = |offset: DVec2| centre + offset.rotate(turn);
        // Each side, and the corner that it runs to.
        let sides = [DVec2::NEG_Y, DVec2::X, DVec2::Y, DVec2::NEG_X].map(|outward| (outward, outward.perp()));
        let pieces = sides.into_iter().enumerate().flat_map(|(k, (outward, along))| {
            let [off, way] = [outward * half, along * (half - block.corner)];
            let corner = place(off + way - block.corner * outward);
            let from = (k as f64 - 1.0) * FRAC_PI_2;
            let round = bow(corner, DVec2::splat(block.corner), turn, from, from + FRAC_PI_2);
            [Some(Piece::Straight(place(off - way), place(off + way))), (block.corner > 0.0).then_some(round)]
        });
        // Sides that are all corner have no length.
        let has_length = |piece: &Piece| piece.velocity(0.5) != DVec2::ZERO;
        pieces.flatten().filter(has_length).collect()
    } else if let Some(capsule) = &part.capsule {
        let [from, to] = [capsule.from, capsule.to].map(DVec2::from);
        let turn = (to - from).normalize();
        let (aside, round) = (capsule.radius * turn.perp(), DVec2::splat(capsule.radius));
        vec![
            Piece::Straight(from - aside, to - aside),
            bow(to, round, turn, -FRAC_PI_2, FRAC_PI_2),
            Piece::Straight(to + aside, from + aside),
            bow(from, round, turn, FRAC_PI_2, FRAC_PI_2 + PI),
        ]
    } else {
        vec![]
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::case::Obstacle;

    fn figure(parts: &str) -> Figure {
        let text = format!("name = 'it'\nparts = [{parts}]");
        let obstacle: Obstacle = toml::from_str(&text).expect("an obstacle");
        Figure::new(&obstacle.parts.expect("parts"))
    }

    const BLOCK: &str = "{ box = { centre = [1.0, 1.0], size = [0.8, 0.4] } }";
    const CIRCLE: &str = "circle = { centre = [1.4, 1.0], radius = 0.1 }";

    #[test]
    fn areas_are_those_of_geometry() {
        for (parts, area) in [
            (BLOCK.to_owned(), 0.32),
            (
                "{ box = { centre = [1.0, 1.0], size = [0.8, 0.4], corner = 0.1, turn = 33.0 } }".to_owned(),
                0.32 - 0.01 * (4.0 - PI),
            ),
            ("{ box = { centre = [1.0, 1.0], size = [0.4, 0.4], corner = 0.2 } }".to_owned(), 0.04 * PI),
            ("{ ellipse = { centre = [1.0, 1.0], axes = [0.5, 0.2], turn = 20.0 } }".to_owned(), 0.1 * PI),
            ("{ capsule = { from = [0.5, 0.5], to = [0.8, 0.9], radius = 0.1 } }".to_owned(), 0.01 * PI + 0.1),
            (format!("{BLOCK}, {{ {CIRCLE} }}"), 0.32 + 0.005 * PI),
            (format!("{BLOCK}, {{ {CIRCLE}, combine = 'subtract' }}"), 0.32 - 0.005 * PI),
            (format!("{BLOCK}, {{ {CIRCLE}, combine = 'intersect' }}"), 0.005 * PI),
        ] {
            let figure = figure(&parts);
            assert_eq!(figure.fault(), None, "{parts}");
            assert!((figure.area() - area).abs() < 1e-12, "{parts}: {} for {area}", figure.area());
        }
    }

    /// By brute force, from places close together along the outline.
    #[test]
    fn distances_are_exact_inside_and_outside_of_every_combination() {
        let ring = "{ circle = { centre = [1.0, 1.0], radius = 0.5 } }, \
                    { circle = { centre = [1.0, 1.0], radius = 0.3 }, combine = 'subtract' }, \
                    { box = { centre = [1.5, 1.0], size = [0.8, 0.2], turn = 10.0 }, combine = 'subtract' }";
        for parts in [
            format!("{BLOCK}, {{ {CIRCLE} }}"),
            format!("{BLOCK}, {{ {CIRCLE}, combine = 'subtract' }}"),
            ring.to_owned(),
        ] {
            let figure = figure(&parts);
            assert_eq!(figure.fault(), None, "{parts}");
            let places: Vec<DVec2> =
                figure.outline.iter().flat_map(|piece| (0..4000).map(|k| piece.at(f64::from(k) / 4000.0))).collect();
            for k in 0..400 {
                let place =
                    2.0 * DVec2::new((0.754_877_666 * f64::from(k)).fract(), (0.569_840_291 * f64::from(k)).fract());
                let near = places.iter().map(|other| other.distance(place)).fold(f64::INFINITY, f64::min);
                let found = figure.distance(place);
                assert!(
                    found.abs() <= near + 1e-14 && found.abs() > near - 1e-3,
                    "{parts}, {place}: {found} for {near}"
                );
                // A step as long as the distance reaches the outline and not beyond.
                let ring = (0..360)
                    .map(|angle| place + 0.999 * found.abs() * DVec2::from_angle(f64::from(angle).to_radians()));
                assert!(
                    ring.into_iter().all(|other| (figure.distance(other) < 0.0) == (found < 0.0)),
                    "{parts}, {place}"
                );
            }
        }
    }

    #[test]
    fn what_bounds_no_body_is_found() {
        let hole = "circle = { centre = [1.0, 1.0], radius = 0.1 }, combine = 'subtract'";
        let away = "circle = { centre = [3.0, 1.0], radius = 0.1 }";
        for (parts, expected) in [
            (format!("{BLOCK}, {{ {hole} }}"), "make several bodies, or one with a hole"),
            (format!("{BLOCK}, {{ {away} }}"), "make several bodies"),
            (format!("{BLOCK}, {{ {away}, combine = 'intersect' }}"), "leave nothing of the body"),
            (format!("{BLOCK}, {{ box = {{ centre = [1.8, 1.0], size = [0.8, 0.4] }} }}"), "make several bodies"),
        ] {
            let fault = figure(&parts).fault().unwrap_or_default();
            assert!(fault.starts_with(expected) || fault.contains(expected), "{parts}: {fault:?}");
        }
    }
}
