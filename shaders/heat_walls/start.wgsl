// Heat that flows in through the walls, added to the middle of a step of the diffusion.
//
// Continuous: D n . grad T = q. Discrete: T_i += t q A_i / V_i, t = 0.25 dt. Units: K.

#import points

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < PADDED {
        scalar_middle[i] += real(0.25) * clock[CLOCK_DT] * heat_supply[i];
    }
}
