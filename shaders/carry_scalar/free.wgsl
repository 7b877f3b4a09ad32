// What the flow carries, where it is not held: phi(r0) = phi~(r_d) but where D / V_i is zero. Units: those of the field.

#import brought

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < POINTS && reach[i] != real(0.0) {
        carried[i] = brought_to(i);
    }
}
