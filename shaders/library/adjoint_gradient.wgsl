// Minus the adjoint of the divergence at point i, times 2 V_i: sum_j w_ij d_ij (p_j - p_i).
// The file that imports this says of what: `unknown`, the value at a point.

#import points
#import space

fn differences_of(i: u32) -> vector {
    let here = position[i];
    let own = unknown(i);
    var sum = vector();
    let first = at(i, 0u, FACE_CAPACITY);
    let last = first + min(face_count[i], FACE_CAPACITY) * BLOCK;
    for (var slot = first; slot < last; slot += BLOCK) {
        let j = face_neighbours[slot];
        sum += face_weight[slot] * (unknown(j) - own) * shortest(position[j] - here);
    }
    return sum;
}
