//! Checks of the bodies in the fluid, and of where the points lie closer.

use glam::DVec2;

use super::super::fault::Fault;
use super::super::{
    Arrangement, Axes, Block, Case, Combine, Obstacle, Operators, Part, PressureForm, Problem, Refine, Remap, SIDES,
};

pub(super) fn check(case: &Case) -> Result<(), Fault> {
    for (number, obstacle) in case.obstacles.iter().enumerate() {
        let key = |name: &str| format!("obstacles.[{number}].{name}");
        check_name(case, number, obstacle, &key)?;
        check_shape(case, obstacle, &key)?;
    }
    case.cloud.refine.iter().enumerate().try_for_each(|(number, refine)| {
        check_refine(case, refine, &|name| format!("cloud.refine.[{number}].{name}"))
    })?;
    check_method(case)
}

fn check_name(case: &Case, number: usize, obstacle: &Obstacle, key: &dyn Fn(&str) -> String) -> Result<(), Fault> {
    let name = &obstacle.name;
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    if name.is_empty() || !name.chars().all(plain) || SIDES.contains(&name.as_str()) {
        return Err(Fault::range(&key("name")));
    }
    if case.obstacles[..number].iter().any(|other| other.name == *name) {
        return Err(Fault::reason(&key("name"), "is that of another obstacle; names differ"));
    }
    Ok(())
}

fn check_shape(case: &Case, obstacle: &Obstacle, key: &dyn Fn(&str) -> String) -> Result<(), Fault> {
    let inside = |place: DVec2| {
        place.cmpgt(DVec2::ZERO).all() && place.cmplt(DVec2::new(case.domain.width, case.domain.height)).all()
    };
    let domain = format!("{} x {} m", case.domain.width, case.domain.height);
    let outside = |name: &str| Err(Fault::reason(&key(name), format!("must lie inside the domain, {domain}")));
    if let Some(parts) = &obstacle.parts {
        if obstacle.circle.is_some() || obstacle.polygon.is_some() {
            let reason =
                "an obstacle has one shape, and there is a circle or a polygon beside its parts; leave one out";
            return Err(Fault::reason(&key("parts"), reason));
        }
        return check_parts(parts, &inside, &key("parts"), &domain);
    }
    match (&obstacle.circle, &obstacle.polygon) {
        (Some(_), Some(_)) => {
            Err(Fault::reason(&key("polygon"), "an obstacle has one shape, and there is a circle; leave one out"))
        }
        (None, None) => Err(Fault::missing(&key("circle"))),
        (Some(circle), None) => {
            if circle.radius <= 0.0 {
                return Err(Fault::range(&key("circle.radius")));
            }
            let centre = DVec2::from_array(circle.centre);
            if inside(centre - circle.radius) && inside(centre + circle.radius) { Ok(()) } else { outside("circle") }
        }
        (None, Some(corners)) => {
            let corners: Vec<DVec2> = corners.iter().map(|&corner| DVec2::from_array(corner)).collect();
            if corners.len() < 3 {
                return Err(Fault::range(&key("polygon")));
            }
            if !corners.iter().all(|&corner| inside(corner)) {
                return outside("polygon");
            }
            match crossing(&corners) {
                Some(edge) => {
                    let reason =
                        format!("the edge from corner {edge} has no length, or touches another that is not next to it");
                    Err(Fault::reason(&key("polygon"), reason))
                }
                None => Ok(()),
            }
        }
    }
}

/// Figures as they can be, and those that are added inside the domain; what is taken away may lie anywhere.
fn check_parts(parts: &[Part], inside: &dyn Fn(DVec2) -> bool, table: &str, domain: &str) -> Result<(), Fault> {
    if parts.is_empty() {
        return Err(Fault::range(table));
    }
    for (number, part) in parts.iter().enumerate() {
        let key = |name: &str| format!("{table}.[{number}].{name}");
        let given = [part.circle.is_some(), part.ellipse.is_some(), part.block.is_some(), part.capsule.is_some()];
        if given.iter().filter(|given| **given).count() != 1 {
            let reason = "a part is one figure, of the keys circle, ellipse, box and capsule";
            return Err(Fault::reason(&format!("{table}.[{number}]"), reason));
        }
        let positive = |lengths: &[f64]| lengths.iter().all(|&length| length > 0.0);
        let wrong = [
            ("circle.radius", part.circle.as_ref().is_some_and(|circle| !positive(&[circle.radius]))),
            ("ellipse.axes", part.ellipse.as_ref().is_some_and(|ellipse| !positive(&ellipse.axes))),
            ("box.size", part.block.as_ref().is_some_and(|block| !positive(&block.size))),
            ("box.corner", part.block.as_ref().is_some_and(|block| !rounds(block))),
            ("capsule.to", part.capsule.as_ref().is_some_and(|capsule| capsule.from == capsule.to)),
            ("capsule.radius", part.capsule.as_ref().is_some_and(|capsule| !positive(&[capsule.radius]))),
        ];
        if let Some((name, _)) = wrong.iter().find(|(_, wrong)| *wrong) {
            return Err(Fault::range(&key(name)));
        }
        if number == 0 && part.combine != Combine::Add {
            return Err(Fault::reason(&key("combine"), "there is nothing before the first part; it must be \"add\""));
        }
        let (low, high) = part.bounds();
        if part.combine == Combine::Add && !(inside(low) && inside(high)) {
            return Err(Fault::reason(&format!("{table}.[{number}]"), format!("must lie inside the domain, {domain}")));
        }
    }
    Ok(())
}

/// Whether the corners of a box have room.
fn rounds(block: &Block) -> bool {
    block.corner >= 0.0 && 2.0 * block.corner <= block.size[0].min(block.size[1])
}

/// The first edge of a polygon that meets another, or has no length.
fn crossing(corners: &[DVec2]) -> Option<usize> {
    let count = corners.len();
    let edge = |k: usize| (corners[k], corners[(k + 1) % count]);
    let side = |(from, to): (DVec2, DVec2), place: DVec2| (to - from).perp_dot(place - from);
    let meets = |one: usize, other: usize| {
        let (a, b) = (edge(one), edge(other));
        side(a, b.0) * side(a, b.1) <= 0.0 && side(b, a.0) * side(b, a.1) <= 0.0
    };
    // Neighbours share a corner, and may not turn back on each other.
    let folds = |one: usize, next: usize| {
        let ((from, to), (_, beyond)) = (edge(one), edge(next));
        side((from, to), beyond) == 0.0 && (to - from).dot(beyond - to) < 0.0
    };
    (0..count).find(|&one| {
        let apart = |other: &usize| (one + 1) % count != *other && (other + 1) % count != one && *other != one;
        edge(one).0 == edge(one).1
            || folds(one, (one + 1) % count)
            || (0..count).filter(apart).any(|other| meets(one, other))
    })
}

fn check_refine(case: &Case, refine: &Refine, key: &dyn Fn(&str) -> String) -> Result<(), Fault> {
    if case.cloud.arrangement != Arrangement::Relaxed {
        let reason = "belongs to relaxed points; with [[cloud.refine]] it must be \"relaxed\"";
        return Err(Fault::reason("cloud.arrangement", reason));
    }
    if case.domain.periodic != Axes::None {
        return Err(Fault::reason(
            "cloud.refine",
            "does not repeat with the domain: it needs domain.periodic = \"none\"",
        ));
    }
    match (&refine.near, refine.corners) {
        (Some(_), Some(_)) => return Err(Fault::reason(&key("box"), "there is near; leave one out")),
        (None, None) => return Err(Fault::missing(&key("near"))),
        (Some(near), None) => {
            if !SIDES.contains(&near.as_str()) && case.obstacles.iter().all(|obstacle| obstacle.name != *near) {
                return Err(Fault::range(&key("near")));
            }
        }
        (None, Some(corners)) => {
            let inside =
                |[x, y]: [f64; 2]| (0.0..=case.domain.width).contains(&x) && (0.0..=case.domain.height).contains(&y);
            if !corners.into_iter().all(inside) {
                return Err(Fault::range(&key("box")));
            }
        }
    }
    if !(refine.spacing > 0.0 && refine.spacing <= case.cloud.spacing) {
        return Err(Fault::range(&key("spacing")));
    }
    if !(refine.growth > 0.0 && refine.growth <= 0.3) {
        return Err(Fault::range(&key("growth")));
    }
    Ok(())
}

/// What asks for lattices, and what asks for cells.
fn check_method(case: &Case) -> Result<(), Fault> {
    let (what, key) = match (case.obstacles.is_empty(), case.cloud.refine.is_empty()) {
        (false, _) => ("[[obstacles]]", "obstacles"),
        (_, false) => ("[[cloud.refine]]", "cloud.refine"),
        _ => return Ok(()),
    };
    if matches!(case.problem(), Problem::Derivatives(_)) {
        return Err(Fault::reason(key, "is compared with a lattice by [derivatives]; leave it out"));
    }
    if case.effects.pressure.as_ref().is_none_or(|pressure| pressure.form() != PressureForm::Conservative) {
        let reason = format!("must be there and conservative with {what}, whose cells it balances");
        return Err(Fault::reason("effects.pressure", reason));
    }
    if case.method.operators == Operators::Integral {
        return Err(Fault::reason("method.operators", format!("must be \"interpolation\" with {what}")));
    }
    if case.effects.advection.as_ref().is_some_and(|advection| advection.remap == Remap::Forward) {
        return Err(Fault::reason("effects.advection.remap", format!("must be \"departure\" with {what}")));
    }
    Ok(())
}
