// Source of the conservative pressure equation: what flows out of every cell through its walls.
//
// Continuous: div((dt / rho) grad p) = div u*.
// Discrete:   b_i += -(rho / dt) A_i n_i . u_wall. Units: kg/(m s^2) m^2 / m^2.

#import points

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < PADDED {
        source[i] += clock[CLOCK_SOURCE] * wall_flux[i];
    }
}
