// Diffusion through the faces of the cells, half a step h = dt / 2 by the midpoint rule, first half: phi_m = phi + (h / 2) r(phi).
//
// Continuous: d phi / dt = D lap phi. Discrete: r_i = (D / V_i) sum_j w_ij (phi_j - phi_i). Units: those of the field.

#import exchange

fn of_field(i: u32) -> real {
    return carried[i];
}

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < PADDED {
        scalar_middle[i] = carried[i] + real(0.25) * clock[CLOCK_DT] * exchange_of(i);
    }
}
