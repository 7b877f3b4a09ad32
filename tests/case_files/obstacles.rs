//! Obstacles, refinements, sides that let fluid through, and what is measured of them: what each mistake says.

use super::load;

const CHANNEL: &str = r#"title = "Channel"
domain = { width = 2.0, height = 1.0 }
cloud = { arrangement = "relaxed", spacing = 0.05 }
fluid = { density = 1.0 }
boundaries = { left = { kind = "inlet", velocity = [1.0, 0.0] }, right = { kind = "outlet" } }
effects = { viscosity = { kinematic = 0.01 }, pressure = {}, advection = {} }
time = { end = 1.0 }
"#;

const BODIES: &str = r#"[[obstacles]]
name = "ball"
circle = { centre = [0.5, 0.5], radius = 0.1 }
[[obstacles]]
name = "wedge"
polygon = [[1.0, 0.4], [1.3, 0.5], [1.0, 0.6]]
[[obstacles]]
name = "key"
parts = [
    { capsule = { from = [1.6, 0.3], to = [1.8, 0.7], radius = 0.06 } },
    { box = { centre = [1.6, 0.3], size = [0.2, 0.16], corner = 0.03, turn = 10.0 } },
    { ellipse = { centre = [1.6, 0.2], axes = [0.05, 0.04], turn = 20.0 }, combine = "subtract" },
]
"#;

const MORE: &str = r#"[[cloud.refine]]
near = "ball"
spacing = 0.02
[[cloud.refine]]
box = [[1.0, 0.0], [1.2, 0.2]]
spacing = 0.02
growth = 0.2
[expect.drag]
component = "x"
measure = "force"
on = "ball"
value = 1.0
tolerance = 0.1
source = "a paper"
[expect.drop]
component = "p"
measure = "difference"
between = [[0.4, 0.5], [0.6, 0.5]]
value = 1.0
tolerance = 0.1
source = "a paper"
[expect.out]
component = "velocity"
measure = "flux"
on = "right"
value = 1.0
tolerance = 0.1
source = "a paper"
"#;

fn good() -> String {
    // The table of the cloud is closed where it stands; a table of its own takes refinements.
    let cloud = "[cloud]\narrangement = \"relaxed\"\nspacing = 0.05\n";
    let channel = CHANNEL.replace("cloud = { arrangement = \"relaxed\", spacing = 0.05 }\n", "");
    format!("{channel}{BODIES}{cloud}{MORE}")
}

#[test]
fn the_channel_is_good() {
    let case = load(&good(), &[]).expect("a good case");
    assert_eq!((case.obstacles.len(), case.cloud.refine.len(), case.expect.len()), (3, 2, 3));
    assert_eq!((case.cloud.refine[0].growth, case.cloud.refine[1].growth), (0.1, 0.2));
    let json = serde_json::to_string(&case).expect("a case as JSON");
    assert_eq!(serde_json::from_str::<stillpoint::case::Case>(&json).expect("a case from JSON"), case);
}

/// What stands in the good case, what takes its place, and what is said.
#[rustfmt::skip]
const MISTAKES: &[(&str, &str, &str)] = &[
    ("name = \"wedge\"", "name = \"ball\"", "obstacles[1].name = \"ball\": is that of another obstacle"),
    ("name = \"wedge\"", "name = \"left\"", "obstacles[1].name = \"left\": must be letters, digits, _ and - alone, and no side's name"),
    ("name = \"wedge\"", "name = \"a wedge\"", "obstacles[1].name = \"a wedge\": must be letters"),
    ("name = \"wedge\"\n", "", "obstacles[1].name is missing: it must be letters"),
    ("radius = 0.1", "radius = -0.1", "obstacles[0].circle.radius = -0.1: must be a length above 0, m"),
    ("radius = 0.1", "diameter = 0.1", "obstacles[0].circle.diameter is not a key"),
    ("radius = 0.1", "radius = 0.6", "obstacles[0].circle = { centre = [0.5, 0.5], radius = 0.6 }: must lie inside the domain, 2 x 1 m"),
    ("circle = { centre = [0.5, 0.5], radius = 0.1 }\n", "", "obstacles[0].circle is missing: it must be a table"),
    ("name = \"wedge\"", "name = \"wedge\"\ncircle = { centre = [0.5, 0.5], radius = 0.1 }", "obstacles[1].polygon = [[1.0, 0.4], [1.3, 0.5], [1.0, 0.6]]: an obstacle has one shape"),
    ("[[1.0, 0.4], [1.3, 0.5], [1.0, 0.6]]", "[[1.0, 0.4], [1.3, 0.5]]", "obstacles[1].polygon = [[1.0, 0.4], [1.3, 0.5]]: must be three or more corners"),
    ("[1.0, 0.6]]", "[1.0, 1.6]]", "must lie inside the domain"),
    ("[[1.0, 0.4], [1.3, 0.5], [1.0, 0.6]]", "[[1.0, 0.4], [1.3, 0.6], [1.3, 0.4], [1.0, 0.6]]", "the edge from corner 0 has no length, or touches another"),
    ("[1.3, 0.5], [1.0, 0.6]]", "[1.3, 0.5], [1.3, 0.5], [1.0, 0.6]]", "has no length, or touches another"),
    ("radius = 0.06", "radius = 0.0", "obstacles[2].parts[0].capsule.radius = 0.0: must be a length above 0, m"),
    ("to = [1.8, 0.7]", "to = [1.6, 0.3]", "obstacles[2].parts[0].capsule.to = [1.6, 0.3]: must be a place [x, y], m, not that of from"),
    ("to = [1.8, 0.7]", "to = [1.97, 0.7]", "...: must lie inside the domain, 2 x 1 m"),
    ("corner = 0.03", "corner = 0.09", "obstacles[2].parts[1].box.corner = 0.09: must be a length from 0 to half its width and height, m"),
    ("size = [0.2, 0.16]", "size = [0.2, 0.0]", "obstacles[2].parts[1].box.size = [0.2, 0.0]: must be two lengths above 0"),
    ("axes = [0.05, 0.04]", "axes = [0.05]", "obstacles[2].parts[2].ellipse.axes = [0.05]"),
    ("axes = [0.05, 0.04]", "axes = [0.05, -0.04]", "obstacles[2].parts[2].ellipse.axes = [0.05, -0.04]: must be two lengths above 0"),
    ("combine = \"subtract\"", "combine = \"cut\"", "obstacles[2].parts[2].combine = \"cut\": must be \"add\", \"subtract\" or \"intersect\""),
    ("radius = 0.06 } }", "radius = 0.06 }, combine = \"intersect\" }", "obstacles[2].parts[0].combine = \"intersect\": there is nothing before the first part"),
    ("{ box = {", "{ circle = { centre = [1.6, 0.3], radius = 0.1 }, box = {", "a part is one figure, of the keys circle, ellipse, box and capsule"),
    ("{ box = {", "{ blob = {", "obstacles[2].parts[1].blob is not a key"),
    ("name = \"key\"", "name = \"key\"\ncircle = { centre = [0.5, 0.5], radius = 0.1 }", "obstacles[2].parts = "),
    ("near = \"ball\"", "near = \"bal\"", "cloud.refine[0].near = \"bal\": must be the name of an obstacle"),
    ("near = \"ball\"\n", "", "cloud.refine[0].near is missing: it must be the name of an obstacle"),
    ("near = \"ball\"", "near = \"ball\"\nbox = [[0.0, 0.0], [1.0, 1.0]]", "cloud.refine[0].box = [[0.0, 0.0], [1.0, 1.0]]: there is near; leave one out"),
    ("[1.2, 0.2]]", "[2.2, 0.2]]", "cloud.refine[1].box = [[1.0, 0.0], [2.2, 0.2]]: must be two corners"),
    ("spacing = 0.02\n[[", "spacing = 0.06\n[[", "cloud.refine[0].spacing = 0.06: must be a length above 0 and at most cloud.spacing, m"),
    ("growth = 0.2", "growth = 0.5", "cloud.refine[1].growth = 0.5: must be a number above 0 and at most 0.3, m/m"),
    ("arrangement = \"relaxed\"", "arrangement = \"random\"", "cloud.arrangement = \"random\": belongs to relaxed points; with [[cloud.refine]] it must be \"relaxed\""),
    ("boundaries = { left = { kind = \"inlet\", velocity = [1.0, 0.0] }, right = { kind = \"outlet\" } }\neffects = { viscosity = { kinematic = 0.01 }, pressure = {},", "effects = { viscosity = { kinematic = 0.01 }, pressure = { form = \"collocated\" },", "effects.pressure = { form = \"collocated\" }: must be there and conservative with [[obstacles]]"),
    ("advection = {}", "advection = { remap = \"forward\" }", "effects.advection.remap = \"forward\": must be \"departure\" with [[obstacles]]"),
    ("on = \"ball\"", "on = \"left\"", "expect.drag.on = \"left\": must be the name of an obstacle"),
    ("on = \"ball\"\n", "", "expect.drag.on is missing: it must be the name of an obstacle"),
    ("component = \"x\"", "component = \"u\"", "expect.drag.component = \"u\": must be \"x\" or \"y\" with measure = \"force\""),
    ("component = \"p\"", "component = \"x\"", "expect.drop.component = \"x\": must be \"u\", \"v\" or \"p\" with measure = \"difference\""),
    ("component = \"velocity\"", "component = \"u\"", "expect.out.component = \"u\": must be \"velocity\" with measure = \"flux\""),
    ("on = \"ball\"", "on = \"ball\"\nline = { x = 0.5 }", "expect.drag.line = { x = 0.5 }: belongs to measures along a line"),
    ("on = \"right\"", "on = \"right\"\nbetween = [[0.0, 0.0], [1.0, 1.0]]", "expect.out.between = [[0.0, 0.0], [1.0, 1.0]]: belongs to the measure difference"),
    ("on = \"right\"", "on = \"outlet\"", "expect.out.on = \"outlet\": must be the name of an obstacle; with measure = \"flux\" also a side"),
    ("[0.6, 0.5]]", "[0.6, 1.5]]", "expect.drop.between = [[0.4, 0.5], [0.6, 1.5]]: must be two places"),
    ("between = [[0.4, 0.5], [0.6, 0.5]]\n", "", "expect.drop.between is missing"),
    ("measure = \"difference\"", "measure = \"minimum\"\nline = { x = 0.5 }", "expect.drop.between = [[0.4, 0.5], [0.6, 0.5]]: belongs to the measures force, difference and flux"),
];

#[test]
fn every_mistake_names_its_key_value_and_remedy() {
    for (from, to, expected) in MISTAKES {
        let text = good();
        assert_eq!(text.matches(from).count(), 1, "{from:?} is to stand in the good case once");
        let message = load(&text.replace(from, to), &[]).expect_err(to);
        assert!(message.contains(expected), "\n  {to:?} says\n  {message:?}, which lacks\n  {expected:?}");
        assert!(!message.contains('\n') && message.starts_with("bad.toml"), "{message:?}");
    }
}

#[test]
fn what_asks_for_lattices_or_repeats_does_not_go_with_varying_spacing() {
    let plain = good()
        .replace(BODIES, "")
        .replace("near = \"ball\"", "near = \"top\"")
        .replace("on = \"ball\"", "on = \"right\"");
    let plain = plain.replace("\"x\"\nmeasure = \"force\"", "\"velocity\"\nmeasure = \"flux\"");
    assert!(load(&plain, &[]).is_ok());
    for (overrides, expected) in [
        (
            "method.operators=integral",
            "method.operators = \"integral\": must be \"interpolation\" with [[cloud.refine]]",
        ),
        ("effects.advection.remap=forward", "must be \"departure\" with [[cloud.refine]]"),
    ] {
        let message = load(&plain, &[overrides]).expect_err(overrides);
        assert!(message.contains(expected), "{message:?} lacks {expected:?}");
    }
    let closed = plain.replace(
        "boundaries = { left = { kind = \"inlet\", velocity = [1.0, 0.0] }, right = { kind = \"outlet\" } }\n",
        "",
    );
    let message = load(&closed, &["domain.periodic=x"]).expect_err("a domain that repeats");
    assert!(message.contains("cloud.refine = "), "{message}");
    assert!(message.contains("it needs domain.periodic = \"none\""), "{message}");
}
