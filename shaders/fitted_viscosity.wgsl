// Viscosity of points that move, added to the kick.
//
// Continuous: du/dt = nu lap u. Discrete: kick += dt nu 2 (a3 + a5) / r_e^2 of the fits; (2.6) of the paper. Units: m/s.

#import points
#import stored_coefficient

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < INTERIOR {
        let factor = real(2.0) * clock[CLOCK_DIFFUSION] / (RADIUS * RADIUS);
        kick[i] += factor * (stored_coefficient(i, 2u) + stored_coefficient(i, 4u));
    }
}
