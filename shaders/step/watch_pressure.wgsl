// Notes the first point whose pressure is not a number.

#import points
#import finite

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < POINTS && !finite(pressure[i]) {
        atomicMin(&control[BAD_PRESSURE], i);
    }
}
