// Gives the walls their velocity back: u = u_wall at boundary points. Units: m/s.

#import points

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i >= INTERIOR && i < PADDED {
        projected[i] = velocity[i];
    }
}
