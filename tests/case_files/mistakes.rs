//! One mistake a row, and the words that a user gets for it.

use super::{edited, load};

/// What stands in the good case, what takes its place, and the whole message.
#[rustfmt::skip]
const MISTAKES: &[(&str, &str, &str)] = &[
    // TOML itself.
    ("[domain]", "[domain", "bad.toml:2: not valid TOML: "),
    ("\"Cavity\"", "\"Cavity", "bad.toml:1: not valid TOML: "),
    ("\"Cavity\"", "Cavity", "bad.toml:1: not valid TOML: string values must be quoted"),
    ("width = 1.0", "width = 1,0", "bad.toml:3: not valid TOML: "),
    ("width = 1.0", "width = 1.0\nwidth = 2.0", "bad.toml:4: not valid TOML: duplicate key"),
    // Keys.
    ("spacing = 0.1", "spacng = 0.1", "bad.toml:7: cloud.spacng is not a key (did you mean cloud.spacing?); [cloud] has arrangement, spacing, jitter, minimum_distance, seed"),
    ("title = \"Cavity\"", "titel = \"Cavity\"", "bad.toml:1: titel is not a key (did you mean title?); a case file has title, domain, cloud,"),
    ("width = 1.0", "width = 1.0\nspacing = 0.1", "bad.toml:4: domain.spacing is not a key (did you mean cloud.spacing?); [domain] has width, height, periodic"),
    ("kinematic = 0.01", "kinematic = 0.01\nlaw = 3", "bad.toml:16: effects.viscosity.law is not a key; [effects.viscosity] has kinematic"),
    ("top.velocity = [1.0, 0.0]", "lid.velocity = [1.0, 0.0]", "bad.toml:11: boundaries.lid is not a key; [boundaries] has left, right, bottom, top"),
    ("value = -0.2", "vlaue = -0.2", "bad.toml:29: expect.u_min.vlaue is not a key (did you mean expect.u_min.value?)"),
    ("spacing = 0.1\n", "", "bad.toml:5: cloud.spacing is missing: it must be a length above 0, m"),
    ("[fluid]\ndensity = 1.0\n", "", "bad.toml: fluid is missing: it must be a table with the key density"),
    ("kinematic = 0.01\n", "", "bad.toml:14: effects.viscosity.kinematic is missing: it must be a number above 0, m^2/s"),
    ("component = \"u\"\nline = { x = 0.5 }\nmeasure = \"minimum\"", "line = { x = 0.5 }\nmeasure = \"minimum\"", "bad.toml:25: expect.u_min.component is missing: it must be \"u\", \"v\", \"p\", \"temperature\" or \"tracer\"; \"velocity\", \"gradient\""),
    // Kinds of values.
    ("spacing = 0.1", "spacing = \"fine\"", "bad.toml:7: cloud.spacing = \"fine\": must be a length above 0, m"),
    ("spacing = 0.1", "spacing = nan", "bad.toml:7: cloud.spacing = NaN: must be a length above 0, m; it is not finite"),
    ("end = 60.0", "end = inf", "bad.toml:21: time.end = inf: must be a time above 0, s; it is not finite"),
    ("end = 60.0", "end = 2026-01-01", "bad.toml:21: time.end = 2026-01-01: must be a time above 0, s"),
    ("arrangement = \"random\"", "arrangement = \"randm\"", "bad.toml:6: cloud.arrangement = \"randm\": must be \"regular\", \"jittered\", \"random\" or \"relaxed\" (did you mean random?)"),
    ("arrangement = \"random\"", "arrangement = 3", "bad.toml:6: cloud.arrangement = 3: must be \"regular\", \"jittered\", \"random\" or \"relaxed\""),
    ("[1.0, 0.0]", "[1.0]", "bad.toml:11: boundaries.top.velocity = [1.0]: must be two numbers [along x, along y], m/s"),
    ("[1.0, 0.0]", "[1.0, 0.0, 0.0]", "bad.toml:11: boundaries.top.velocity = [1.0, 0.0, 0.0]: must be two numbers"),
    ("[1.0, 0.0]", "[1.0, nan]", "bad.toml:11: boundaries.top.velocity[1] = NaN: must be two numbers [along x, along y], m/s; it is not finite"),
    ("top.velocity = [1.0, 0.0]", "top = 1.0", "bad.toml:11: boundaries.top = 1.0: must be a table with keys among kind, velocity, profile"),
    ("report_every = 10", "report_every = -1", "bad.toml:24: output.report_every = -1: must be a whole number from 1"),
    ("report_every = 10", "report_every = 0", "bad.toml:24: output.report_every = 0: must be a whole number from 1"),
    ("report_every = 10", "pictures = 1", "bad.toml:24: output.pictures = 1: must be true or false"),
    ("title = \"Cavity\"", "title = \"two\\nlines\"", "bad.toml:1: title = \"two\\nlines\": must be one line of text"),
    ("title = \"Cavity\"", "title = \" \"", "bad.toml:1: title = \" \": must be one line of text"),
    // The domain, the points and the walls.
    ("width = 1.0", "width = 0", "bad.toml:3: domain.width = 0: must be a length above 0, m"),
    ("height = 1.5", "height = -1.5", "bad.toml:4: domain.height = -1.5: must be a length above 0, m"),
    ("spacing = 0.1", "spacing = 0", "bad.toml:7: cloud.spacing = 0: must be a length above 0, m"),
    ("spacing = 0.1", "spacing = -0.1", "bad.toml:7: cloud.spacing = -0.1: must be a length above 0, m"),
    ("spacing = 0.1", "spacing = 0.11", "bad.toml:7: cloud.spacing = 0.11: must divide both sides of the domain, 1 x 1.5 m; the nearest spacing that does is 0.1"),
    ("height = 1.5", "height = 1.0003000001", "bad.toml:7: cloud.spacing = 0.1: must divide both sides of the domain, 1 x 1.0003000001 m; no spacing near it does"),
    ("spacing = 0.1", "spacing = 0.5", "bad.toml:7: cloud.spacing = 0.5: must be at most 0.25, 4 spacings to the shorter side of 1 x 1.5 m"),
    ("spacing = 0.1", "spacing = 1e-5", "bad.toml:7: cloud.spacing = 1e-5: gives about 1.5e10 points, more than 1e8; take a larger spacing"),
    ("spacing = 0.1", "spacing = 1e-300", "bad.toml:7: cloud.spacing = 1e-300: gives about inf points, more than 1e8"),
    ("spacing = 0.1", "spacing = 0.1\njitter = 0.2", "bad.toml:8: cloud.jitter = 0.2: belongs to jittered points, and cloud.arrangement is \"random\""),
    ("arrangement = \"random\"", "arrangement = \"regular\"\nseed = 1", "bad.toml:7: cloud.seed = 1: belongs to jittered, random or relaxed points, and cloud.arrangement is \"regular\""),
    ("arrangement = \"random\"", "arrangement = \"regular\"\nminimum_distance = 0.7", "bad.toml:7: cloud.minimum_distance = 0.7: belongs to random points"),
    ("arrangement = \"random\"", "arrangement = \"jittered\"\njitter = 0.5", "bad.toml:7: cloud.jitter = 0.5: must be a number from 0 to below 0.5, in spacings"),
    ("arrangement = \"random\"", "arrangement = \"jittered\"\njitter = -0.1", "bad.toml:7: cloud.jitter = -0.1: must be a number from 0"),
    ("spacing = 0.1", "spacing = 0.1\nminimum_distance = 0", "bad.toml:8: cloud.minimum_distance = 0: must be a number from 0.1 to 0.75, in spacings"),
    ("spacing = 0.1", "spacing = 0.1\nminimum_distance = 0.76", "bad.toml:8: cloud.minimum_distance = 0.76: must be a number from 0.1 to 0.75"),
    ("spacing = 0.1", "spacing = 0.1\nseed = -1", "bad.toml:8: cloud.seed = -1: must be a whole number from 0"),
    ("density = 1.0", "density = 0.0", "bad.toml:9: fluid.density = 0.0: must be a number above 0, kg/m^3"),
    ("[1.0, 0.0]", "[1.0, 0.5]", "bad.toml:11: boundaries.top.velocity = [1.0, 0.5]: must be along the wall, [u, 0]: a solid wall lets no fluid through"),
    ("top.velocity", "left.velocity", "bad.toml:11: boundaries.left.velocity = [1.0, 0.0]: must be along the wall, [0, v]"),
    ("radius = 2.8", "radius = 1.5", "bad.toml:13: method.radius = 1.5: must be a number above 1.5 and at most 5, in spacings"),
    ("radius = 2.8", "radius = 5.5", "bad.toml:13: method.radius = 5.5: must be a number above 1.5 and at most 5"),
    // A domain that repeats, and exact solutions.
    ("height = 1.5", "height = 1.5\nperiodic = \"z\"", "bad.toml:5: domain.periodic = \"z\": must be \"none\", \"x\", \"y\" or \"both\""),
    ("height = 1.5", "height = 1.5\nperiodic = \"y\"", "bad.toml:12: boundaries.top.velocity = [1.0, 0.0]: the domain repeats along y (domain.periodic), so that there is no wall; leave it out"),
    ("height = 1.5", "height = 1.5\nperiodic = \"x\"", "bad.toml:3: domain.width = 1.0: must be above 1.1"),
    ("radius = 2.8", "radius = 2.8\n[exact]\nsolution = \"stokes\"", "bad.toml:15: exact.solution = \"stokes\": must be \"taylor_green\", \"kovasznay\""),
    ("radius = 2.8", "radius = 2.8\n[exact]\nspeed = 1.0", "bad.toml:15: exact.speed is not a key; [exact] has solution"),
    ("radius = 2.8", "radius = 2.8\n[exact]\nsolution = \"kovasznay\"", "bad.toml:11: boundaries.top.velocity = [1.0, 0.0]: the exact solution (exact.solution) prescribes the velocity of every wall; leave out one of them"),
    ("top.velocity = [1.0, 0.0]\n", "[exact]\nsolution = \"taylor_green\"\n", "bad.toml:12: exact.solution = \"taylor_green\": repeats along x and y: it needs domain.periodic = \"both\""),
    // The effects and the time.
    ("kinematic = 0.01", "kinematic = -0.01", "bad.toml:15: effects.viscosity.kinematic = -0.01: must be a number above 0, m^2/s (for none, leave out the table"),
    ("form = \"conservative\"", "form = \"collocated\"\nsolver = \"conjugate_gradient\"", "bad.toml:18: effects.pressure.solver = \"conjugate_gradient\": the collocated matrix (effects.pressure.form) is not symmetric: conjugate gradients do not apply; use bicgstab"),
    ("form = \"conservative\"", "form = \"collocated\"\ngradient = \"fit\"", "bad.toml:18: effects.pressure.gradient = \"fit\": belongs to the conservative form"),
    ("form = \"conservative\"", "form = \"conservative\"\ngradient = \"corrected\"", "bad.toml:18: effects.pressure.gradient = \"corrected\": belongs to the form \"integral\", of points that move"),
    ("form = \"conservative\"", "preconditioner = \"ilu\"", "bad.toml:17: effects.pressure.preconditioner = \"ilu\": must be \"jacobi\" or \"multigrid\""),
    ("form = \"conservative\"", "solver = \"direct\"\npreconditioner = \"jacobi\"", "bad.toml:18: effects.pressure.preconditioner = \"jacobi\": belongs to an iterative solver, and effects.pressure.solver is \"direct\""),
    ("form = \"conservative\"", "solver = \"bicgstab\"\npreconditioner = \"multigrid\"", "bad.toml:18: effects.pressure.preconditioner = \"multigrid\": must be \"jacobi\" with effects.pressure.solver = \"bicgstab\""),
    ("form = \"conservative\"", "tolerance = 0", "bad.toml:17: effects.pressure.tolerance = 0: must be a number above 0 and below 1"),
    ("form = \"conservative\"", "max_iterations = 0", "bad.toml:17: effects.pressure.max_iterations = 0: must be a whole number from 1"),
    ("form = \"conservative\"", "solver = \"cg\"", "bad.toml:17: effects.pressure.solver = \"cg\": must be \"conjugate_gradient\", \"bicgstab\" or \"direct\""),
    ("remap = \"departure\"\n[time]\nend = 60.0\ncourant = 0.8", "remap = \"forward\"\n[time]\nend = 60.0\ncourant = 1.5", "bad.toml:22: time.courant = 1.5: must be at most 1 with effects.advection.remap = \"forward\""),
    ("courant = 0.8", "courant = 0", "bad.toml:22: time.courant = 0: must be a number above 0 and at most 50"),
    ("courant = 0.8", "courant = 51", "bad.toml:22: time.courant = 51: must be a number above 0 and at most 50"),
    ("end = 60.0", "end = 0", "bad.toml:21: time.end = 0: must be a time above 0, s"),
    ("courant = 0.8", "step = 61", "bad.toml:22: time.step = 61: must be a time above 0 and at most time.end, s"),
    ("courant = 0.8", "step = 1e-9", "bad.toml:22: time.step = 1e-9: more than 1e9 steps until time.end"),
    ("courant = 0.8", "steady = 0", "bad.toml:22: time.steady = 0: must be a number above 0, m/s^2"),
    ("[effects.viscosity]\nkinematic = 0.01\n[effects.pressure]\nform = \"conservative\"\n[effects.advection]\nremap = \"departure\"\n", "[effects]\n", "bad.toml:14: effects = {}: nothing to compute: give at least one of effects.viscosity, effects.pressure, effects.advection"),
    ("[effects.viscosity]\nkinematic = 0.01\n[effects.pressure]\nform = \"conservative\"\n[effects.advection]\nremap = \"departure\"\n", "", "bad.toml: effects: nothing to compute"),
    // What is expected.
    ("value = -0.2\n", "", "bad.toml:25: expect.u_min.value is missing: it must be a number other than 0"),
    ("value = -0.2", "value = 0", "bad.toml:29: expect.u_min.value = 0: must be a number other than 0 (its error is relative)"),
    ("value = -0.2", "value = -0.2\nprofile = \"profile.csv\"", "bad.toml:30: expect.u_min.profile = \"profile.csv\": belongs to the measure profile"),
    ("value = -0.2", "value = -0.2\ncolumn = \"u\"", "bad.toml:30: expect.u_min.column = \"u\": belongs to the measure profile"),
    ("profile = \"profile.csv\"\n", "value = 1.0\n", "bad.toml:36: expect.u_all.value = 1.0: belongs to the measures minimum, maximum and slope"),
    ("profile = \"profile.csv\"\ncolumn = \"u\"\n", "", "bad.toml:32: expect.u_all.profile is missing: it must be the path of a CSV file, from the case file's folder"),
    ("\"profile.csv\"", "\"none.csv\"", "bad.toml:36: expect.u_all.profile = \"none.csv\": none.csv: no such file"),
    ("\"profile.csv\"", "\".\"", "a folder, where a file was expected"),
    ("column = \"u\"", "column = \"w\"", "bad.toml:36: expect.u_all.profile = \"profile.csv\": profile.csv: no column w; it has y, u"),
    ("height = 1.5", "height = 1.0", "bad.toml:36: expect.u_all.profile = \"profile.csv\": has a row at 1.5 m, off the line, which is 1 m long"),
    ("line = { x = 0.5 }\nmeasure = \"minimum\"", "line = { x = 1.5 }\nmeasure = \"minimum\"", "bad.toml:27: expect.u_min.line = { x = 1.5 }: must be { x = NUMBER } or { y = NUMBER }, m, inside the domain"),
    ("line = { x = 0.5 }\nmeasure = \"minimum\"", "line = { y = -0.5 }\nmeasure = \"minimum\"", "bad.toml:27: expect.u_min.line = { y = -0.5 }: must be { x = NUMBER }"),
    ("line = { x = 0.5 }\nmeasure = \"minimum\"", "line = { z = 0.5 }\nmeasure = \"minimum\"", "bad.toml:27: expect.u_min.line = { z = 0.5 }: must be { x = NUMBER }"),
    ("line = { x = 0.5 }\nmeasure = \"minimum\"", "line = { x = 0.5, y = 0.5 }\nmeasure = \"minimum\"", "bad.toml:27: expect.u_min.line = { x = 0.5, y = 0.5 }: must be { x = NUMBER }"),
    ("line = { x = 0.5 }\nmeasure = \"minimum\"", "line = { x = \"a\" }\nmeasure = \"minimum\"", "bad.toml:27: expect.u_min.line.x = \"a\": must be { x = NUMBER }"),
    ("value = -0.2\ntolerance = 0.01", "value = -0.2\ntolerance = 0", "bad.toml:30: expect.u_min.tolerance = 0: must be a number above 0, relative"),
    ("tolerance = 0.01\nsource = \"a paper\"\n[", "tolerance = 0.01\nsource = \"\"\n[", "bad.toml:31: expect.u_min.source = \"\": must be a line that says where the value was published"),
    ("line = { x = 0.5 }\nmeasure = \"minimum\"", "measure = \"minimum\"", "bad.toml:25: expect.u_min.line is missing: it must be { x = NUMBER } or { y = NUMBER }"),
    ("measure = \"minimum\"", "measure = \"error\"", "bad.toml:28: expect.u_min.measure = \"error\": there is no exact solution: the table exact is absent"),
    ("component = \"u\"\nline = { x = 0.5 }\nmeasure = \"minimum\"", "component = \"velocity\"\nline = { x = 0.5 }\nmeasure = \"minimum\"", "bad.toml:26: expect.u_min.component = \"velocity\": belongs to other measures"),
    ("courant = 0.8", "courant = 0.8\n[guard]\nretries = 21", "bad.toml:24: guard.retries = 21: must be a whole number from 0 to 20"),
    ("courant = 0.8", "courant = 0.8\n[guard]\nretries = -1", "bad.toml:24: guard.retries = -1: must be a whole number from 0 to 20"),
    ("courant = 0.8", "courant = 0.8\n[guard]\nenergy = 1.0", "bad.toml:24: guard.energy = 1.0: must be a number above 1"),
    ("[expect.u_min]", "[expect.\"u min\"]", "bad.toml:25: expect.\"u min\" = {"),
];

#[test]
fn every_mistake_names_its_line_key_value_and_remedy() {
    for (from, to, expected) in MISTAKES {
        let message = load(&edited(from, to), &[]).expect_err(to);
        assert!(message.contains(expected), "\n  {to:?} says\n  {message:?}, which lacks\n  {expected:?}");
        assert!(!message.contains('\n'), "{message:?} has more than one line");
        assert!(message.starts_with("bad.toml"), "{message:?} does not start with the file");
    }
}
