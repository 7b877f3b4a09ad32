//! A scene on the CPU engine, operation by operation: arrays go in and come out as plain vectors.

use std::sync::Arc;

use glam::DVec2;
use stillpoint::case::Case;
use stillpoint::cloud::Cloud;
use stillpoint::cpu;
use stillpoint::engine::{Clock, Data, Engine, EngineError};
use stillpoint::scene::Scene;
use stillpoint::step::{BLOCK, Buffer, Operation, Points};

/// Opens an engine: `cpu::single` or `cpu::double`.
pub type Open = fn(&Arc<Scene>) -> Result<Box<dyn Engine>, EngineError>;

pub struct Bench {
    pub scene: Arc<Scene>,
    pub engine: Box<dyn Engine>,
    pub clock: Clock,
}

/// What the fit of a velocity at one point gives, x and y parts.
pub struct Derivatives {
    /// 1/s; the gradients of u and of v.
    pub gradient: [DVec2; 2],
    /// 1/(m s)
    pub laplacian: DVec2,
    /// Radius of the point's neighbourhood, m.
    pub support: f64,
}

impl Bench {
    /// Lays the case out and runs its setup operations. The clock ticks seconds until set otherwise.
    pub fn new(case: &Case) -> Self {
        Self::on(Scene::build(case).expect("a scene"), cpu::double)
    }

    /// The same in `f32`.
    pub fn single(case: &Case) -> Self {
        Self::on(Scene::build(case).expect("a scene"), cpu::single)
    }

    pub fn with_cloud(case: &Case, cloud: Cloud) -> Self {
        Self::on(Scene::with_cloud(case, cloud).expect("a scene"), cpu::double)
    }

    fn on(scene: Scene, open: Open) -> Self {
        let scene = Arc::new(scene);
        let engine = open(&scene).expect("an engine");
        let clock = Clock { dt: 1.0, kick: 1.0, second_kick: 1.0, share: 1.0 };
        let mut bench = Self { scene, engine, clock };
        let setup = bench.scene.plan.setup.clone();
        bench.apply(&setup);
        bench
    }

    pub fn apply(&mut self, operations: &[Operation]) {
        for &operation in operations {
            self.engine.apply(operation, &self.clock).unwrap_or_else(|error| panic!("{operation:?}: {error}"));
        }
    }

    pub fn points(&self) -> usize {
        self.scene.sizes.points
    }

    /// A whole array of floats, padding and all.
    pub fn reals(&mut self, buffer: Buffer) -> Vec<f64> {
        match self.engine.read(buffer).expect("an array") {
            Data::Real(values) => values,
            Data::Index(_) => panic!("{buffer:?} holds indexes"),
        }
    }

    pub fn indexes(&mut self, buffer: Buffer) -> Vec<u32> {
        match self.engine.read(buffer).expect("an array") {
            Data::Index(values) => values,
            Data::Real(_) => panic!("{buffer:?} holds floats"),
        }
    }

    /// One number a point.
    pub fn scalars(&mut self, buffer: Buffer) -> Vec<f64> {
        let mut values = self.reals(buffer);
        values.truncate(self.points());
        values
    }

    /// One vector a point.
    pub fn vectors(&mut self, buffer: Buffer) -> Vec<DVec2> {
        let points = self.points();
        self.reals(buffer)[..2 * points].chunks_exact(2).map(DVec2::from_slice).collect()
    }

    pub fn write_scalars(&mut self, buffer: Buffer, values: &[f64]) {
        let data = self.scene.scalars(values, 0.0);
        self.engine.write(buffer, &data).expect("an array of that length");
    }

    pub fn write_vectors(&mut self, buffer: Buffer, values: &[DVec2]) {
        let data = self.scene.vectors(values, DVec2::ZERO);
        self.engine.write(buffer, &data).expect("an array of that length");
    }

    /// The field at every point.
    pub fn sample<R>(&self, field: impl Fn(DVec2) -> R) -> Vec<R> {
        self.scene.cloud.position.iter().map(|&place| field(place)).collect()
    }

    /// First and second derivatives of a velocity at every point, walls and corners included.
    pub fn derivatives(&mut self, velocity: &[DVec2]) -> Vec<Derivatives> {
        let (moving, standing) = (self.scene.plan.moving(), Points::Standing);
        self.write_vectors(moving, velocity);
        self.apply(&[Operation::FitVelocity(standing)]);
        let (coefficients, support) = (self.reals(Buffer::Coefficients), self.reals(Buffer::Support(standing)));
        let of = |point: usize| {
            let r = support[point];
            let a = |k: usize| coefficients[(point / BLOCK) * BLOCK * 10 + k * BLOCK + point % BLOCK];
            Derivatives {
                gradient: [DVec2::new(a(0), a(1)) / r, DVec2::new(a(5), a(6)) / r],
                laplacian: 2.0 * DVec2::new(a(2) + a(4), a(7) + a(9)) / (r * r),
                support: r,
            }
        };
        (0..self.points()).map(of).collect()
    }
}

/// `values` with their mean taken out.
pub fn without_mean(values: &[f64]) -> Vec<f64> {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    values.iter().map(|value| value - mean).collect()
}

/// The larger of two, and NaN where either is: `f64::max` would hide it.
pub fn most(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

/// Largest magnitude of the differences of two fields.
pub fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, most)
}

/// Order of convergence from two spacings and their errors.
pub fn order(coarse: (usize, f64), fine: (usize, f64)) -> f64 {
    (coarse.1 / fine.1).ln() / (fine.0 as f64 / coarse.0 as f64).ln()
}
