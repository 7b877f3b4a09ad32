// Source of the conservative pressure equation on scattered points: the volume flux of u* out of every cell.
//
// Continuous: div((dt / rho) grad p) = div u*.
// Discrete:   b_i = -(rho / dt) sum_k r_ik . u*_k, a quadratic fitted on every face. Units: kg/(m s^2) m^2 / m^2.

#import fitted_flux

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < PADDED {
        source[i] = clock[CLOCK_SOURCE] * fitted_flux(i);
    }
}
