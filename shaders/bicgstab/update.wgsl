// BiCGStab, iteration 9 of 11: p += omega M^-1 s, r = s - omega t.
// Sums over the points: the squares of r and of D p as densities, and shadow r.

#import density
#import sums

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    var own = sums();
    if i < PADDED {
        let omega = scalars[OMEGA];
        let p = pressure[i] + omega * preconditioned[i];
        let r = stabilised[i] - omega * stabilised_product[i];
        pressure[i] = p;
        residual[i] = r;
        let square = density(i, r);
        let scale = density(i, diagonal[i] * p);
        own = sums(square * square, scale * scale, shadow[i] * r, 0.0);
    }
    add_up(group_of(group), local, own);
}
