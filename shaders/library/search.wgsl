// Neighbour search: the points within a radius of point `i`, in the order of the cell list: along each row from the window's
// first, past the seam where it reaches there.
//
// Shapes: `CAPACITY` slots a point, blocked; unused slots hold the point itself.

#import points
#import cells
#import space

// Fills the list of point `i` as far as it reaches; returns how many points there are, which may be more.
fn search(i: u32, radius: real) -> u32 {
    let ring = max(vec2<u32>(ceil(radius * CELLS_PER_METRE)), vec2<u32>(1u, 1u));
    let around = window(cell_of(position[i]), ring);
    let end = around.first.x + around.count.x;
    let beyond = max(end, CELLS_X) - CELLS_X;
    var met = 0u;
    for (var k = 0u; k < around.count.y; k++) {
        let row = (around.first.y + k) % CELLS_Y * CELLS_X;
        met = search_cells(i, radius, row + around.first.x, row + end - beyond, met);
        met = search_cells(i, radius, row, row + beyond, met);
    }
    return met;
}

// The cells `begin..end` of one row; `met_before` points were found before.
fn search_cells(i: u32, radius: real, begin: u32, end: u32, met_before: u32) -> u32 {
    let here = position[i];
    let first = at(i, 0u, CAPACITY);
    let last = cell_start[end];
    var met = met_before;
    for (var k = cell_start[begin]; k < last; k++) {
        let j = cell_points[k];
        let d = shortest(position[j] - here);
        if j != i && d.x * d.x + d.y * d.y < radius * radius {
            if met < CAPACITY {
                neighbours[first + met * BLOCK] = j;
            }
            met++;
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
