// The velocity in the middle of the kick, estimated with the pressure's kick g of the last steps; the kick is then
// forgotten.
//
// Discrete: u_m = u + kick - g; kick = 0. Units: m/s.

#import points

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < PADDED {
        projected[i] = velocity[i] + kick[i] - pressure_kick[i];
        kick[i] = vector();
    }
}
