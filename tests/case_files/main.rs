//! Case files, good and bad: what each mistake says, on one line, and that `--set` reaches the case.

mod mistakes;
mod moving;
mod obstacles;

use std::fs;
use std::path::{Path, PathBuf};

use stillpoint::case::{Case, Gradient, Preconditioner, Problem, Solver};

/// A right case; each test below spoils or changes one thing of it.
const GOOD: &str = r#"title = "Cavity"
[domain]
width = 1.0
height = 1.5
[cloud]
arrangement = "random"
spacing = 0.1
[fluid]
density = 1.0
[boundaries]
top.velocity = [1.0, 0.0]
[method]
radius = 2.8
[effects.viscosity]
kinematic = 0.01
[effects.pressure]
form = "conservative"
[effects.advection]
remap = "departure"
[time]
end = 60.0
courant = 0.8
[output]
report_every = 10
[expect.u_min]
component = "u"
line = { x = 0.5 }
measure = "minimum"
value = -0.2
tolerance = 0.01
source = "a paper"
[expect.u_all]
component = "u"
line = { x = 0.5 }
measure = "profile"
profile = "profile.csv"
column = "u"
tolerance = 0.01
source = "a paper"
"#;

/// A folder with the profile that `GOOD` names.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fs::write(folder.path().join("profile.csv"), "y,u\n0.0,0.0\n1.5,1.0\n").expect("a profile");
    folder
}

fn load(text: &str, overrides: &[&str]) -> Result<Case, String> {
    let folder = folder();
    let overrides: Vec<String> = overrides.iter().map(|given| (*given).to_owned()).collect();
    let message = |error: stillpoint::case::CaseError| error.to_string();
    let case = Case::from_text(text, &folder.path().join("bad.toml"), &overrides);
    let trim = |text: String| text.replace(&format!("{}/", folder.path().display()), "");
    case.map_err(|error| trim(message(error)))
}

fn edited(from: &str, to: &str) -> String {
    assert_eq!(GOOD.matches(from).count(), 1, "{from:?} is to stand in the good case once");
    GOOD.replace(from, to)
}

fn shipped() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases");
    let entries = fs::read_dir(folder).expect("the folder of cases").map(|entry| entry.expect("an entry").path());
    entries.filter(|path| path.extension().is_some_and(|extension| extension == "toml")).collect()
}

#[test]
fn the_good_case_is_good_and_completed() {
    let case = load(GOOD, &[]).expect("the good case");
    assert_eq!((case.cloud.minimum_distance, case.cloud.seed, case.cloud.jitter), (Some(0.7), Some(1), None));
    let pressure = case.effects.pressure.as_ref().expect("a pressure");
    assert_eq!((pressure.solver, pressure.gradient), (Some(Solver::ConjugateGradient), Some(Gradient::Fit)));
    assert_eq!(pressure.preconditioner, Some(Preconditioner::Multigrid));
    assert_eq!(case.point_estimate(), 11.0 * 16.0);
    let json = serde_json::to_string(&case).expect("a case as JSON");
    assert_eq!(serde_json::from_str::<Case>(&json).expect("a case from JSON"), case);
}

#[test]
fn defaults_that_depend_on_other_keys_are_filled_in() {
    let jittered = load(&edited("\"random\"", "\"jittered\""), &[]).expect("a jittered case");
    assert_eq!((jittered.cloud.jitter, jittered.cloud.minimum_distance), (Some(0.4), None));
    let regular = load(&edited("\"random\"", "\"regular\""), &[]).expect("a regular case");
    assert_eq!((regular.cloud.jitter, regular.cloud.minimum_distance, regular.cloud.seed), (None, None, None));
    let collocated = load(GOOD, &["effects.pressure.form=collocated"]).expect("a collocated case");
    let pressure = collocated.effects.pressure.as_ref().expect("a pressure");
    assert_eq!((pressure.solver, pressure.gradient), (Some(Solver::Bicgstab), None));
    assert_eq!(pressure.preconditioner, Some(Preconditioner::Jacobi));
    let direct = load(GOOD, &["effects.pressure.solver=direct"]).expect("a case solved directly");
    assert_eq!(direct.effects.pressure.expect("a pressure").preconditioner, None);
}

#[test]
fn pressure_is_expected_only_where_it_is_computed() {
    let text = edited("[effects.pressure]\nform = \"conservative\"\n", "");
    assert!(load(&text, &[]).is_ok());
    let message = load(&text, &["expect.u_min.component=p"]).expect_err("a pressure without its effect");
    assert!(message.contains("--set expect.u_min.component=p: expect.u_min.component = \"p\": there is no pressure"));
}

#[test]
fn set_changes_values_of_every_kind_and_makes_tables() {
    let overrides = [
        "cloud.spacing=0.05",
        "title=A = B",
        "boundaries.bottom.velocity=[0.5, 0.0]",
        "method.weight=none",
        "output.pictures=false",
        "cloud.seed = 7",
        "cloud.seed=8",
    ];
    let case = load(GOOD, &overrides).expect("a changed case");
    let expected = edited("spacing = 0.1", "spacing = 0.05\nseed = 8")
        .replace("\"Cavity\"", "\"A = B\"")
        .replace("[boundaries]", "[boundaries]\nbottom.velocity = [0.5, 0.0]")
        .replace("[method]", "[method]\nweight = \"none\"")
        .replace("[output]", "[output]\npictures = false");
    let mut expected = load(&expected, &[]).expect("the same case, written out");
    for (name, expectation) in &mut expected.expect {
        expectation.profile = case.expect[name].profile.clone();
    }
    assert_eq!(case, expected);
    let bare = edited("[effects.viscosity]\nkinematic = 0.01\n", "");
    assert_eq!(load(&bare, &[]).expect("no viscosity").effects.viscosity, None);
    let viscous = load(&bare, &["effects.viscosity.kinematic=0.5"]).expect("a viscosity that --set made");
    assert_eq!(viscous.effects.viscosity.map(|viscosity| viscosity.kinematic), Some(0.5));
}

#[test]
fn a_wrong_set_is_named() {
    for (given, expected) in [
        ("cloud.spacng=0.1", "--set cloud.spacng=0.1: cloud.spacng is not a key (did you mean cloud.spacing?)"),
        ("nu=1", "--set nu=1: nu is not a key; a case file has title"),
        ("effects.lift.factor=1", "--set effects.lift.factor=1: effects.lift is not a key; [effects] has viscosity"),
        ("cloud.spacing=-1", "--set cloud.spacing=-1: cloud.spacing = -1: must be a length above 0, m"),
        ("cloud.spacing=0.1m", "--set cloud.spacing=0.1m: cloud.spacing = \"0.1m\": must be a length above 0, m"),
        ("cloud.spacing.x=1", "--set cloud.spacing.x=1: cloud.spacing is not a table"),
        ("title.x=1", "--set title.x=1: title is not a table"),
        ("effects.viscosity={}", "--set effects.viscosity={}: effects.viscosity.kinematic is missing"),
        ("cloud.spacing", "--set cloud.spacing: expected key=value"),
        ("cloud.spacing=", "--set cloud.spacing=: expected key=value"),
        ("=1", "--set =1: expected key=value"),
        ("cloud..spacing=1", "--set cloud..spacing=1: expected key=value"),
        ("title=\"a", "--set title=\"a: \"a is not a TOML value: "),
        ("cloud.spacing=[1", "--set cloud.spacing=[1: [1 is not a TOML value: "),
        ("a.b.c.d.e.f.g.h.i=1", "--set a.b.c.d.e.f.g.h.i=1: no key is 8 tables deep"),
        ("cloud.spacing=1\n[x]", "--set cloud.spacing=1\\n[x]: cloud.spacing = \"1\\n[x]\": must be a length"),
    ] {
        let message = load(GOOD, &[given]).expect_err(given);
        assert!(message.starts_with(expected), "\n  {given:?} says\n  {message:?}, not\n  {expected:?}");
        assert!(!message.contains('\n'), "{message:?} has more than one line");
    }
}

#[test]
fn files_that_cannot_be_read_are_named() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    fs::write(at("latin1.toml"), b"# one\n# two\ntitle = \"Hohlr\xe4ume\"\n").expect("a file");
    fs::write(at("large.toml"), vec![b'#'; (1 << 20) + 1]).expect("a file");
    fs::write(at("empty.toml"), "").expect("a file");
    for (name, expected) in [
        ("absent.toml", "absent.toml: no such file"),
        (".", "a folder, where a file was expected"),
        ("latin1.toml", "latin1.toml:3: not UTF-8 text"),
        ("large.toml", "large.toml: larger than 1048576 bytes"),
        ("empty.toml", "empty.toml: title is missing: it must be one line of text"),
    ] {
        let message = Case::load(&at(name), &[]).expect_err(name).to_string();
        assert!(message.contains(expected), "{message:?} lacks {expected:?}");
    }
    fs::write(at("marked.toml"), format!("\u{feff}{}", GOOD.replace('\n', "\r\n"))).expect("a file");
    Case::load(&at("marked.toml"), &[]).expect("a case with a byte order mark and CRLF");
}

#[test]
fn every_shipped_case_loads_and_finds_its_profiles() {
    let cases = shipped();
    assert!(cases.len() >= 6, "{cases:?}");
    for path in cases {
        let case = Case::load(&path, &[]).unwrap_or_else(|error| panic!("{error}"));
        let profiles: Vec<_> = case.expect.values().filter_map(|expectation| expectation.profile.as_ref()).collect();
        // Problems without time are held to known fields, exact flows to the whole flow, obstacles to their forces.
        let published = case.problem() == Problem::Flow && case.exact.is_none();
        // Of points that move, those have one that an experiment shows.
        if !case.moves() {
            assert!(!case.expect.is_empty() && (published || profiles.is_empty()), "{}", path.display());
        }
        assert!(profiles.iter().all(|profile| profile.is_file()), "{profiles:?}");
    }
}

/// A case that an exact solution solves, and what is wrong beside it.
#[test]
fn what_does_not_go_with_an_exact_solution_is_named() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/taylor_green.toml");
    let load = |overrides: &[&str]| {
        let overrides: Vec<String> = overrides.iter().map(|given| (*given).to_owned()).collect();
        Case::load(&path, &overrides).map_err(|error| error.to_string())
    };
    let case = load(&["domain.width=2.0"]).expect("two vortices side by side");
    // The lines of points are half a spacing off the seam, and none is there twice.
    assert_eq!(case.point_estimate(), 128.0 * 64.0);
    for (overrides, expected) in [
        (
            &["domain.width=1.5"][..],
            "exact.solution = \"taylor_green\": has square vortices, as long as the shorter side",
        ),
        (&["cloud.spacing=0.125"], "domain.width = 1.0: must be above 1.3, 4 times method.radius in spacings"),
        (
            &["exact.solution=kovasznay"],
            "prescribes the velocity on all four sides: it needs domain.periodic = \"none\"",
        ),
        (&["expect.velocity.line={ x = 0.5 }"], "belongs to the other measures: an error is over all points"),
        (
            &["expect.velocity.value=1.0"],
            "expect.velocity.value = 1.0: belongs to the measures minimum, maximum and slope",
        ),
        (&["expect.velocity.profile=a.csv"], "belongs to the measure profile, which this is not"),
    ] {
        let message = load(overrides).expect_err(overrides[0]);
        assert!(message.contains(expected), "\n  {overrides:?} says\n  {message:?}, not\n  {expected:?}");
    }
}

/// Heat, buoyancy and tracers, and what is senseless beside them.
#[test]
fn what_does_not_go_with_heat_and_tracers_is_named() {
    let text = "title = \"Warm\"\ndomain = { width = 1.0, height = 1.0 }\nfluid.density = 1.0\n\
                cloud = { arrangement = \"regular\", spacing = 0.05 }\ntime.end = 1.0\n";
    let tracer = "effects.tracers=[{ name = 'c', shape = 'disc', centre = [0.5, 0.5], radius = 0.2 }]";
    let heat = "effects.heat.diffusivity=0.1";
    for (overrides, expected) in [
        (
            &[heat, "effects.buoyancy.expansion=0.1"][..],
            "effects.buoyancy: is the weight of warm fluid, and the table effects.gravity",
        ),
        (
            &["effects.gravity.acceleration=[0.0, -1.0]", "effects.buoyancy.expansion=0.1"],
            "effects.buoyancy: is the weight of warm fluid, and the table effects.heat is absent",
        ),
        (
            &["effects.advection.remap=departure", "boundaries.left.temperature=1.0"],
            "boundaries.left.temperature: there is no heat",
        ),
        (
            &[heat, "boundaries.left.temperature=1.0", "boundaries.left.heat_flux=1.0"],
            "boundaries.left.heat_flux: the side is held at boundaries",
        ),
        (
            &[heat, "domain.periodic=x", "boundaries.left.heat_flux=1.0"],
            "boundaries.left.heat_flux: the domain repeats there",
        ),
        (
            &["effects.pressure.form=conservative", "boundaries.left={ kind = 'inlet', velocity = [1.0, 0.0] }"],
            "boundaries.left.kind: needs another side",
        ),
        (
            &[
                "effects.pressure.form=conservative",
                "boundaries.left={ kind = 'inlet', velocity = [-1.0, 0.0] }",
                "boundaries.right.kind=outlet",
            ],
            "boundaries.left.kind: needs boundaries.*.velocity of this side",
        ),
        (&[heat, "boundaries.right.kind=outlet"], "boundaries.right.kind: needs the pressure"),
        (
            &["effects.pressure.form=collocated", "boundaries.left={ kind = 'inlet', velocity = [1.0, 0.0] }"],
            "boundaries.left.kind: needs another side",
        ),
        (
            &["effects.pressure.form=conservative", "domain.periodic=x", "boundaries.right.kind=slip"],
            "boundaries.right.kind: the domain repeats",
        ),
        (
            &["effects.pressure.form=conservative", "boundaries.right={ kind = 'slip', velocity = [0.0, 1.0] }"],
            "boundaries.right.kind: takes its velocity from the fluid",
        ),
        (&["effects.heat.diffusivity=0.0"], "effects.heat.diffusivity: must be a number above 0"),
        (&[heat, "effects.advection.remap=forward"], "effects.advection.remap: carries the velocity alone"),
        (&[heat, "time.steady=0.1"], "time.steady: no effect changes the velocity"),
        (&[tracer], "effects.tracers[0].diffusivity: nothing moves it"),
        (
            &[
                "effects.advection.remap=departure",
                "effects.tracers=[{ name = 'p', shape = 'disc', centre = [0.5, 0.5], radius = 0.2 }]",
            ],
            "effects.tracers[0].name: must be a name of letters",
        ),
        (
            &[
                "effects.advection.remap=departure",
                "effects.tracers=[{ name = 'c', shape = 'box', centre = [0.5, 0.5], radius = 0.2 }]",
            ],
            "effects.tracers[0].radius: belongs to another shape",
        ),
        (
            &[
                "effects.advection.remap=departure",
                "effects.tracers=[{ name = 'c', shape = 'box', centre = [0.5, 0.5] }]",
            ],
            "effects.tracers[0].size: it must be two lengths",
        ),
        (&["effects.gravity.acceleration=[0.0, 0.0]"], "effects.gravity.acceleration: must be two numbers"),
        (
            &[
                tracer,
                "effects.advection.remap=departure",
                "effects.viscosity.kinematic=0.1",
                "exact.solution=rotation",
            ],
            "exact.solution: prescribes the velocity",
        ),
        (
            &["effects.advection.remap=departure", "exact.solution=rotation"],
            "exact.solution: carries fields, and there is neither",
        ),
        (
            &["effects.viscosity.kinematic=0.1", "domain.periodic=x", "exact.solution=couette"],
            "exact.solution: is driven by boundaries",
        ),
        (
            &["effects.viscosity.kinematic=0.1", "domain.periodic=x", "exact.solution=poiseuille"],
            "exact.solution: is driven by effects.gravity",
        ),
        (&[heat, "exact.solution=conduction"], "exact.solution: needs boundaries.left.temperature"),
        (
            &[
                heat,
                "expect.a={ component = 'temperature', measure = 'slope', value = 1.0, tolerance = 0.1, source = 's' }",
            ],
            "expect.a.side: it must be",
        ),
        (
            &[heat, "expect.a={ component = 'tracer', measure = 'loss', tracer = 'c', tolerance = 0.1, source = 's' }"],
            "expect.a.tracer: must be the name of one of effects.tracers",
        ),
    ] {
        let overrides: Vec<String> = overrides.iter().map(|given| (*given).to_owned()).collect();
        let error = Case::from_text(text, Path::new("bad.toml"), &overrides).expect_err("a mistake").to_string();
        let (key, words) = expected.split_once(": ").expect("a key and words");
        assert!(error.contains(key) && error.contains(words), "{overrides:?}: {error}, not {expected}");
        assert!(!error.contains('\n'), "{error}");
    }
}

/// Problems without time, and what is wrong beside them.
#[test]
fn what_does_not_go_with_a_problem_without_time_is_named() {
    let text = "title = \"Problem\"\ndomain = { width = 1.0, height = 1.0 }\nfluid.density = 1.0\n\
                cloud = { arrangement = \"jittered\", spacing = 0.05 }\n";
    for (overrides, expected) in [
        (&["derivatives.field=waves", "poisson.field=waves"][..], "poisson: a case has one problem"),
        (&["derivatives.field=waves", "time.end=1.0"], "time: belongs to a flow, and there is [derivatives]"),
        (&["derivatives.field=waves", "effects.viscosity.kinematic=0.1"], "effects: belongs to a flow"),
        (&["derivatives.field=waves", "boundaries.top.velocity=[1.0, 0.0]"], "boundaries: belongs to a flow"),
        (&["derivatives.field=ripples"], "derivatives.field = \"ripples\": must be \"waves\" or \"cosines\""),
        (&["derivatives.field=cosines", "domain.periodic=both"], "derivatives.field: does not repeat with the domain"),
        (&["poisson.field=cosines"], "poisson: needs the table [effects.pressure]"),
        (&["poisson.field=waves", "effects.pressure.form=conservative"], "poisson.field: has a slope across the walls"),
        (
            &["poisson.field=cosines", "effects.pressure.divergence=fit"],
            "effects.pressure.divergence: belongs to a flow, and there is [poisson]",
        ),
        (
            &["poisson.field=cosines", "effects.pressure.form=conservative", "method.operators=integral"],
            "method.operators: must be \"interpolation\" with [poisson]",
        ),
        (
            &["method.order=1", "effects.viscosity.kinematic=0.1", "time.end=1.0"],
            "method.order: must be 2, 3 or 4 with",
        ),
    ] {
        let overrides: Vec<String> = overrides.iter().map(|given| (*given).to_owned()).collect();
        let error = Case::from_text(text, Path::new("bad.toml"), &overrides).expect_err("a mistake").to_string();
        // The value, where it is shown, stands between key and words.
        let (key, words) = expected.split_once(": ").expect("a key and words");
        let key = key.split(" = ").next().unwrap_or(key);
        assert!(error.contains(key) && error.contains(words), "{overrides:?}: {error}, not {expected}");
        assert!(!error.contains('\n'), "{error}");
    }
}

/// Implicit viscosity and drag, and what does not go with them.
#[test]
fn what_does_not_go_with_implicit_viscosity_or_with_drag_is_named() {
    let (implicit, drag) = ("effects.viscosity.scheme=implicit", "effects.drag.permeability=0.1");
    for (overrides, expected) in [
        (
            &[implicit, "effects.pressure.form=collocated"][..],
            "effects.viscosity.scheme: must be \"explicit\" with effects.pressure.form = \"collocated\"",
        ),
        (
            &[implicit, "boundaries.left={ kind = 'inlet', velocity = [1.0, 0.0] }", "boundaries.right.kind=outlet"],
            "effects.viscosity.scheme: must be \"explicit\" with boundaries.*.kind",
        ),
        (&["effects.viscosity.tolerance=1e-3"], "effects.viscosity.tolerance: belongs to a solve"),
        (&[implicit, "effects.viscosity.tolerance=0.0"], "effects.viscosity.tolerance: must be a number above 0"),
        (&["effects.viscosity.scheme=soon"], "effects.viscosity.scheme: must be \"explicit\" or \"implicit\""),
        (&[implicit, drag], "effects.drag: goes with effects.viscosity.scheme = \"explicit\" alone"),
        (&["effects.drag.permeability=0.0"], "effects.drag.permeability: must be a number above 0"),
        (&[drag, "effects.drag.inertia=-1.0"], "effects.drag.inertia: must be a number from 0"),
        (&[drag, "effects.drag.polygon=[[0.1, 0.1], [0.2, 0.2]]"], "effects.drag.polygon: must be three or more"),
        (
            &[
                drag,
                "effects.drag.circle={ centre = [0.5, 0.5], radius = 0.1 }",
                "effects.drag.polygon=[[0.1, 0.1], [0.2, 0.2], [0.1, 0.2]]",
            ],
            "effects.drag.polygon: there is a circle",
        ),
        (&[drag, "effects.drag.circle={ centre = [0.5, 0.5], radius = 0.0 }"], "effects.drag.circle.radius: must be a"),
    ] {
        let overrides: Vec<String> = overrides.iter().map(|given| (*given).to_owned()).collect();
        let error = Case::from_text(GOOD, Path::new("bad.toml"), &overrides).expect_err("a mistake").to_string();
        let (key, words) = expected.split_once(": ").expect("a key and words");
        assert!(error.contains(key) && error.contains(words), "{overrides:?}: {error}, not {expected}");
        assert!(!error.contains('\n'), "{error}");
    }
    let moving = "effects.advection={ motion = 'shifted' }";
    let text = "title = 'a column'\n\
                domain = { width = 3.0, height = 2.5 }\n\
                cloud = { arrangement = 'regular', spacing = 0.1, fill = { from = [0.0, 0.0], to = [1.0, 1.5] } }\n\
                fluid.density = 2.0\neffects.viscosity.kinematic = 0.01\neffects.pressure = {}\n\
                time = { end = 1.0, courant = 0.2 }\n";
    for (change, expected) in [(implicit, "with points that move"), (drag, "left out with points that move")] {
        let overrides = [moving, change].map(str::to_owned);
        let error = Case::from_text(text, Path::new("bad.toml"), &overrides).expect_err("a mistake").to_string();
        assert!(error.contains(expected), "{error}");
    }
    let inviscid = GOOD.replace("[effects.viscosity]\nkinematic = 0.01\n", "");
    let error = Case::from_text(&inviscid, Path::new("bad.toml"), &[drag.to_owned()]).expect_err("no viscosity");
    assert!(error.to_string().contains("the table effects.viscosity is absent"), "{error}");
}
