// Implicit viscosity, iteration 5 of 5: d = z + beta d, z = r / D.
// Source: Hestenes and Stiefel (1952); preconditioned as in Saad, Iterative Methods for Sparse Linear Systems (2003),
// algorithm 9.1.

#import points
#import viscous_diagonal

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < INTERIOR {
        viscous_direction[i] = viscous_residual[i] / viscous_diagonal(i) + scalars[BETA] * viscous_direction[i];
    }
}
