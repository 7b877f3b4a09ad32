// Correction by the fitted gradient.
//
// Continuous: u' = u* - (dt / rho) grad p.
// Discrete:   grad p = sum_j g_ij (p_j - p_i), the rows of `assemble_gradient`. Units: m/s.

#import fitted_gradient

fn unknown(i: u32) -> real {
    return pressure[i];
}

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < INTERIOR {
        projected[i] += -clock[CLOCK_CORRECTION] * gradient_of(i);
    }
}
