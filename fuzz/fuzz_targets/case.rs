//! Case files.

#![no_main]

#[path = "../../tests/support/hostile.rs"]
mod hostile;

/// Of the project.
const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/..");

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    hostile::case(bytes);
});
