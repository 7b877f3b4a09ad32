//! Files of any content: cases, studies and checkpoints that were spoiled in random ways are read or refused in one line.
//!
//! The fuzz targets in `fuzz/` do the same for hours, led by what the program does with each; see CONTRIBUTING.md.

use std::fs;
use std::path::Path;

use crate::ROOT;
use crate::checkpoints::{written, written_of_moving};
use crate::hostile;
use crate::random::Random;

/// What may take the place of a piece of a file.
const PIECES: [&[u8]; 16] = [
    b"-1",
    b"0",
    b"1e308",
    b"1e-320",
    b"nan",
    b"inf",
    b"9223372036854775807",
    b"99999999999999999999",
    b"[",
    b"{",
    b"\"",
    b"=",
    b"\n[cloud]\n",
    b"\xff\xfe",
    b"\0",
    b"a.b.c.d.e.f.g.h.i.j = 1",
];

fn whole(random: &mut Random, below: usize) -> usize {
    (0.5 * (random.number() + 1.0) * below as f64) as usize
}

/// A file with some pieces of it changed, dropped or doubled.
fn spoiled(file: &[u8], random: &mut Random) -> Vec<u8> {
    let mut file = file.to_vec();
    for _ in 0..=whole(random, 4) {
        let at = whole(random, file.len() + 1);
        let end = (at + whole(random, 24)).min(file.len());
        match whole(random, 5) {
            0 => drop(file.drain(at..end)),
            1 => drop(file.splice(at..end, PIECES[whole(random, PIECES.len())].iter().copied())),
            2 => {
                let piece = file[at..end].to_vec();
                drop(file.splice(at..at, piece));
            }
            3 => file[at..end].iter_mut().for_each(|byte| *byte ^= 1 << whole(random, 8)),
            _ => {
                // A number gets another order of magnitude.
                let digit = file[at..].iter().position(u8::is_ascii_digit).map(|offset| at + offset);
                if let Some(digit) = digit {
                    file[digit] = b"0123456789e.-"[whole(random, 13)];
                }
            }
        }
    }
    file
}

/// Spoils `seeds` so many times; some of what comes out is to be good, and some is not.
fn spoil(seeds: &[Vec<u8>], times: usize, seed: u64, read: fn(&[u8]) -> bool) {
    assert!(seeds.iter().all(|seed| read(seed)), "what is spoiled was good");
    let mut random = Random::new(seed);
    let good = (0..times).filter(|k| read(&spoiled(&seeds[k % seeds.len()], &mut random))).count();
    assert!(good > 0 && good < times, "{good} of {times}");
}

fn files(folder: &str) -> Vec<Vec<u8>> {
    let entries =
        fs::read_dir(Path::new(ROOT).join(folder)).expect("a folder").map(|entry| entry.expect("an entry").path());
    let mut paths: Vec<_> =
        entries.filter(|path| path.extension().is_some_and(|extension| extension == "toml")).collect();
    paths.sort();
    paths.iter().map(|path| fs::read(path).expect("a file")).collect()
}

#[test]
fn spoiled_case_files_are_read_or_refused_in_one_line() {
    spoil(&files("cases"), 3000, 1, hostile::case);
}

#[test]
fn spoiled_study_files_are_read_or_refused_in_one_line() {
    let smoke = fs::read(Path::new(ROOT).join("cases/studies/smoke.toml")).expect("a study");
    spoil(&[smoke], 300, 2, hostile::study);
}

#[test]
fn spoiled_checkpoints_are_read_or_refused_in_one_line() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("checkpoint");
    let seeds = [written, written_of_moving].map(|write| {
        write(&path);
        fs::read(&path).expect("a file")
    });
    spoil(&seeds, 3000, 3, hostile::checkpoint);
}
