//! Checks of the sides: what each kind takes and needs.

use super::super::fault::Fault;
use super::super::{Case, SideKind, SideProfile, Wall};

pub(super) fn check(case: &Case) -> Result<(), Fault> {
    let [x, y] = case.domain.periodic.each();
    let inward = [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]];
    for (((name, wall), periodic), inward) in case.boundaries.each().into_iter().zip([x, x, y, y]).zip(inward) {
        if wall.kind == SideKind::Wall {
            continue;
        }
        let reason = if periodic {
            "the domain repeats there (domain.periodic), so that there is no side; leave it out".to_owned()
        } else if case.exact.is_some() {
            "the exact solution (exact.solution) prescribes what the sides do; leave out one of them".to_owned()
        } else {
            match unfit(case, wall, inward) {
                Some(reason) => reason,
                None => continue,
            }
        };
        return Err(Fault::reason(&format!("boundaries.{name}.kind"), reason));
    }
    Ok(())
}

/// What does not go with the kind of a side; `inward` is its normal into the domain.
fn unfit(case: &Case, wall: &Wall, inward: [f64; 2]) -> Option<String> {
    let moves = wall.velocity != [0.0, 0.0] || wall.profile != SideProfile::Uniform;
    let comes_in = wall.velocity[0] * inward[0] + wall.velocity[1] * inward[1] > 0.0;
    let reason = match wall.kind {
        SideKind::Slip | SideKind::Outlet if moves => {
            "takes its velocity from the fluid; leave out boundaries.*.velocity and boundaries.*.profile of this side"
        }
        SideKind::Inlet | SideKind::Outlet if case.effects.pressure.is_none() => {
            "needs the pressure to bring the fluid through, and the table effects.pressure is absent"
        }
        SideKind::Inlet if !comes_in => "needs boundaries.*.velocity of this side, pointing into the domain",
        SideKind::Inlet if !case.has_side(SideKind::Outlet) => {
            "needs another side with boundaries.*.kind = \"outlet\": what comes in has to go"
        }
        _ => return None,
    };
    Some(reason.to_owned())
}
