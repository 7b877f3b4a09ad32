// The fitted gradient at point i: sum_j g_ij (p_j - p_i), the rows of `assemble_gradient`.
// The file that imports this says of what: `unknown`, the value at a point.

#import points
#import gradient

fn gradient_of(i: u32) -> vector {
    let own = unknown(i);
    let first = at(i, 0u, CAPACITY);
    let count = min(neighbour_count[i], CAPACITY);
    var sum = vector();
    for (var slot = 0u; slot < count; slot++) {
        sum += (unknown(neighbours[first + slot * BLOCK]) - own) * gradient_factors(i, slot);
    }
    return sum;
}
