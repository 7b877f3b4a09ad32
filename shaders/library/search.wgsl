// Neighbour search: the points within a radius of point `i`, in the order of the cell list.
//
// Shapes: `CAPACITY` slots a point, blocked; unused slots hold the point itself.

#import points
#import cells

// Fills the list of point `i` as far as it reaches; returns how many points there are, which may be more.
fn search(i: u32, radius: real) -> u32 {
    let here = position[i];
    let cell = cell_of(here);
    let ring = max(u32(ceil(radius * CELLS_PER_METRE)), 1u);
    let low = max(cell, vec2<u32>(ring, ring)) - vec2<u32>(ring, ring);
    let high = min(cell + vec2<u32>(ring, ring), vec2<u32>(CELLS_X - 1u, CELLS_Y - 1u));
    let first = at(i, 0u, CAPACITY);
    var met = 0u;
    for (var row = low.y; row <= high.y; row++) {
        let last = cell_start[row * CELLS_X + high.x + 1u];
        for (var k = cell_start[row * CELLS_X + low.x]; k < last; k++) {
            let j = cell_points[k];
            let d = position[j] - here;
            if j != i && d.x * d.x + d.y * d.y < radius * radius {
                if met < CAPACITY {
                    neighbours[first + met * BLOCK] = j;
                }
                met++;
            }
        }
    }
    return met;
}

// Puts `own` into the slots from `count` on.
fn pad_slots(i: u32, count: u32, own: u32) {
    for (var slot = count; slot < CAPACITY; slot++) {
        neighbours[at(i, slot, CAPACITY)] = own;
    }
}
