// Row i of the conservative pressure matrix: (K p)_i = sum_j w_ij (p_i - p_j), w_ij = A_ij / |d_ij|, no unit.
// The file that imports this says what is multiplied: `unknown`, the value at a point.

#import points

fn product_of(i: u32) -> real {
    let own = unknown(i);
    var sum = real(0.0);
    let first = at(i, 0u, FACE_CAPACITY);
    let last = first + min(face_count[i], FACE_CAPACITY) * BLOCK;
    for (var slot = first; slot < last; slot += BLOCK) {
        sum += face_weight[slot] * (own - unknown(face_neighbours[slot]));
    }
    return sum;
}
