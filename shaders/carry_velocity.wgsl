// The velocity that the fluid brought along: the fit of the nearest point, evaluated where the fluid came from. Units: m/s.

#import evaluate
#import space

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i >= INTERIOR {
        return;
    }
    let j = departure_nearest[i];
    velocity[i] = evaluate_offset(j, shortest(departure[i] - position[j]), real(1.0) / support[j]);
}
