// Moves the interior points with the flow, and round where the domain repeats; walls stand.
//
// Continuous: dr/dt = u. Discrete: r' = r0 + dt u'. Units: m.

#import points
#import space

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < PADDED {
        let here = position[i];
        moved_position[i] = select(here, wrapped(here + clock[CLOCK_DT] * moving[i]), i < INTERIOR);
    }
}
