// Buoyancy, added to the kick.
//
// Continuous: du/dt = -beta (T - T_0) g. Discrete: kick += t (T_i - T_0) l, l = -beta g, t the length of the kick, on walls too.
// Units: m/s.

#import points

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < PADDED {
        kick[i] += clock[CLOCK_KICK] * (temperature[i] - REFERENCE_TEMPERATURE) * LIFT;
    }
}
