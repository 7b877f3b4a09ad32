// No advection: the velocity after the forces begins the next step, u = u'. Units: m/s.

#import points

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < PADDED {
        velocity[i] = moving[i];
    }
}
