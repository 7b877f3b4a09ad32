// BiCGStab, check 1 of 4: the sum of p over the points, for the rank-one shift.

#import sums

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    var p = real(0.0);
    if i < PADDED {
        p = pressure[i];
    }
    add_up_one(group_of(group), local, p);
}
