//! Checks of the domain, its walls, the points and their neighbourhoods.

use super::super::fault::Fault;
use super::super::{Arrangement, Case, Cloud, Domain, SideKind, Solution};
use super::require;

/// Most points of a cloud.
pub const LARGEST_CLOUD: f64 = 1e8;
/// The radius of the neighbourhood is above this, in spacings: a lattice point then has 8 neighbours, the fit needs 5.
pub const SMALLEST_RADIUS: f64 = 1.5;
/// The radius of the neighbourhood is at most this, in spacings: a lattice point then has 80 neighbours.
pub const LARGEST_RADIUS: f64 = 5.0;

/// The widest radius that the fit of a point with too few neighbours takes, over `method.radius`.
pub const WIDEST_LADDER: f64 = 2.0;

/// Least distance of random points, in spacings: they are laid out on a grid of squares of that size.
const SMALLEST_DISTANCE: f64 = 0.1;
/// Fewest spacings along a side.
const FEWEST_CELLS: f64 = 4.0;
/// Part of a spacing by which a side may miss a whole number of them: room for decimals like 0.3333333.
const WHOLE_WITHIN: f64 = 1e-6;
/// Lattices tried on either side of the one asked for, in search of one that fits both sides.
const LATTICES_TRIED: u32 = 2000;

pub(super) fn check(case: &Case) -> Result<(), Fault> {
    let Case { domain, cloud, .. } = case;
    require(domain.width > 0.0, "domain.width")?;
    require(domain.height > 0.0, "domain.height")?;
    require(cloud.spacing > 0.0, "cloud.spacing")?;
    check_size(case)?;
    // Relaxed points divide each side into pieces of their own.
    if cloud.arrangement != Arrangement::Relaxed {
        check_whole(domain, cloud.spacing)?;
    }
    check_arrangement(cloud)?;
    require(case.fluid.density > 0.0, "fluid.density")?;
    check_walls(case)?;
    require((1..=4).contains(&case.method.order), "method.order")?;
    let radius = case.method.radius();
    require(radius > SMALLEST_RADIUS && radius <= LARGEST_RADIUS, "method.radius")?;
    check_period(case)
}

impl Case {
    /// About how many points the cloud has: those of the lattice with its spacing, exact for lattices.
    pub fn point_estimate(&self) -> f64 {
        // A side that repeats has its first line of points and not its last.
        let along = |side: f64, periodic: bool| (side / self.cloud.spacing).round() + f64::from(u8::from(!periodic));
        let [x, y] = self.domain.periodic.each();
        along(self.domain.width, x) * along(self.domain.height, y)
    }
}

fn check_size(case: &Case) -> Result<(), Fault> {
    let points = case.point_estimate();
    if points > LARGEST_CLOUD {
        let reason = format!("gives about {points:.1e} points, more than {LARGEST_CLOUD:e}; take a larger spacing");
        return Err(Fault::reason("cloud.spacing", reason));
    }
    let Domain { width, height, .. } = case.domain;
    let side = width.min(height);
    if side / case.cloud.spacing < FEWEST_CELLS - WHOLE_WITHIN {
        let most = side / FEWEST_CELLS;
        let reason =
            format!("must be at most {most}, {FEWEST_CELLS} spacings to the shorter side of {width} x {height} m");
        return Err(Fault::reason("cloud.spacing", reason));
    }
    Ok(())
}

fn check_whole(domain: &Domain, spacing: f64) -> Result<(), Fault> {
    let Domain { width, height, .. } = *domain;
    if is_whole(width / spacing) && is_whole(height / spacing) {
        return Ok(());
    }
    let nearest = match nearest_spacing(domain, spacing) {
        Some(nearest) => format!("the nearest spacing that does is {nearest}"),
        None => "no spacing near it does: change the width or the height".to_owned(),
    };
    let reason = format!("must divide both sides of the domain, {width} x {height} m; {nearest}");
    Err(Fault::reason("cloud.spacing", reason))
}

/// The spacing nearest to `spacing`, by the number of points along the width, that divides both sides.
fn nearest_spacing(domain: &Domain, spacing: f64) -> Option<f64> {
    let count = (domain.width / spacing).round();
    let fits = |count: f64| {
        let candidate = domain.width / count;
        let cells = domain.height / candidate;
        (count >= FEWEST_CELLS && cells > FEWEST_CELLS - WHOLE_WITHIN && is_whole(cells)).then_some(candidate)
    };
    let off = |candidate: &f64| (candidate - spacing).abs();
    (0..=LATTICES_TRIED).find_map(|away| {
        let either = [fits(count - f64::from(away)), fits(count + f64::from(away))];
        either.into_iter().flatten().min_by(|a, b| off(a).total_cmp(&off(b)))
    })
}

fn is_whole(cells: f64) -> bool {
    (cells - cells.round()).abs() <= WHOLE_WITHIN
}

fn check_arrangement(cloud: &Cloud) -> Result<(), Fault> {
    let arrangement = cloud.arrangement;
    let belongs = |given: bool, to: &[Arrangement], key: &str, name: &str| match given && !to.contains(&arrangement) {
        true => {
            let reason =
                format!(r#"belongs to {name} points, and cloud.arrangement is "{}"; leave it out"#, arrangement.word());
            Err(Fault::reason(key, reason))
        }
        false => Ok(()),
    };
    use Arrangement::{Jittered, Random, Relaxed};
    belongs(cloud.jitter.is_some(), &[Jittered], "cloud.jitter", "jittered")?;
    belongs(cloud.minimum_distance.is_some(), &[Random], "cloud.minimum_distance", "random")?;
    belongs(cloud.seed.is_some(), &[Jittered, Random, Relaxed], "cloud.seed", "jittered, random or relaxed")?;
    require((0.0..0.5).contains(&cloud.jitter()), "cloud.jitter")?;
    let distance = cloud.minimum_distance();
    require((SMALLEST_DISTANCE..=0.75).contains(&distance), "cloud.minimum_distance")
}

impl Arrangement {
    fn word(self) -> &'static str {
        match self {
            Arrangement::Regular => "regular",
            Arrangement::Jittered => "jittered",
            Arrangement::Random => "random",
            Arrangement::Relaxed => "relaxed",
        }
    }
}

fn check_walls(case: &Case) -> Result<(), Fault> {
    let walls = &case.boundaries;
    let [x, y] = case.domain.periodic.each();
    let sides = [
        ("boundaries.left.velocity", &walls.left, 0, x),
        ("boundaries.right.velocity", &walls.right, 0, x),
        ("boundaries.bottom.velocity", &walls.bottom, 1, y),
        ("boundaries.top.velocity", &walls.top, 1, y),
    ];
    for (key, wall, across, periodic) in sides.into_iter().filter(|(_, wall, ..)| wall.velocity != [0.0, 0.0]) {
        let velocity = wall.velocity;
        let reason = if periodic {
            let axis = ["x", "y"][across];
            format!("the domain repeats along {axis} (domain.periodic), so that there is no wall; leave it out")
        } else if case.exact.is_some() && !case.is_solved_by(Solution::Couette) {
            "the exact solution (exact.solution) prescribes the velocity of every wall; leave out one of them"
                .to_owned()
        } else if velocity[across] != 0.0 && wall.kind == SideKind::Wall {
            let tangent = ["[0, v]", "[u, 0]"][across];
            format!("must be along the wall, {tangent}: a solid wall lets no fluid through")
        } else {
            continue;
        };
        return Err(Fault::reason(key, reason));
    }
    Ok(())
}

/// The shortest way between two points is one way alone: a box is wider than any neighbourhood.
fn check_period(case: &Case) -> Result<(), Fault> {
    let least = 2.0 * WIDEST_LADDER * case.method.radius() * case.cloud.spacing;
    let period = case.domain.period();
    for (key, length) in [("domain.width", period.x), ("domain.height", period.y)] {
        if length > 0.0 && length <= least {
            let spacings = 2.0 * WIDEST_LADDER;
            let reason = format!(
                "must be above {least}, {spacings} times method.radius in spacings, where domain.periodic has the axis repeat: \
                 else a point would meet another twice; take a smaller cloud.spacing"
            );
            return Err(Fault::reason(key, reason));
        }
    }
    Ok(())
}
