// Row i of the collocated pressure matrix: (A p)_i = sum_j m_ij (p_j - p_i), 1/m^2.
// The file that imports this says what is multiplied: `unknown`, the value at a point.

#import points

fn product_of(i: u32) -> real {
    let own = unknown(i);
    var sum = real(0.0);
    let first = at(i, 0u, CAPACITY);
    let last = first + min(neighbour_count[i], CAPACITY) * BLOCK;
    for (var slot = first; slot < last; slot += BLOCK) {
        sum += matrix_row[slot] * (unknown(neighbours[slot]) - own);
    }
    return sum;
}
