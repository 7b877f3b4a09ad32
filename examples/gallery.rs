//! The gallery of the README: a picture of every case.
//!
//! Runs each case of `cases/`, on the CPU in f64, and writes `docs/images/gallery/NAME.png` and the table between the marks in
//! README.md: `cargo run --release --example gallery`. With names of cases after `--` the pictures of these alone are made again. A case that is not
//! in `SHOWN` shows what it carries, else how fast it flows.

use std::env;
use std::error::Error;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;

use image::RgbImage;
use image::codecs::png::{CompressionType, FilterType as PngFilter, PngEncoder};
use image::imageops::{FilterType, resize};
use stillpoint::case::Case;
use stillpoint::cpu;
use stillpoint::output::RunFolder;
use stillpoint::run::{self, Job};
use stillpoint::scene::Scene;

/// Case, its picture, and what of it is changed for a shorter run.
const SHOWN: [(&str, &str, &[&str]); 24] = [
    ("cavity_re100_paper", "pressure", &["cloud.spacing=0.03125"]),
    ("cavity_re100_paper_random", "pressure", &["cloud.spacing=0.025", "time.end=6.0"]),
    ("cavity_re100_random", "centreline", &[]),
    ("cavity_re400", "speed", &["cloud.spacing=0.03125"]),
    ("cavity_re1000", "speed", &["cloud.spacing=0.03125"]),
    ("cavity_re1000_graded", "speed", &["time.end=20.0"]),
    ("cavity_re3200", "speed", &["cloud.spacing=0.015625", "time.end=60.0"]),
    ("cavity_re3200_graded", "speed", &["time.end=60.0"]),
    ("channel", "pressure", &[]),
    ("couette", "centreline", &[]),
    ("cylinder_re20", "speed", &["time.end=6.0"]),
    ("dam_break_interpolation", "sheet", &[]),
    ("dam_break_mps", "sheet", &[]),
    ("dam_break_shifted", "sheet", &[]),
    ("derivatives", "gradient", &[]),
    ("heated_cavity_ra1e3", "temperature", &["cloud.spacing=0.03125"]),
    ("heated_cavity_ra1e4", "speed", &["cloud.spacing=0.03125"]),
    ("heated_cavity_ra1e5", "temperature", &["cloud.spacing=0.03125"]),
    ("hydrostatic_interpolation", "sensors", &["time.end=1.0"]),
    ("hydrostatic_mps", "sensors", &["time.end=1.5"]),
    ("hydrostatic_shifted", "sensors", &["time.end=1.5"]),
    ("kovasznay", "speed", &["cloud.spacing=0.03125"]),
    ("rotating_square", "sheet", &["time.end=1.0"]),
    ("standing_wave", "heights", &[]),
];
/// Pictures that another case may have, the first one that is there.
const OTHERWISE: [&str; 6] = ["sheet", "temperature", "gradient", "speed", "pressure", "centreline"];
/// Of a picture, pixels; bytes above which it is made smaller.
const WIDTH: f64 = 380.0;
const LARGEST: usize = 58_000;
/// Levels of each colour that are kept: files are half as large.
const LEVELS: f64 = 31.0;
/// Pictures side by side.
const COLUMNS: usize = 3;
const MARKS: [&str; 2] = ["<!-- gallery -->\n", "<!-- end of the gallery -->\n"];

fn main() -> ExitCode {
    let names: Vec<String> = env::args().skip(1).collect();
    match gallery(&names) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn gallery(names: &[String]) -> Result<(), Box<dyn Error>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut cases: Vec<PathBuf> =
        fs::read_dir(root.join("cases"))?.map(|entry| Ok(entry?.path())).collect::<Result<_, std::io::Error>>()?;
    cases.retain(|path| path.extension().is_some_and(|extension| extension == "toml"));
    cases.sort();
    let mut captions = Vec::new();
    for path in &cases {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let shown = SHOWN.iter().find(|(case, ..)| *case == name);
        let (picture, changes) = shown.map_or((None, &[][..]), |&(_, picture, changes)| (Some(picture), changes));
        let target = root.join("docs/images/gallery").join(&name).with_extension("png");
        if names.is_empty() || names.contains(&name) {
            println!("{name}");
            fs::write(&target, made(path, picture, changes)?)?;
        }
        let changed: Vec<String> = changes.iter().map(|change| format!("`{change}`")).collect();
        captions.push((name, changed.join(", ")));
    }
    let readme = root.join("README.md");
    let text = fs::read_to_string(&readme)?;
    let (before, rest) = text.split_once(MARKS[0]).ok_or("README.md has no mark where the gallery begins")?;
    let (_, after) = rest.split_once(MARKS[1]).ok_or("README.md has no mark where the gallery ends")?;
    fs::write(readme, [before, MARKS[0], &table(&captions)?, MARKS[1], after].concat())?;
    Ok(())
}

/// Runs a case, and gives the bytes of its picture.
fn made(path: &Path, picture: Option<&str>, changes: &[&str]) -> Result<Vec<u8>, Box<dyn Error>> {
    let changes: Vec<String> = changes.iter().map(|&change| change.to_owned()).collect();
    let case = Case::load(path, &changes)?;
    let scene = Arc::new(Scene::build(&case)?);
    let kept = tempfile::tempdir()?;
    let folder = RunFolder::create(kept.path(), true)?;
    let job = Job { case_path: path, scene: &scene, folder: &folder, checkpoint_every: None };
    // A run that diverges has pictures too.
    if let Some(trouble) = run::run(job, cpu::double(&scene)?.as_mut(), &mut ())?.trouble {
        println!("  {trouble}");
    }
    let tracer = case.effects.tracers.first().map(|tracer| format!("tracer_{}", tracer.name));
    let file = |name: &str| kept.path().join(name).with_extension("png");
    let mut possible = picture.into_iter().chain(tracer.as_deref()).chain(OTHERWISE);
    let found = possible.find(|name| file(name).exists()).ok_or("the run left no picture")?;
    small(&image::open(file(found))?.to_rgb8())
}

/// A picture in few pixels and few colours.
fn small(picture: &RgbImage) -> Result<Vec<u8>, Box<dyn Error>> {
    let mut width = WIDTH;
    loop {
        let height = width * f64::from(picture.height()) / f64::from(picture.width());
        let mut copy = resize(picture, width.round() as u32, height.round() as u32, FilterType::Lanczos3);
        let kept = |value: u8| ((f64::from(value) / 255.0 * LEVELS).round() / LEVELS * 255.0).round() as u8;
        copy.pixels_mut().for_each(|pixel| pixel.0 = pixel.0.map(kept));
        let mut bytes = Vec::new();
        let encoder = PngEncoder::new_with_quality(&mut bytes, CompressionType::Best, PngFilter::Adaptive);
        copy.write_with_encoder(encoder)?;
        if bytes.len() <= LARGEST {
            return Ok(bytes);
        }
        width *= 0.95;
    }
}

/// Rows of pictures, and below each row its captions.
fn table(captions: &[(String, String)]) -> Result<String, std::fmt::Error> {
    let mut text = String::from("\n");
    for (row, cases) in captions.chunks(COLUMNS).enumerate() {
        let cells = |cell: &dyn Fn(&(String, String)) -> String| {
            let filled: Vec<String> = cases.iter().map(cell).collect();
            filled.iter().map(|cell| format!("| {cell} ")).collect::<String>()
                + &"| ".repeat(COLUMNS - filled.len())
                + "|"
        };
        writeln!(text, "{}", cells(&|(name, _)| format!("![{name}](docs/images/gallery/{name}.png)")))?;
        if row == 0 {
            writeln!(text, "{}|", "|---".repeat(COLUMNS))?;
        }
        writeln!(
            text,
            "{}",
            cells(&|(name, changed)| match changed.is_empty() {
                true => format!("`{name}`"),
                false => format!("`{name}`, {changed}"),
            })
        )?;
    }
    text.push('\n');
    Ok(text)
}
