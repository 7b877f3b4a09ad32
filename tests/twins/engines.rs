//! The engines that are compared, and the numbers that go from one to the other.

use std::collections::BTreeMap;
use std::sync::Arc;

use stillpoint::cpu;
use stillpoint::engine::{Data, Engine};
use stillpoint::gpu::adapter::{self, Candidate};
use stillpoint::gpu::{Gpu, GpuEngine, Precision};
use stillpoint::scene::Scene;
use stillpoint::step::Buffer;

use crate::adapter::{required, skipped};

/// The files whose tests need a GPU.
const SOURCES: [&str; 7] = [
    include_str!("forms.rs"),
    include_str!("moving.rs"),
    include_str!("operations.rs"),
    include_str!("runs.rs"),
    include_str!("memory.rs"),
    include_str!("times.rs"),
    include_str!("trouble.rs"),
];

/// The adapter that the tests run on; `None` where they are skipped. Fails where there is none.
pub fn candidate() -> Option<Candidate> {
    (!skipped(&SOURCES)).then(|| required(adapter::choose(None)))
}

pub fn gpu(candidate: &Candidate, scene: &Arc<Scene>, precision: Precision) -> GpuEngine {
    let gpu = Gpu::open(candidate, precision).expect("the adapter opens");
    GpuEngine::new(Arc::clone(scene), gpu).expect("the kernels compile")
}

/// Every array of a plan.
pub type State = BTreeMap<Buffer, Data>;

pub fn read(engine: &mut dyn Engine, buffers: &[Buffer]) -> State {
    buffers.iter().map(|&buffer| (buffer, engine.read(buffer).expect("a planned array"))).collect()
}

pub fn write(engine: &mut dyn Engine, state: &State) {
    state.iter().for_each(|(&buffer, data)| engine.write(buffer, data).expect("a planned array"));
}

/// What f32 holds of it: numbers that every engine begins from alike.
pub fn rounded(state: State) -> State {
    let round = |data| match data {
        Data::Real(values) => Data::Real(values.into_iter().map(|value| f64::from(value as f32)).collect()),
        index => index,
    };
    state.into_iter().map(|(buffer, data)| (buffer, round(data))).collect()
}

pub fn reals(engine: &mut dyn Engine, buffer: Buffer) -> Vec<f64> {
    match engine.read(buffer).expect("a planned array") {
        Data::Real(values) => values,
        Data::Index(_) => panic!("{buffer:?} holds indexes"),
    }
}

/// CPU f64, CPU f32, GPU f32.
pub struct Engines {
    pub double: Box<dyn Engine>,
    pub single: Box<dyn Engine>,
    pub gpu: GpuEngine,
}

impl Engines {
    pub fn new(candidate: &Candidate, scene: &Arc<Scene>) -> Self {
        Self {
            double: cpu::double(scene).expect("an engine"),
            single: cpu::single(scene).expect("an engine"),
            gpu: gpu(candidate, scene, Precision::Single),
        }
    }

    pub fn each(&mut self) -> [&mut dyn Engine; 3] {
        [self.double.as_mut(), self.single.as_mut(), &mut self.gpu]
    }
}
