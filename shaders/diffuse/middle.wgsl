// Diffusion through the faces of the cells, half a step h = dt / 2 by the midpoint rule, second half: phi += h r(phi_m).
//
// Continuous: d phi / dt = D lap phi. Discrete: r_i = (D / V_i) sum_j w_ij (phi_j - phi_i). Units: those of the field.

#import exchange

fn of_field(i: u32) -> real {
    return scalar_middle[i];
}

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < PADDED {
        carried[i] += real(0.5) * clock[CLOCK_DT] * exchange_of(i);
    }
}
