// The collision guard, 2 of 2: velocities change by the impulses, places by the same over the step. Units: m/s, m.

#import points

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < INTERIOR {
        projected[i] += kick[i];
        position[i] += clock[CLOCK_DT] * kick[i];
    }
}
