// Conjugate gradients, iteration 5 of 5: d = z + beta d, z = r / D and, where there is one, the coarse pressure.
// Source: Hestenes and Stiefel (1952); preconditioned as in Saad, Iterative Methods for Sparse Linear Systems (2003),
// algorithm 9.1.

#import points
#import coarse_at

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < PADDED {
        direction[i] = residual[i] / diagonal[i] + coarse_at(i) + scalars[BETA] * direction[i];
    }
}
