// Correction by minus the adjoint of the divergence: never adds kinetic energy, on any arrangement of points, at any dt.
//
// Continuous: u' = u* - (dt / rho) grad p.
// Discrete:   u'_i = u*_i - (dt / rho) (1 / 2 V_i) sum_j w_ij d_ij (p_j - p_i). Units: m/s.

#import points
#import space

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i >= INTERIOR {
        return;
    }
    let here = position[i];
    let own = pressure[i];
    var sum = vector();
    let first = at(i, 0u, FACE_CAPACITY);
    let last = first + min(face_count[i], FACE_CAPACITY) * BLOCK;
    for (var slot = first; slot < last; slot += BLOCK) {
        let j = face_neighbours[slot];
        sum += face_weight[slot] * (pressure[j] - own) * shortest(position[j] - here);
    }
    projected[i] += real(-0.5) * clock[CLOCK_CORRECTION] / volume[i] * sum;
}
