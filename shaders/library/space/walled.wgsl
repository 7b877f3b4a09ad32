// The shape of the domain: a rectangle with walls all round. Offsets and places are what they are. Units: m.

fn shortest(offset: vector) -> vector {
    return offset;
}

fn wrapped(place: vector) -> vector {
    return place;
}

// The cells within `ring` cells of one: the first along x and y, and how many follow it.
struct Window {
    first: vec2<u32>,
    count: vec2<u32>,
}

fn window(cell: vec2<u32>, ring: vec2<u32>) -> Window {
    let first = max(cell, ring) - ring;
    return Window(first, min(cell + ring, vec2<u32>(CELLS_X - 1u, CELLS_Y - 1u)) + 1u - first);
}
