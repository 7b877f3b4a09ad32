//! Points that move: what a case of them needs, what it leaves no room for, and what belongs to them alone.

use std::path::Path;

use stillpoint::case::Case;

const GOOD: &str = r#"title = "A column of water"
domain = { width = 2.0, height = 1.0 }
cloud = { arrangement = "regular", spacing = 0.05, fill = { from = [0.0, 0.0], to = [0.5, 0.5] } }
fluid.density = 1000.0
effects.gravity.acceleration = [0.0, -9.81]
effects.pressure = {}
effects.advection.motion = "lagrangian"
time = { end = 1.0, courant = 0.2 }
output.sensors.wall = { at = [2.0, 0.1] }
"#;

fn load(overrides: &[&str]) -> Result<Case, String> {
    let overrides: Vec<String> = overrides.iter().map(|given| (*given).to_owned()).collect();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases");
    Case::from_text(GOOD, &folder.join("moving.toml"), &overrides).map_err(|error| error.to_string())
}

/// What is set, and the key and the words of the message.
#[rustfmt::skip]
const MISTAKES: &[(&[&str], &str, &str)] = &[
    (&["domain.periodic=x"], "domain.periodic", "must be \"none\" with points that move"),
    (&["boundaries.top.velocity=[1.0, 0.0]"], "boundaries.top.velocity", "must be [0, 0] with points that move"),
    (&["boundaries.top.kind=slip"], "boundaries.top.kind", "must be \"wall\", along which fluid slips, with points that move"),
    (&["effects.advection.remap=forward"], "effects.advection.remap", "must be left out: nothing is carried back"),
    (&["time.courant=0.6"], "time.courant", "must be at most 0.5 with points that move"),
    (&["method.order=3"], "method.order", "must be 2 with points that move"),
    (&["method.operators=integral", "effects.advection.motion=shifted"], "effects.advection.motion", "it needs method.operators = \"interpolation\""),
    (&["cloud.arrangement=random"], "cloud.arrangement", "must be \"regular\" or \"jittered\""),
    (&["method.radius=5.0", "cloud.spacing=0.1"], "domain.height", "must be above 1, twice method.radius in spacings"),
    (&["effects.pressure.form=conservative"], "effects.pressure.form", "must be \"collocated\" with points that move"),
    (&["effects.pressure.form=integral"], "effects.pressure.form", "must be \"collocated\" with points that move"),
    (&["effects.pressure.form=collocated", "method.operators=integral"], "effects.pressure.form", "must be \"integral\" with points that move"),
    (&["effects.pressure.divergence=fit"], "effects.pressure.divergence", "belongs to the conservative form"),
    (&["effects.pressure.gradient=fit"], "effects.pressure.gradient", "belongs to the conservative form"),
    (&["method.operators=integral", "effects.pressure.gradient=adjoint"], "effects.pressure.gradient", "belongs to the conservative form"),
    (&["effects.pressure.gradient=corrected"], "effects.pressure.gradient", "belongs to method.operators = \"integral\""),
    (&["effects.pressure.solver=conjugate_gradient"], "effects.pressure.solver", "is not symmetric"),
    (&["effects.pressure.relaxation=1.5"], "effects.pressure.relaxation", "must be a number from 0 to 1"),
    (&["cloud.fill.from=[-0.1, 0.0]"], "cloud.fill.from", "inside the domain"),
    (&["cloud.fill.to=[2.1, 0.5]"], "cloud.fill.to", "inside the domain"),
    (&["cloud.fill.to=[0.15, 0.5]"], "cloud.fill.to", "must be at least 4 spacings"),
    (&["cloud.fill.to=[2.0, 1.0]"], "cloud.fill.to", "fills the whole domain"),
    (&["cloud.fill.wave.amplitude=0.0", "cloud.fill.wave.half_waves=1"], "cloud.fill.wave.amplitude", "must be a length above 0"),
    (&["cloud.fill.wave.amplitude=0.3", "cloud.fill.wave.half_waves=1"], "cloud.fill.wave.amplitude", "must be at most 0.25"),
    (&["cloud.fill.wave.amplitude=0.1", "cloud.fill.wave.half_waves=0"], "cloud.fill.wave.half_waves", "must be a whole number from 1"),
    (&["output.frame_every=0"], "output.frame_every", "must be a time above 0"),
    (&["output.sensors.wall.at=[2.5, 0.1]"], "output.sensors.wall.at", "inside the domain"),
    // On points that stand.
    (&["effects.advection.motion=fixed"], "cloud.fill", "it needs effects.advection.motion"),
];

#[test]
fn what_does_not_go_with_points_that_move_is_named() {
    load(&[]).expect("the good case");
    load(&["method.operators=integral", "effects.pressure.solver=direct"]).expect("the integral form");
    load(&["method.operators=integral", "effects.pressure.gradient=corrected"]).expect("the corrected gradient");
    load(&["effects.advection.motion=shifted", "cloud.arrangement=jittered"]).expect("shifted points");
    load(&["time.courant=0.8", "time.step=0.001"]).expect("a fixed step");
    for (overrides, key, words) in MISTAKES {
        let message = load(overrides).expect_err(overrides[0]);
        assert!(message.contains(key) && message.contains(words), "{overrides:?} says {message:?}, not {words:?}");
        assert!(!message.contains('\n'), "{message:?} has more than one line");
    }
}

#[test]
fn what_is_absent_is_named() {
    for (line, key) in [
        ("effects.pressure = {}\n", "effects.pressure"),
        (", fill = { from = [0.0, 0.0], to = [0.5, 0.5] }", "cloud.fill"),
    ] {
        let text = GOOD.replace(line, "");
        assert_ne!(text, GOOD);
        let message = Case::from_text(&text, Path::new("moving.toml"), &[]).expect_err(key).to_string();
        assert!(message.contains(&format!("needs the table {key}, which is absent")), "{message}");
    }
}

#[test]
fn what_belongs_to_points_that_move_is_refused_on_others() {
    let text = "title = \"Still\"\ndomain = { width = 1.0, height = 1.0 }\nfluid.density = 1.0\n\
                cloud = { arrangement = \"regular\", spacing = 0.05 }\neffects.pressure = {}\ntime.end = 1.0\n";
    for given in [
        "initial.rotation=1.0",
        "effects.pressure.relaxation=0.1",
        "effects.pressure.form=integral",
        "output.frame_every=0.1",
        "output.sensors.a.at=[0.0, 0.0]",
    ] {
        let error = Case::from_text(text, Path::new("still.toml"), &[given.to_owned()]).expect_err(given).to_string();
        assert!(error.contains("belongs to points that move"), "{given}: {error}");
    }
}

/// An expectation of each measure, and what spoils it.
#[test]
fn expectations_of_points_that_move_take_their_own_keys_alone() {
    let front = "expect.a={ measure = \"front\", profile = \"reference/dam_break_martin_moyce1952_front.csv\", \
                 length = 0.5, duration = 0.2, delay = -0.1, tolerance = 0.1, source = \"a paper\" }";
    let sensor = "expect.a={ measure = \"sensor\", sensor = \"wall\", value = 5.0, after = 0.5, tolerance = 0.1, \
                  source = \"a paper\" }";
    let noise = "expect.a={ measure = \"noise\", sensor = \"wall\", tolerance = 0.1, source = \"a paper\" }";
    let area = "expect.a={ measure = \"area\", tolerance = 0.1, source = \"a paper\" }";
    let period = "expect.a={ measure = \"period\", value = 1.0, tolerance = 0.1, source = \"a paper\" }";
    let energy = "expect.a={ measure = \"energy\", after = 0.1, tolerance = 0.1, source = \"a paper\" }";
    let late = format!("{},{}", front.trim_end_matches('}'), " after = 0.1 }");
    for good in [front, &late, sensor, noise, area, period, energy] {
        load(&[good]).unwrap_or_else(|error| panic!("{error}"));
    }
    for (good, given, words) in [
        (front, "expect.a.after=1.0", "must be a time from 0 to below time.end, s"),
        (front, "expect.a.component=u", "belongs to the other measures, and measure is \"front\""),
        (front, "expect.a.length=0", "must be a length above 0, m"),
        (front, "expect.a.duration=-1", "must be a time above 0, s"),
        (front, "expect.a.value=1.0", "belongs to the measures sensor, period, and measure is \"front\""),
        (front, "expect.a.profile=\"none.csv\"", "no such file"),
        (sensor, "expect.a.sensor=\"floor\"", "must be the name of one of output.sensors"),
        (sensor, "expect.a.value=0", "must be a number other than 0"),
        (sensor, "expect.a.after=1.0", "must be a time from 0 to below time.end, s"),
        (noise, "expect.a.value=1.0", "belongs to the measures sensor, period, and measure is \"noise\""),
        (period, "expect.a.value=-1", "must be a number other than 0"),
        (energy, "expect.a.value=1.0", "belongs to the measures sensor, period, and measure is \"energy\""),
        (area, "expect.a.line={ x = 0.5 }", "belongs to the other measures"),
        (area, "expect.a.delay=0.1", "belongs to the measures front"),
        (sensor, "expect.a.measure=front", "belongs to the measures sensor, noise"),
    ] {
        let message = load(&[good, given]).expect_err(given);
        assert!(message.contains(words), "{given} says {message:?}, not {words:?}");
    }
    for lacking in ["sensor = \"wall\", ", "value = 5.0, "] {
        let key = lacking.split(' ').next().unwrap_or_default();
        let message = load(&[&sensor.replace(lacking, "")]).expect_err(key);
        assert!(message.contains(&format!("expect.a.{key} is missing")), "{message}");
    }
}

#[test]
fn steps_of_points_that_move_are_shorter_unless_the_case_says_otherwise() {
    let courant = |text: &str, change: &str| {
        let changes = [change.to_owned()];
        let case = Case::from_text(text, Path::new("moving.toml"), &changes).expect("a case");
        assert_eq!(case.time.courant, Some(case.courant()));
        case.courant()
    };
    let open = GOOD.replace(", courant = 0.2", "");
    for motion in ["lagrangian", "shifted"] {
        assert!((courant(&open, &format!("effects.advection.motion={motion}")) - 0.2).abs() < 1e-12);
    }
    assert!((courant(&open, "time.courant=0.3") - 0.3).abs() < 1e-12);
    let still = "title = 'still'\ndomain = { width = 1.0, height = 1.0 }\ncloud = { arrangement = 'regular', spacing = 0.1 }\n\
                 fluid.density = 1.0\neffects.viscosity.kinematic = 0.01\ntime.end = 1.0\n";
    assert!((courant(still, "title=still") - 0.8).abs() < 1e-12);
}
