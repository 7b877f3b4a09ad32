// Goes on through the divergence-free velocity for the second half of the kick.
//
// Discrete: g = u + k - u_m, what the pressure took off; G += (g - G) / 2, its relaxed mean; u' = u_m + s (k - G), s the second
// half over the first; walls keep u_m. Units: m/s.
// Source: Zehnder, Narain and Thomaszewski, ACM Trans. Graph. 37(4), 2018; the relaxation is ours.

#import points

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i >= PADDED {
        return;
    }
    let middle = projected[i];
    if i >= INTERIOR {
        reflected[i] = middle;
        return;
    }
    let before = pressure_kick[i];
    let mean = before + PRESSURE_RELAXATION * (velocity[i] + kick[i] - middle - before);
    pressure_kick[i] = mean;
    reflected[i] = middle + clock[CLOCK_SECOND_KICK] * (kick[i] - mean);
}
