//! Memory: what a plan says it takes, what the engine holds, and a kilobyte a point at most.

use std::path::Path;

use stillpoint::case::Case;
use stillpoint::engine::Data;
use stillpoint::step::{Buffer, Element, Points};

use crate::bench::Bench;
use crate::cases::cavity;

fn shipped(name: &str) -> Case {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(name);
    Case::load(&path, &[]).expect("a shipped case")
}

/// Bytes of the arrays that the engine gives, in f32.
fn held(bench: &mut Bench) -> usize {
    let buffers = bench.scene.plan.buffers();
    let entries = |data: Data| match data {
        Data::Real(values) => values.len(),
        Data::Index(values) => values.len(),
    };
    buffers.into_iter().map(|buffer| 4 * entries(bench.engine.read(buffer).expect("a planned array"))).sum()
}

#[test]
fn the_shipped_cavities_take_a_kilobyte_a_point_at_most_and_what_their_plan_says() {
    for name in ["cavity_re100_regular.toml", "cavity_re100_random.toml"] {
        let mut bench = Bench::single(&shipped(name));
        let total = bench.scene.plan.total_bytes(&bench.scene.sizes, 4);
        assert_eq!(held(&mut bench), total, "{name}");
        let each = total as f64 / bench.points() as f64;
        assert!(each <= 1024.0 && each > 256.0, "{name}: {each} bytes a point");
    }
}

#[test]
fn floats_of_twice_the_size_take_twice_the_room() {
    let bench = Bench::new(&cavity(&[]));
    let (plan, sizes) = (&bench.scene.plan, &bench.scene.sizes);
    let indexes: usize =
        plan.buffers().iter().filter(|b| b.element() == Element::Index).map(|b| 4 * b.length(sizes)).sum();
    assert_eq!(plan.total_bytes(sizes, 8) - indexes, 2 * (plan.total_bytes(sizes, 4) - indexes));
}

#[test]
fn an_absent_effect_has_no_arrays() {
    let mut case = cavity(&[]);
    case.effects.pressure = None;
    case.effects.viscosity = None;
    let mut bench = Bench::single(&case);
    for absent in [Buffer::Pressure, Buffer::FaceWeight, Buffer::Residual, Buffer::Position(Points::Moved)] {
        assert!(bench.engine.read(absent).is_err(), "{absent:?}");
        assert!(!bench.scene.plan.buffers().contains(&absent), "{absent:?}");
    }
    let whole = Bench::single(&cavity(&[]));
    assert!(bench.scene.plan.total_bytes(&bench.scene.sizes, 4) < whole.scene.plan.total_bytes(&whole.scene.sizes, 4));
}
