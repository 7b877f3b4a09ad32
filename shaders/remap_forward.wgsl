// Advection, the paper's remap (section 5): the fit of each moved point, evaluated at its standing place r0.
//
// Discrete: u(r0) = u'_i + a0 x + a1 y + a2 x^2 + a3 xy + a4 y^2 + ..., (x, y) = (r0 - r') / r_e. Units: m/s.

#import evaluate
#import space

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < INTERIOR {
        velocity[i] = evaluate_offset(i, shortest(position[i] - moved_position[i]), real(1.0) / moved_support[i]);
    }
}
