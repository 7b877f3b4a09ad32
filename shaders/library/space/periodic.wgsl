// The shape of the domain: a rectangle that repeats along x, y or both. Units: m.
//
// Along an axis that repeats after `L` the offset between two points is the shortest one, in [-L/2, L/2], and a place `x`
// stands for `x mod L`. PERIOD is 0 along an axis that ends at walls, and so is PER_PERIOD, its reciprocal elsewhere.

fn shortest(offset: vector) -> vector {
    let half = real(0.5) * PERIOD;
    let within = offset - select(vector(), PERIOD, offset > half);
    return within + select(vector(), PERIOD, -offset > half);
}

fn wrapped(place: vector) -> vector {
    let within = place - PERIOD * floor(place * PER_PERIOD);
    // A rounding unit off either end.
    return select(within, vector(), PERIODIC & ((within < vector()) | (within >= PERIOD)));
}

// The cells within `ring` cells of one: the first along x and y, and how many follow it, past the seam; none twice.
struct Window {
    first: vec2<u32>,
    count: vec2<u32>,
}

fn window(cell: vec2<u32>, ring: vec2<u32>) -> Window {
    let cells = vec2<u32>(CELLS_X, CELLS_Y);
    let first = max(cell, ring) - ring;
    let count = min(cell + ring, cells - 1u) + 1u - first;
    let width = 2u * ring + 1u;
    let all = width >= cells;
    let round_first = select((cell + cells - ring) % cells, vec2<u32>(), all);
    let round_count = select(width, cells, all);
    return Window(select(first, round_first, PERIODIC), select(count, round_count, PERIODIC));
}
