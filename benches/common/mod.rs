//! What the benchmarks share: scenes from the case files, and pools of threads.

use std::fmt::{self, Display, Formatter};
use std::path::Path;
use std::sync::Arc;

use rayon::{ThreadPool, ThreadPoolBuilder};
use stillpoint::case::Case;
use stillpoint::scene::Scene;

/// A cloud of one of the cases, with another number of points.
#[derive(Debug, Clone, Copy)]
pub struct Size {
    /// `regular` or `random`.
    pub arrangement: &'static str,
    /// Spacings along each side of the unit square; one point more.
    pub cells: u32,
    /// 1, or 0 for all cores.
    pub threads: usize,
}

impl Display for Size {
    fn fmt(&self, out: &mut Formatter<'_>) -> fmt::Result {
        let points = (self.cells + 1).pow(2);
        let threads = if self.threads == 1 { "one thread" } else { "all threads" };
        write!(out, "{points} {}, {threads}", self.arrangement)
    }
}

impl Size {
    /// Every arrangement with every number of spacings, on one thread and on all.
    pub fn all(arrangements: &[&'static str], cells: &[u32]) -> Vec<Self> {
        let mut sizes = Vec::new();
        for &arrangement in arrangements {
            for &cells in cells {
                sizes.extend([1, 0].map(|threads| Self { arrangement, cells, threads }));
            }
        }
        sizes
    }

    /// The cavity at Re 100 on this cloud.
    pub fn scene(&self, overrides: &[&str]) -> Arc<Scene> {
        let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases");
        let path = cases.join(format!("cavity_re100_{}.toml", self.arrangement));
        let mut changed = vec![format!("cloud.spacing={:?}", 1.0 / f64::from(self.cells))];
        changed.extend(overrides.iter().map(|&key| key.to_owned()));
        let case = Case::load(&path, &changed).expect("a case");
        Arc::new(Scene::build(&case).expect("a scene"))
    }

    pub fn pool(&self) -> ThreadPool {
        ThreadPoolBuilder::new().num_threads(self.threads).build().expect("a pool of threads")
    }
}
