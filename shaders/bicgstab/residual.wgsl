// BiCGStab, check 3 of 4: r = b - (A + c v 1^T / N) p; shadow and direction begin as r.
// Sums over the points: the squares of r and of D p as densities, and r r.

#import matrix
#import shift_of
#import density
#import sums

fn unknown(i: u32) -> real {
    return pressure[i];
}

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    var own = sums();
    if i < PADDED {
        let r = select(real(0.0), source[i] - product_of(i) - shift_of(i), i < POINTS);
        residual[i] = r;
        shadow[i] = r;
        direction[i] = r;
        let square = density(i, r);
        let scale = density(i, diagonal[i] * pressure[i]);
        own = sums(square * square, scale * scale, r * r, 0.0);
    }
    add_up(group_of(group), local, own);
}
