// Moves the points of the fluid by what the pressure and the shift add to their way: r' = r* + displacement. Units: m.

#import points
#import tank

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < INTERIOR {
        let here = position[i];
        keep(i, here, here + displacement[i], projected[i]);
    }
}
