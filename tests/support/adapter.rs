//! Whether the tests that need a GPU run: they fail where there is none, unless `STILLPOINT_SKIP_GPU` is set.

use std::io::Write;
use std::sync::Once;

/// True where the tests that need a GPU are to be skipped. The first to ask says how many there are in `sources`, the
/// files that hold them.
pub fn skipped(sources: &[&str]) -> bool {
    static SAID: Once = Once::new();
    let skipped = std::env::var_os("STILLPOINT_SKIP_GPU").is_some_and(|value| !value.is_empty());
    if skipped {
        SAID.call_once(|| {
            let tests: usize = sources.iter().map(|source| source.matches("#[test]\n").count()).sum();
            // Not by a macro: what those print is kept back where a test passes. A lost line harms nothing.
            let _ = writeln!(std::io::stderr(), "{tests} GPU tests skipped: STILLPOINT_SKIP_GPU is set");
        });
    }
    skipped
}

/// What was found, or one line that says what to install.
pub fn required<T, E: std::fmt::Display>(found: Result<T, E>) -> T {
    found.unwrap_or_else(|error| panic!("{error}; STILLPOINT_SKIP_GPU=1 skips the tests that need one"))
}
