// Drag of a porous body, added to the kick.
//
// Continuous: du/dt = -(nu / k) u - F |u| u.
// Discrete:   w = m - h (nu / k + F |w|) w, m = u + kick - G, point by point: w = 2 m / (1 + a + sqrt((1 + a)^2 + 4 h F |m|)),
// a = h nu / k; kick += w - m. Units: m/s.

#import points
#import mean_kick_of

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i >= INTERIOR {
        return;
    }
    let slowing = clock[CLOCK_KICK] * resistance[i];
    if slowing == real(0.0) {
        return;
    }
    let moving = velocity[i] + kick[i] - mean_kick_of(i);
    let linear = real(1.0) + slowing;
    let root = sqrt(linear * linear + real(4.0) * slowing * DRAG_INERTIA * sqrt(dot(moving, moving)));
    let kept = real(2.0) / (linear + root);
    kick[i] += (kept - real(1.0)) * moving;
}
