// Moves the points of the fluid with the velocity under the forces alone: r* = r + dt u*. Units: m.

#import points
#import tank

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < INTERIOR {
        let here = position[i];
        let velocity = projected[i];
        keep(i, here, here + clock[CLOCK_DT] * velocity, velocity);
    }
}
