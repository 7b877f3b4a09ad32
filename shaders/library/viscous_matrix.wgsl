// Row i of the matrix of implicit viscosity: (V + h nu K) u, K over the faces of the cells, m^3/s; nothing at walls.
// The file that imports this says what is multiplied: `unknown`, the velocity at a point.

#import points

fn viscous_row(i: u32) -> vector {
    if i >= INTERIOR {
        return vector();
    }
    let own = unknown(i);
    var sum = vector();
    let first = at(i, 0u, FACE_CAPACITY);
    let last = first + min(face_count[i], FACE_CAPACITY) * BLOCK;
    for (var slot = first; slot < last; slot += BLOCK) {
        sum += face_weight[slot] * (own - unknown(face_neighbours[slot]));
    }
    return volume[i] * own + clock[CLOCK_DIFFUSION] * sum;
}
