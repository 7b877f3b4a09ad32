// Fluid does not pull: pressures below 0 become 0. Pa.

#import points

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < PADDED {
        pressure[i] = max(pressure[i], real(0.0));
    }
}
