// The kick of the mean pressure by minus the adjoint of the divergence.
//
// Discrete: G_i = (h / rho) (1 / 2 V_i) sum_j w_ij d_ij (P_j - P_i) inside; nothing on walls. Units: m/s.

#import adjoint_gradient

fn unknown(i: u32) -> real {
    return mean_pressure[i];
}

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < INTERIOR {
        pressure_kick[i] = real(0.5) * clock[CLOCK_CORRECTION] / volume[i] * differences_of(i);
    } else if i < PADDED {
        pressure_kick[i] = vector();
    }
}
