// Correction of MPS, 2 of 2: u' = u* - (dt / rho) (D / n0) sum_j (p_j - p_min) d / |d|^2 w, and the way dt (u' - u*). Units: m/s, m.

#import least

fn count(offset: vector, factor: real) {
}

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < INTERIOR {
        correct(i, mean_above_least(i));
    }
}
