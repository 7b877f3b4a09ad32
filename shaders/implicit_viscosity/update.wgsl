// Implicit viscosity, iteration 3 of 5: u += alpha d, r -= alpha q.
// Sums over the points: r z, z = r / D, and the squares of r and of D u as velocities.

#import points
#import viscous_diagonal
#import sums

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    var own = sums();
    if i < INTERIOR {
        let alpha = scalars[ALPHA];
        let u = middle[i] + alpha * viscous_direction[i];
        let r = viscous_residual[i] - alpha * viscous_product[i];
        middle[i] = u;
        viscous_residual[i] = r;
        own = sums(dot(r, r) / viscous_diagonal(i), viscous_squares(i, r, u), 0.0);
    }
    add_up(group_of(group), local, own);
}
