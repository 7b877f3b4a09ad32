// Advection, departure-point remap: the fit of the point nearest to where the fluid came from is evaluated there.
//
// Continuous: Du/Dt along the path of a fluid point. Discrete: u(r0) = u'(r0 - dt u'). Units: m/s.

#import departure
#import nearest

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i >= INTERIOR {
        return;
    }
    let origin = origin_of(i);
    velocity[i] = evaluate(nearest(origin, i), origin);
}
