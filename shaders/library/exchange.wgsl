// What neighbouring cells bring to a field, a second: (D / V_i) sum_j w_ij (phi_j - phi_i).
// The file that imports this says which field: `of_field`, the value at a point.

#import points

fn exchange_of(i: u32) -> real {
    let own = of_field(i);
    var sum = real(0.0);
    let first = at(i, 0u, FACE_CAPACITY);
    let last = first + min(face_count[i], FACE_CAPACITY) * BLOCK;
    for (var slot = first; slot < last; slot += BLOCK) {
        sum += face_weight[slot] * (of_field(face_neighbours[slot]) - own);
    }
    return reach[i] * sum;
}
