// The kick of the mean pressure by minus the adjoint of the divergence.
//
// Discrete: G_i = (h / rho) (1 / 2 V_i) sum_j w_ij d_ij (P_j - P_i) inside. Units: m/s.

#import points
#import space

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i >= PADDED {
        return;
    }
    let here = position[i];
    let own = mean_pressure[i];
    let first = at(i, 0u, FACE_CAPACITY);
    let count = select(0u, min(face_count[i], FACE_CAPACITY), i < INTERIOR);
    var sum = vector();
    for (var slot = first; slot < first + count * BLOCK; slot += BLOCK) {
        let j = face_neighbours[slot];
        sum += face_weight[slot] * (mean_pressure[j] - own) * shortest(position[j] - here);
    }
    pressure_kick[i] = real(0.5) * clock[CLOCK_CORRECTION] / volume[i] * sum;
}
