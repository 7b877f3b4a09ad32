// Notes the first point whose carried field is not a number.

#import points
#import finite

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < POINTS && !finite(carried[i]) {
        atomicMin(&control[BAD_CARRIED], i);
    }
}
