// Source of the conservative pressure equation: the volume flux of u* out of every cell.
//
// Continuous: div((dt / rho) grad p) = div u*.
// Discrete:   b_i = -(rho / dt) sum_j w_ij d_ij . (u*_i + u*_j) / 2; what walls let through is added where there is any.
// Units: Pa.

#import face_flux

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < PADDED {
        source[i] = clock[CLOCK_SOURCE] * face_flux(i);
    }
}
