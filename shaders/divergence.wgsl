// Source of the conservative pressure equation: the volume flux of u* out of every cell.
//
// Continuous: div((dt / rho) grad p) = div u*.
// Discrete:   b_i = -(rho / dt) sum_j w_ij d_ij . (u*_i + u*_j) / 2; what walls let through is added where there is any. Units: kg/(m s^2) m^2 / m^2.

#import points
#import space

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i >= PADDED {
        return;
    }
    let here = position[i];
    let own = projected[i];
    var sum = real(0.0);
    let first = at(i, 0u, FACE_CAPACITY);
    let last = first + min(face_count[i], FACE_CAPACITY) * BLOCK;
    for (var slot = first; slot < last; slot += BLOCK) {
        let j = face_neighbours[slot];
        let d = shortest(position[j] - here);
        let u = projected[j] + own;
        sum += face_weight[slot] * (d.x * u.x + d.y * u.y);
    }
    source[i] = real(0.5) * clock[CLOCK_SOURCE] * sum;
}
