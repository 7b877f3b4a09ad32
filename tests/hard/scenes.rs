//! Random scenes within the documented ranges: each ends in finite files or in one line that says why not, and none hangs.

use std::fs;
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use stillpoint::case::Case;
use stillpoint::cpu;
use stillpoint::output::{RunFolder, StopReason};
use stillpoint::run::{self, Job};
use stillpoint::scene::Scene;
use stillpoint::simulation::{Diagnostics, Observer};

use crate::random::Random;

/// A scene that takes longer hangs: they have at most some hundred points, and some ten steps.
const PATIENCE: Duration = Duration::from_secs(60);
/// Rows after which a run is stopped.
const ROWS: u32 = 6;

struct Draw(Random);

impl Draw {
    /// In [0, 1).
    fn unit(&mut self) -> f64 {
        0.5 * (self.0.number() + 1.0)
    }

    fn between(&mut self, least: f64, most: f64) -> f64 {
        least + (most - least) * self.unit()
    }

    /// Every order of magnitude is as likely.
    fn magnitude(&mut self, least: f64, most: f64) -> f64 {
        10_f64.powf(self.between(least, most))
    }

    fn whole(&mut self, least: u32, most: u32) -> u32 {
        least + (self.unit() * f64::from(most - least + 1)) as u32
    }

    fn one_in(&mut self, many: u32) -> bool {
        self.whole(1, many) == 1
    }

    fn of<'a>(&mut self, words: &[&'a str]) -> &'a str {
        words[self.whole(0, words.len() as u32 - 1) as usize]
    }
}

/// A case file.
fn scene(draw: &mut Draw) -> String {
    // Of five, one does not care what goes together.
    let wild = draw.one_in(5);
    let flow = !draw.one_in(8);
    let exact = match draw.whole(1, 8) {
        _ if !flow => None,
        1 => Some("taylor_green"),
        2 => Some("kovasznay"),
        _ => None,
    };
    let mut periodic = draw.of(&["none", "none", "none", "x", "y", "both"]);
    if !wild && (exact.is_some() || !flow) {
        periodic = if exact == Some("taylor_green") { "both" } else { "none" };
    }
    let [least, most] = if periodic == "none" || wild { [4, 20] } else { [18, 26] };
    let (across, mut up) = (draw.whole(least, most), draw.whole(least, most));
    if exact == Some("taylor_green") && !wild {
        up = across;
    }
    let spacing = if draw.one_in(2) { 1.0 / f64::from(across) } else { draw.magnitude(-10.0, 5.0) };
    let speed = if draw.one_in(2) { 1.0 } else { draw.magnitude(-9.0, 6.0) };
    let (width, height) = (spacing * f64::from(across), spacing * f64::from(up));
    let arrangement = draw.of(&["regular", "jittered", "random"]);
    let mut text = format!(
        "title = 'random'\ndomain = {{ width = {width:e}, height = {height:e}, periodic = '{periodic}' }}\n\
         fluid.density = {:e}\noutput = {{ pictures = {}, report_every = {} }}\n\
         [cloud]\narrangement = '{arrangement}'\nspacing = {spacing:e}\n",
        if draw.one_in(2) { 1.0 } else { draw.magnitude(-6.0, 6.0) },
        draw.one_in(20),
        draw.whole(1, 10),
    );
    if arrangement == "jittered" && draw.one_in(2) {
        text += &format!("jitter = {}\n", draw.between(0.0, 0.499));
    }
    if arrangement == "random" && draw.one_in(2) {
        text += &format!("minimum_distance = {}\n", draw.between(0.1, 0.75));
    }
    if arrangement != "regular" {
        text += &format!("seed = {}\n", draw.whole(0, 1_000_000));
    }
    text += "[method]\n";
    let order = if draw.one_in(3) { draw.whole(if wild { 1 } else { 2 }, 4) } else { 2 };
    text += &format!("order = {order}\n");
    if draw.one_in(2) {
        let least = if wild { 1.51 } else { [2.1, 2.6, 3.4, 4.2][order as usize - 1] };
        let most = if periodic == "none" || wild { 5.0 } else { 4.2_f64.max(least) };
        text += &format!("radius = {}\n", draw.between(least, most));
    }
    text += &format!("weight = '{}'\n", draw.of(&["smooth", "smooth", "none", "quadratic"]));
    let integral = draw.one_in(5) && (flow || wild);
    if integral {
        text += "operators = 'integral'\n";
    }
    let mut effects = [!draw.one_in(6), !draw.one_in(6), !draw.one_in(6)];
    if flow {
        for (side, along) in [("left", 1), ("right", 1), ("bottom", 0), ("top", 0)] {
            let seam =
                ["x", "y"].iter().zip([1, 0]).any(|(axis, at)| along == at && [*axis, "both"].contains(&periodic));
            if (wild || (exact.is_none() && !seam)) && draw.one_in(2) {
                let given = speed * draw.0.number();
                let velocity = if along == 0 { [given, 0.0] } else { [0.0, given] };
                text += &format!("[boundaries.{side}]\nvelocity = [{:e}, {:e}]\n", velocity[0], velocity[1]);
            }
        }
        if let Some(solution) = exact {
            text += &format!("[exact]\nsolution = '{solution}'\n");
            effects = if wild { effects } else { [true; 3] };
        }
    } else {
        let field = if wild { draw.of(&["waves", "cosines"]) } else { "cosines" };
        let problem = draw.of(&["derivatives", "poisson"]);
        text += &format!("[{problem}]\nfield = '{field}'\n");
        effects = if wild { effects } else { [false, problem == "poisson", false] };
    }
    if effects[0] && (flow || wild) {
        let reynolds = draw.magnitude(-3.0, 7.0);
        text += &format!("[effects.viscosity]\nkinematic = {:e}\n", speed * height / reynolds);
    }
    if draw.one_in(5) && flow && (wild || exact.is_none()) {
        let size = speed * speed / height * draw.magnitude(-3.0, 3.0);
        text += &format!(
            "[effects.gravity]\nacceleration = [{:e}, {:e}]\n",
            size * draw.0.number(),
            size * draw.0.number()
        );
    }
    if effects[1] {
        text += "[effects.pressure]\n";
        let collocated = draw.one_in(3) && (wild || !integral);
        if collocated {
            text += "form = 'collocated'\n";
        } else if draw.one_in(2) && flow {
            text += &format!(
                "divergence = '{}'\ngradient = '{}'\n",
                draw.of(&["faces", "fit"]),
                draw.of(&["fit", "adjoint"])
            );
        }
        if draw.one_in(2) {
            let solvers: &[&str] =
                if collocated { &["bicgstab", "direct"] } else { &["conjugate_gradient", "bicgstab", "direct"] };
            text += &format!("solver = '{}'\n", draw.of(solvers));
        }
        if draw.one_in(3) {
            text += &format!("tolerance = {:e}\n", draw.magnitude(-16.0, -0.1));
        }
        if draw.one_in(4) {
            text += &format!("max_iterations = {}\n", draw.whole(1, 50));
        }
    }
    if flow {
        let forward = draw.one_in(4);
        if effects[2] {
            text += &format!("[effects.advection]\nremap = '{}'\n", if forward { "forward" } else { "departure" });
        }
        let pace = spacing / speed;
        text += &format!("[time]\nend = {:e}\n", pace * draw.magnitude(-2.0, 2.0));
        if draw.one_in(2) {
            let courant = if forward { draw.between(0.05, 1.0) } else { draw.magnitude(-2.0, 1.69) };
            text += &format!("courant = {courant}\n");
        }
        if draw.one_in(6) {
            text += &format!("step = {:e}\n", pace * draw.magnitude(-2.0, 1.0));
        }
        if draw.one_in(4) {
            text += &format!("steady = {:e}\n", speed / pace * draw.magnitude(-6.0, 0.0));
        }
        if draw.one_in(3) {
            text += "splitting = 'projection'\n";
        }
    }
    text
}

/// Stops a run that goes on for long.
struct Patience(u32);

impl Observer for Patience {
    fn report(&mut self, _: &Diagnostics) {
        self.0 += 1;
    }

    fn stop_requested(&self) -> bool {
        self.0 >= ROWS
    }
}

/// How scenes ended, by number.
#[derive(Debug, Default, PartialEq)]
struct Ends {
    finite: u32,
    flagged: u32,
    refused: u32,
}

fn try_scene(text: &str, folder: &Path, double: bool, ends: &mut Ends) {
    let started = Instant::now();
    let refuse = |message: String, ends: &mut Ends| {
        assert!(!message.contains('\n') && message.len() > 10, "{message:?}\n{text}");
        // What a run computed is not thrown away for a number that cannot be written.
        assert!(!message.contains("nothing is written"), "{message}\n{text}");
        ends.refused += 1;
    };
    let case = match Case::from_text(text, Path::new("random.toml"), &[]) {
        Ok(case) => case,
        Err(error) => return refuse(error.to_string(), ends),
    };
    let scene = match Scene::build(&case) {
        Ok(scene) => Arc::new(scene),
        Err(error) => return refuse(error.to_string(), ends),
    };
    let mut engine = if double { cpu::double(&scene) } else { cpu::single(&scene) }.expect("an engine");
    let folder = RunFolder::create(folder, true).expect("a folder");
    let job = Job { case_path: Path::new("random.toml"), scene: &scene, folder: &folder, checkpoint_every: Some(2) };
    match run::run(job, engine.as_mut(), &mut Patience(0)) {
        Err(error) => refuse(error.to_string(), ends),
        Ok(report) => {
            assert_eq!(report.summary.stop == StopReason::Failed, report.trouble.is_some(), "{text}");
            *(if report.trouble.is_some() { &mut ends.flagged } else { &mut ends.finite }) += 1;
            for entry in fs::read_dir(folder.path()).expect("a folder") {
                let path = entry.expect("an entry").path();
                let is_text =
                    path.extension().is_some_and(|extension| ["csv", "vtu", "json"].iter().any(|e| extension == *e));
                let bytes = fs::read(&path).expect("a file");
                let words = bytes.split(|byte| !byte.is_ascii_alphanumeric());
                let bad = |word: &[u8]| [&b"NaN"[..], b"nan", b"inf", b"Infinity"].contains(&word);
                assert!(!is_text || !words.into_iter().any(bad), "{}\n{text}", path.display());
            }
        }
    }
    assert!(started.elapsed() < PATIENCE, "{:?}\n{text}", started.elapsed());
}

fn try_scenes(count: u32, seed: u64) -> Ends {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut draw = Draw(Random::new(seed));
    let mut ends = Ends::default();
    for k in 0..count {
        try_scene(&scene(&mut draw), &folder.path().join("run"), k % 2 == 0, &mut ends);
    }
    println!("{count} scenes: {ends:?}");
    ends
}

#[test]
fn random_scenes_end_well() {
    let ends = try_scenes(60, 1);
    assert!(ends.finite >= 20 && ends.refused > 0, "{ends:?}");
}

#[test]
#[ignore = "a minute"]
fn a_thousand_random_scenes_end_well() {
    let ends = try_scenes(1000, 2);
    assert!(ends.finite >= 600 && ends.flagged > 0 && ends.refused > 0, "{ends:?}");
}
