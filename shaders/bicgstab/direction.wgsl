// BiCGStab, iteration 11 of 11: d = r + beta (d - omega v).
// Source: van der Vorst (1992); preconditioned as in Saad, Iterative Methods for Sparse Linear Systems (2003), section
// 7.4.2, with a rank-one shift of the singular system.

#import points

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < PADDED {
        direction[i] = residual[i] + scalars[BETA] * (direction[i] - scalars[OMEGA] * product[i]);
    }
}
