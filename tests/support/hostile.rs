//! What a file of any content may do: be read, or be refused in one line that names it. Shared with the fuzz targets.

#![allow(dead_code, reason = "each fuzz target calls one of them")]

use std::path::Path;
use std::sync::Arc;

use stillpoint::case::Case;
use stillpoint::cloud::Cloud;
use stillpoint::cpu;
use stillpoint::output::checkpoint::Checkpoint;
use stillpoint::scene::Scene;
use stillpoint::simulation::State;
use stillpoint::study::Study;

use super::ROOT;

/// Clouds of about so many points are laid out too.
const SMALL: f64 = 500.0;

/// Reads a case file and lays out the points of a small one. Returns whether there was one.
pub fn case(bytes: &[u8]) -> bool {
    let Ok(text) = std::str::from_utf8(bytes) else { return false };
    let path = Path::new(ROOT).join("cases/hostile.toml");
    match Case::from_text(text, &path, &[]) {
        Ok(case) => {
            if Cloud::estimate(&case) <= SMALL
                && let Err(error) = Scene::build(&case)
            {
                one_line(&error.to_string(), "");
            }
            true
        }
        Err(error) => {
            one_line(&error.to_string(), "hostile.toml");
            false
        }
    }
}

/// Reads a study file, loads its cases, and lays out the points of the small ones.
pub fn study(bytes: &[u8]) -> bool {
    let Ok(text) = std::str::from_utf8(bytes) else { return false };
    let path = Path::new(ROOT).join("cases/studies/hostile.toml");
    match Study::from_text(text, &path, &[]) {
        Ok(_) => true,
        Err(error) => {
            one_line(&error.to_string(), "hostile.toml");
            false
        }
    }
}

/// Reads a checkpoint, as it is and with a right checksum behind it, fits that of a small case to its scene, and gives it to an
/// engine.
pub fn checkpoint(bytes: &[u8]) -> bool {
    let path = Path::new("hostile");
    let read = |bytes: &[u8]| {
        let made = Checkpoint::decode(bytes, path).and_then(|checkpoint| {
            if Cloud::estimate(&checkpoint.case) > SMALL {
                return Ok(());
            }
            match Scene::build(&checkpoint.case) {
                Ok(scene) => checkpoint.state(&scene, path).map(|state| put(scene, &state)),
                Err(_) => Ok(()),
            }
        });
        match made {
            Ok(()) => true,
            Err(error) => {
                one_line(&error.to_string(), "hostile");
                false
            }
        }
    };
    let body = &bytes[..bytes.len().saturating_sub(4)];
    let mended = [body, &crc32fast::hash(body).to_le_bytes()].concat();
    read(bytes) | read(&mended)
}

/// Gives a state to an engine, which may refuse its indexes.
fn put(scene: Scene, state: &State) {
    let mut engine = cpu::single(&Arc::new(scene)).expect("an engine on the CPU");
    if let Err(error) = state.write(engine.as_mut()) {
        one_line(&error.to_string(), "");
    }
}

fn one_line(message: &str, name: &str) {
    assert!(!message.contains('\n') && message.contains(name), "{message:?}");
}
