// Row i of MPS's pressure matrix: (K p)_i = sum_j w_ij (p_i - p_j), no unit.
// The file that imports this says what is multiplied: `unknown`, the value at a point.

#import points

fn product_of(i: u32) -> real {
    let own = unknown(i);
    var sum = real(0.0);
    let first = at(i, 0u, CAPACITY);
    // Points behind the walls have no pressure, and no row.
    let last = first + select(0u, min(neighbour_count[i], CAPACITY), i < PRESSURED) * BLOCK;
    for (var slot = first; slot < last; slot += BLOCK) {
        sum += matrix_row[slot] * (own - unknown(neighbours[slot]));
    }
    return sum;
}
