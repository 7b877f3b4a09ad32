// Correction by minus the adjoint of the divergence: never adds kinetic energy, on any arrangement of points, at any dt.
//
// Continuous: u' = u* - (dt / rho) grad p.
// Discrete:   u'_i = u*_i - (dt / rho) (1 / 2 V_i) sum_j w_ij d_ij (p_j - p_i). Units: m/s.

#import adjoint_gradient

fn unknown(i: u32) -> real {
    return pressure[i];
}

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < INTERIOR {
        projected[i] += real(-0.5) * clock[CLOCK_CORRECTION] / volume[i] * differences_of(i);
    }
}
