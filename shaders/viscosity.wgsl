// Viscosity, added to the kick.
//
// Continuous: du/dt = nu lap u.
// Discrete:   kick += dt nu 2 (a3 + a5) / r_e^2 of the fit (2.5), (2.6) of the paper. Units: m/s.

#import fit

alias value = vector;

fn field(i: u32) -> value {
    return diffused[i];
}

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < FORCED {
        let a = fit(i);
        let scale = real(2.0) * clock[CLOCK_DIFFUSION] * a.per * a.per;
        kick[i] += scale * (a.a3 + a.a5);
    }
}
