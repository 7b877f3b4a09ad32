// The collision guard, 1 of 2: the changes of velocity of points that are too close and approach each other, m/s.
//
// Of the velocity with which they approach, each takes off (1 + BOUNCE_RESTITUTION) / 2, all of it (1 + BOUNCE_RESTITUTION) beside
// a wall of points.

#import points

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i >= PADDED {
        return;
    }
    var sum = vector();
    let whole = real(1.0) + BOUNCE_RESTITUTION;
    let first = at(i, 0u, CAPACITY);
    let last = first + select(0u, min(neighbour_count[i], CAPACITY), i < INTERIOR) * BLOCK;
    for (var slot = first; slot < last; slot += BLOCK) {
        let j = neighbours[slot];
        let d = position[j] - position[i];
        let square = dot(d, d);
        let approach = dot(d, projected[i] - projected[j]);
        if square < BOUNCE_DISTANCE * BOUNCE_DISTANCE && square > real(0.0) && approach > real(0.0) {
            sum -= select(whole, real(0.5) * whole, j < INTERIOR) * approach / square * d;
        }
    }
    kick[i] = sum;
}
