// The levels of the coarse pressure of points that stand still. See `src/step/aggregates.rs`.

struct Level {
    first: u32,
    count: u32,
    slots: u32,
    entries: u32,
}

fn place_of(level: Level, aggregate: u32) -> u32 {
    return level.first + aggregate;
}

fn cells_of(level: Level) -> u32 {
    return level.count;
}

// The entry of the first neighbour of an aggregate, and how far on the next one stands.
fn entry_of(level: Level, place: u32) -> u32 {
    return level.entries + place - level.first;
}

fn width_of(level: Level) -> u32 {
    return (level.count + BLOCK - 1u) / BLOCK * BLOCK;
}

fn link(entry: u32) -> real {
    return aggregate_matrix[2u * PLACES + entry];
}
