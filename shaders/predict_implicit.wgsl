// What the source of the pressure is taken of after implicit viscosity: u_m + theta G, with the kick G of the mean pressure; on walls,
// where that is balanced, with the kick of the other forces. Units: m/s.

#import points

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < PADDED {
        projected[i] = middle[i] + clock[CLOCK_SEEN] * select(kick[i], pressure_kick[i], i < INTERIOR);
    }
}
