// The kick of the mean pressure by the fitted gradient.
//
// Discrete: G = (h / rho) sum_j g_ij (P_j - P_i) inside, the rows of `assemble_gradient`; nothing on walls. Units: m/s.

#import fitted_gradient

fn unknown(i: u32) -> real {
    return mean_pressure[i];
}

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < INTERIOR {
        pressure_kick[i] = clock[CLOCK_CORRECTION] * gradient_of(i);
    } else if i < PADDED {
        pressure_kick[i] = vector();
    }
}
