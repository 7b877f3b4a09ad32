// Adds what implicit viscosity did to the kick: kick += u_m - b inside. Units: m/s.

#import points

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < INTERIOR {
        kick[i] += middle[i] - projected[i];
    }
}
