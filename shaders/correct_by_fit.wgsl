// Correction by the fitted gradient.
//
// Continuous: u' = u* - (dt / rho) grad p.
// Discrete:   grad p = (a1, a2) / r_e of the fit (2.5), (2.6) of the paper. Units: m/s.

#import fit

alias value = real;

fn field(i: u32) -> value {
    return pressure[i];
}

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i >= INTERIOR {
        return;
    }
    let a = fit(i);
    projected[i] += -clock[CLOCK_CORRECTION] * a.per * vector(a.a1, a.a2);
}
