// Where the fluid that arrives at every point came from, and the point nearest to there: once for all fields that are carried.
//
// Continuous: D phi / Dt = 0 along the path of a fluid point. Discrete: r_d = r0 - dt u(r0 - dt u). Units: m.

#import departure
#import nearest

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i >= POINTS {
        return;
    }
    // Fluid that comes in through a wall brings what stands there; normals are zero inside.
    let inward = dot(normal[i], moving[i]) < real(0.0);
    var origin = position[i];
    if !inward {
        origin = origin_of(i);
    }
    departure[i] = origin;
    departure_nearest[i] = nearest(origin, i);
}
