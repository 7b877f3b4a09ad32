//! Small scenes which between them hold every operation, every choice of the case file that reaches an engine, and every rung
//! of the ladder.

use std::path::Path;
use std::sync::Arc;

use glam::DVec2;
use stillpoint::case::{Axes, Boundaries, Case, Circle, Obstacle, Refine, SideKind, SideProfile, Wall};
use stillpoint::cloud::Cloud;
use stillpoint::scene::Scene;

use crate::cases::{FIT, cavity_of, problem, turning, vortices, wake};

/// Spacings a side: 17 x 17 points, which fill no whole number of blocks.
const ACROSS: usize = 16;

/// What the solves of the scenes are asked for. f32 cannot reach it, and stops where rounding stops it; so what CPU f32
/// leaves against CPU f64 is what rounding leaves, and not where a solve chose to stop.
const TIGHT: &str = "effects.pressure.tolerance=1e-9";

const GRAVITY: &str = "effects.gravity.acceleration=[0.3, -1.0]";

/// What each scene changes in the cavity, by name.
const CHANGES: [(&str, &[&str]); 12] = [
    ("regular, conservative, departure, reflection, fit, cg", &[]),
    (
        "jittered, adjoint, cg by the diagonal, no weight",
        &[
            "cloud.arrangement=jittered",
            "cloud.jitter=0.4",
            "effects.pressure.gradient=adjoint",
            "effects.pressure.preconditioner=jacobi",
            "method.weight=none",
        ],
    ),
    (
        "random, projection, bicgstab, quadratic weight",
        &[
            "cloud.arrangement=random",
            "method.radius=2.8",
            "time.splitting=projection",
            "effects.pressure.solver=bicgstab",
            "method.weight=quadratic",
        ],
    ),
    (
        "jittered, conservative, forward, projection",
        &["cloud.arrangement=jittered", "effects.advection.remap=forward", "time.splitting=projection"],
    ),
    (
        "regular, collocated, departure, reflection, bicgstab",
        &["effects.pressure.form=collocated", "fluid.density=1000.0"],
    ),
    (
        "jittered, collocated, forward, projection",
        &[
            "cloud.arrangement=jittered",
            "effects.pressure.form=collocated",
            "effects.advection.remap=forward",
            "time.splitting=projection",
        ],
    ),
    (
        "random, collocated, direct",
        &[
            "cloud.arrangement=random",
            "method.radius=2.8",
            "effects.pressure.form=collocated",
            "effects.pressure.solver=direct",
        ],
    ),
    ("jittered, order 3", &["cloud.arrangement=jittered", "method.order=3"]),
    (
        "random, order 4, collocated, forward, projection",
        &[
            "cloud.arrangement=random",
            "method.order=4",
            "method.weight=quadratic",
            "effects.pressure.form=collocated",
            "effects.pressure.solver=direct",
            "effects.advection.remap=forward",
            "time.splitting=projection",
        ],
    ),
    ("jittered, gravity", &["cloud.arrangement=jittered", GRAVITY]),
    (
        "random, collocated, gravity",
        &["cloud.arrangement=random", "method.radius=2.8", "effects.pressure.form=collocated", GRAVITY],
    ),
    ("jittered, conservative, direct", &["cloud.arrangement=jittered", "effects.pressure.solver=direct"]),
];

/// Problems without time.
const PROBLEMS: [(&str, &[&str]); 7] = [
    ("derivatives, interpolation", &["derivatives.field=waves"]),
    ("derivatives, integral", &["derivatives.field=waves", "method.operators=integral"]),
    ("derivatives, order 4", &["derivatives.field=waves", "method.order=4"]),
    ("poisson, conservative", &["poisson.field=cosines", TIGHT]),
    (
        "poisson, collocated",
        &[
            "poisson.field=cosines",
            "effects.pressure.form=collocated",
            "method.radius=3.1",
            "method.weight=quadratic",
            TIGHT,
        ],
    ),
    ("poisson, direct", &["poisson.field=cosines", "effects.pressure.solver=direct"]),
    ("poisson, periodic", &["poisson.field=waves", "domain.periodic=both", TIGHT]),
];

/// Makes a case of so many spacings a metre and such changes.
type Make = fn(usize, &[&str]) -> Case;

/// The same of the flows that are known, in domains that repeat and domains that fluid flows through. 14 spacings a metre: no
/// point stands on the edge of a cell.
const KNOWN: [(&str, Make, &[&str]); 7] = [
    ("periodic, regular, fitted faces", vortices, &[FIT]),
    ("periodic, jittered, forward", vortices, &["cloud.arrangement=jittered", "effects.advection.remap=forward", FIT]),
    ("periodic, random, adjoint", vortices, &["cloud.arrangement=random", "effects.pressure.gradient=adjoint"]),
    (
        "periodic, jittered, collocated, projection",
        vortices,
        &["cloud.arrangement=jittered", "effects.pressure.form=collocated", "time.splitting=projection"],
    ),
    ("through-flow, jittered", wake, &["cloud.arrangement=jittered"]),
    ("through-flow, random, fitted faces", wake, &["cloud.arrangement=random", FIT]),
    ("through-flow, regular, collocated", wake, &["effects.pressure.form=collocated"]),
];

/// Every scene, with its name.
pub fn all() -> Vec<(&'static str, Arc<Scene>)> {
    let mut scenes: Vec<_> = CHANGES.iter().map(|&(name, changes)| (name, Arc::new(of(changes)))).collect();
    for (name, case, changes) in KNOWN {
        let changes = [&[TIGHT], changes].concat();
        scenes.push((name, Arc::new(Scene::build(&case(14, &changes)).expect("a scene"))));
    }
    scenes.push(("heat, buoyancy and tracers", Arc::new(of(&heated()))));
    let turning = turning(14, &["cloud.arrangement=jittered"]);
    scenes.push(("a rotation that is prescribed", Arc::new(Scene::build(&turning).expect("a scene"))));
    let solvers =
        ["conjugate_gradient", "bicgstab", "direct"].map(|solver| format!("effects.pressure.solver={solver}"));
    for (name, solver) in
        ["inlet, outlet and slip, cg", "inlet, outlet and slip, bicgstab", "inlet, outlet and slip, direct"]
            .into_iter()
            .zip(&solvers)
    {
        scenes.push((name, Arc::new(of(&[&OPEN[..], &[solver.as_str()]].concat()))));
    }
    for (name, changes) in POROUS {
        scenes.push((name, Arc::new(of(changes))));
    }
    for (name, changes) in IMPLICIT {
        scenes.push((name, Arc::new(of(changes))));
    }
    let changes =
        [TIGHT, FIT, "cloud.arrangement=jittered", "effects.viscosity={ kinematic = 0.5, scheme = 'implicit' }"];
    scenes.push(("implicit viscosity, through-flow", Arc::new(Scene::build(&wake(14, &changes)).expect("a scene"))));
    let mut shear = cavity_of(ACROSS, &["cloud.arrangement=jittered", IMPLICIT[0].1[1]]);
    (shear.effects.pressure, shear.effects.advection) = (None, None);
    scenes.push(("implicit viscosity alone", Arc::new(Scene::build(&shear).expect("a scene"))));
    for (name, more) in OPEN_COLLOCATED {
        scenes.push((name, Arc::new(of(&[&OPEN[..], more].concat()))));
    }
    scenes.push(("a channel that repeats", Arc::new(channel())));
    scenes.push(("obstacles in a lattice", Arc::new(with_obstacles("regular"))));
    scenes.push(("obstacles in relaxed points", Arc::new(with_obstacles("relaxed"))));
    scenes.push(("graded points round an obstacle", Arc::new(graded())));
    let mut still = cavity_of(ACROSS, &["cloud.arrangement=jittered", TIGHT]);
    still.effects.advection = None;
    scenes.push(("no advection", Arc::new(Scene::build(&still).expect("a scene"))));
    let mut linear = cavity_of(ACROSS, &["cloud.arrangement=jittered", TIGHT]);
    linear.effects.viscosity = None;
    (linear.method.order, linear.method.radius) = (1, Some(2.1));
    scenes.push(("no viscosity, order 1", Arc::new(Scene::build(&linear).expect("a scene"))));
    for (name, changes) in PROBLEMS {
        scenes.push((name, Arc::new(Scene::build(&problem(ACROSS, changes)).expect("a scene"))));
    }
    let mut diffusion = cavity_of(ACROSS, &["cloud.arrangement=jittered", "method.operators=integral"]);
    (diffusion.effects.pressure, diffusion.effects.advection) = (None, None);
    scenes.push(("viscosity alone, integral", Arc::new(Scene::build(&diffusion).expect("a scene"))));
    let integral = of(&["cloud.arrangement=jittered", "method.operators=integral"]);
    scenes.push(("integral", Arc::new(integral)));
    scenes.push(("rows of points", Arc::new(ladder(2))));
    scenes.push(("rows of points, order 4", Arc::new(ladder(4))));
    for (name, changes) in COLUMNS {
        scenes.push((name, Arc::new(column(changes))));
    }
    scenes.push(("a pair under the ceiling", Arc::new(pair())));
    // The sums over workgroups take more than one round, and more than one tile of cells.
    let many = cavity_of(144, &["cloud.arrangement=jittered", TIGHT]);
    scenes.push(("many points", Arc::new(Scene::build(&many).expect("a scene"))));
    scenes
}

/// A cavity with a circle and a wedge in it, its faces fitted, on points of this arrangement.
fn with_obstacles(arrangement: &str) -> Scene {
    let arrangement = format!("cloud.arrangement={arrangement}");
    let mut case = cavity_of(ACROSS, &[TIGHT, FIT, &arrangement]);
    case.obstacles = vec![
        obstacle(Some(Circle { centre: [0.35, 0.6], radius: 0.13 }), None),
        obstacle(None, Some(vec![[0.55, 0.25], [0.85, 0.35], [0.6, 0.5]])),
    ];
    Scene::build(&case).expect("a scene")
}

fn obstacle(circle: Option<Circle>, polygon: Option<Vec<[f64; 2]>>) -> Obstacle {
    let name = if circle.is_some() { "ball" } else { "wedge" };
    Obstacle { name: name.to_owned(), circle, polygon, parts: None }
}

/// A channel round a circle, which fluid flows through, its points closer around that; plain faces.
fn graded() -> Scene {
    let mut case = cavity_of(8, &[TIGHT, "cloud.arrangement=relaxed"]);
    case.boundaries = Boundaries::default();
    case.boundaries.left =
        Wall { kind: SideKind::Inlet, profile: SideProfile::Parabola, velocity: [1.0, 0.0], ..Wall::default() };
    case.boundaries.right.kind = SideKind::Outlet;
    case.obstacles = vec![obstacle(Some(Circle { centre: [0.4, 0.5], radius: 0.13 }), None)];
    case.cloud.refine = vec![Refine { near: Some("ball".to_owned()), corners: None, spacing: 0.04, growth: 0.15 }];
    Scene::build(&case).expect("a scene")
}

/// The cavity on 17 x 17 points with `changes`.
pub fn of(changes: &[&str]) -> Scene {
    Scene::build(&cavity_of(ACROSS, &[&[TIGHT], changes].concat())).expect("a scene")
}

/// Columns of fluid that collapse, by the motion of their points.
const COLUMNS: [(&str, &[&str]); 5] = [
    ("shifted points", &["effects.advection.motion=shifted"]),
    // At its foot the pressure moves points farther than it may.
    ("shifted points, pushed", &["effects.advection.motion=shifted", "effects.gravity.acceleration=[0.0, -8.0]"]),
    (
        "points that move, quadratic weight, bicgstab by the diagonal",
        &[
            "effects.advection.motion=lagrangian",
            "effects.pressure.preconditioner=jacobi",
            "method.weight=quadratic",
            "cloud.arrangement=jittered",
            "cloud.jitter=0.2",
        ],
    ),
    ("points that move, MPS", &["effects.advection.motion=lagrangian", "method.operators=integral"]),
    (
        "points that move, MPS, corrected gradient, cg by the diagonal",
        &[
            "effects.advection.motion=lagrangian",
            "method.operators=integral",
            "effects.pressure.gradient=corrected",
            "effects.pressure.preconditioner=jacobi",
        ],
    ),
];

/// The column of shifted points, and two more under the ceiling, nearly one below the other.
fn pair() -> Scene {
    let Scene { case, mut cloud, .. } = column(COLUMNS[0].1);
    cloud.position.extend([DVec2::new(2.5, 2.45), DVec2::new(2.501, 2.35)]);
    (cloud.interior, cloud.pressured) = (cloud.interior + 2, cloud.pressured + 2);
    Scene::with_cloud(&case, cloud).expect("a scene")
}

/// A column in a tank, 10 spacings wide and 15 high, viscous, in a step between two looks.
fn column(changes: &[&str]) -> Scene {
    let text = "title = 'a column'\n\
                domain = { width = 3.0, height = 2.5 }\n\
                cloud = { arrangement = 'regular', spacing = 0.1, fill = { from = [0.0, 0.0], to = [1.0, 1.5] } }\n\
                fluid.density = 2.0\n\
                effects.viscosity.kinematic = 0.01\n\
                effects.gravity.acceleration = [0.0, -1.0]\n\
                effects.pressure.tolerance = 1e-9\n\
                time = { end = 1.0, courant = 0.2 }\n";
    let changes: Vec<String> = changes.iter().map(|&change| change.to_owned()).collect();
    let case = Case::from_text(text, Path::new("column.toml"), &changes).expect("a case");
    Scene::build(&case).expect("a scene")
}

/// Fluid comes in on the left, slides along the top, and leaves on the right; a tracer goes with it.
pub const OPEN: [&str; 6] = [
    "cloud.arrangement=jittered",
    "boundaries.left={ kind = 'inlet', velocity = [1.0, 0.1], profile = 'parabola' }",
    "boundaries.right={ kind = 'outlet' }",
    "boundaries.top={ kind = 'slip' }",
    GRAVITY,
    "effects.tracers=[{ name = 'ink', diffusivity = 0.01, shape = 'box', centre = [0.0, 0.4], size = [0.5, 0.3] }]",
];

/// Porous bodies: with half kicks, and with whole ones, of which no mean pressure is kept.
const POROUS: [(&str, &[&str]); 2] = [
    (
        "a porous circle",
        &[
            "cloud.arrangement=jittered",
            "effects.drag={ permeability = 1e-3, inertia = 2.0, circle = { centre = [0.4, 0.6], radius = 0.25 } }",
        ],
    ),
    (
        "porous everywhere, projection",
        &["cloud.arrangement=jittered", "time.splitting=projection", "effects.drag.permeability=1e-3"],
    ),
];

/// Viscosity that is solved for, far beyond the steps that would be stable without.
const IMPLICIT: [(&str, &[&str]); 2] = [
    (
        "implicit viscosity, gravity",
        &[
            "cloud.arrangement=jittered",
            "effects.viscosity={ kinematic = 1.0, scheme = 'implicit', tolerance = 1e-9 }",
            GRAVITY,
        ],
    ),
    (
        "implicit viscosity, adjoint, projection, bicgstab",
        &[
            "cloud.arrangement=random",
            "method.radius=2.8",
            "effects.viscosity={ kinematic = 1.0, scheme = 'implicit', tolerance = 1e-9 }",
            "effects.pressure.gradient=adjoint",
            "effects.pressure.solver=bicgstab",
            "time.splitting=projection",
        ],
    ),
];

/// The same with the collocated pressure.
const OPEN_COLLOCATED: [(&str, &[&str]); 2] = [
    (
        "inlet, outlet and slip, collocated, bicgstab",
        &["effects.pressure.form=collocated", "effects.heat.diffusivity=0.02", "boundaries.left.temperature=1.0"],
    ),
    (
        "inlet, outlet and slip, collocated, direct",
        &["effects.pressure.form=collocated", "effects.pressure.solver=direct", "time.splitting=projection"],
    ),
];

/// A cavity heated from two sides, in which two tracers are carried.
pub fn heated() -> [&'static str; 9] {
    [
        "cloud.arrangement=jittered",
        GRAVITY,
        "effects.heat.diffusivity=0.02",
        "effects.heat.initial=0.3",
        "effects.buoyancy={ expansion = 0.5, reference = 0.2 }",
        "boundaries.left.temperature=1.0",
        "boundaries.bottom.heat_flux=0.05",
        "boundaries.right.temperature=0.0",
        "effects.tracers=[{ name = 'smoke', diffusivity = 0.01, shape = 'gaussian', centre = [0.5, 0.6], radius = 0.2 }, \
         { name = 'ink', shape = 'box', centre = [0.4, 0.7], size = [0.4, 0.3] }]",
    ]
}

/// Along x the domain repeats, along y it ends at walls, of which one moves.
fn channel() -> Scene {
    let mut case = cavity_of(ACROSS, &["cloud.arrangement=jittered", TIGHT]);
    case.domain.periodic = Axes::X;
    Scene::build(&case).expect("a scene")
}

/// Groups of points out of each other's sight whose fits stand on every rung of the ladder: a dense patch that makes room for
/// long lists; one row to four, of which no fit of a higher order is made; two rows with a third that only a wider radius
/// reaches, of each width. No pressure, no walls.
fn ladder(order: usize) -> Scene {
    // Enough points even at the ends of a row.
    let (along, radius) = if order == 2 { (0.5, 2.6) } else { (0.2, 2.95) };
    let count = (6.0 / along) as u32;
    let rows = |corner: DVec2, across: &[f64]| -> Vec<DVec2> {
        across.iter().flat_map(|&y| (0..=count).map(move |k| corner + DVec2::new(along * f64::from(k), y))).collect()
    };
    let dense: Vec<f64> = (0..13).map(|k| 0.5 * f64::from(k)).collect();
    let position = [
        rows(DVec2::new(2.0, 2.0), &dense),
        rows(DVec2::new(22.0, 2.0), &[0.0]),
        rows(DVec2::new(2.0, 22.0), &[0.0, 0.5]),
        rows(DVec2::new(22.0, 22.0), &[0.0, 0.5, 3.0]),
        rows(DVec2::new(12.0, 13.0), &[0.0, 0.5, 3.8]),
        rows(DVec2::new(32.0, 32.0), &[0.0, 0.5, 5.0]),
        rows(DVec2::new(2.0, 32.0), &[0.0, 0.5, 1.0]),
        rows(DVec2::new(12.0, 22.0), &[0.0, 0.5, 1.0, 1.5]),
    ]
    .concat();
    let (interior, size) = (position.len(), DVec2::splat(40.0));
    let cloud = Cloud {
        pressured: interior,
        filled: None,
        position,
        interior,
        normal: vec![],
        sides: vec![],
        outlines: vec![],
        spacing: 1.0,
        local: None,
        size,
        period: DVec2::ZERO,
    };
    let mut case = cavity_of(1, &["domain.width=40.0", "domain.height=40.0"]);
    case.effects.pressure = None;
    (case.method.order, case.method.radius) = (order, Some(radius));
    Scene::with_cloud(&case, cloud).expect("a scene")
}
