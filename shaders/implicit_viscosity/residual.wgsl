// Implicit viscosity, check 1 of 2: r = V b - (V + h nu K) u, d = r / D.
// Sums over the points: r d, and the squares of r and of D u as velocities.
//
// Continuous: (u_m - b) / h = nu lap u_m.
// Discrete:   (V_i + h nu sum_j w_ij) u_i - h nu sum_j w_ij u_j = V_i b_i inside. Units: m^3/s.

#import viscous_matrix
#import viscous_diagonal
#import sums

fn unknown(i: u32) -> vector {
    return middle[i];
}

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    var own = sums();
    if i < PADDED {
        let r = select(vector(), volume[i] * projected[i] - viscous_row(i), i < INTERIOR);
        let d = select(vector(), r / viscous_diagonal(i), i < INTERIOR);
        viscous_residual[i] = r;
        viscous_direction[i] = d;
        own = sums(dot(r, d), viscous_squares(i, r, middle[i]), 0.0);
    }
    add_up(group_of(group), local, own);
}
