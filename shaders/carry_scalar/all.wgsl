// What the flow carries: phi(r0) = phi~(r_d), on walls too. Units: those of the field.

#import brought

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < POINTS {
        carried[i] = brought_to(i);
    }
}
