// The divergence that is to be taken off, 1/s, and the source with what the rest of the mean pressure's kick stands for, Pa.
//
// Discrete: d = -(h / rho) (b - theta K P) / V; b += (1 - theta) K P.

#import matrix

fn unknown(i: u32) -> real {
    return mean_pressure[i];
}

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < PADDED {
        let sum = product_of(i);
        let seen = source[i] - clock[CLOCK_SEEN] * sum;
        dilation[i] = -clock[CLOCK_CORRECTION] * seen / volume[i];
        source[i] = seen + sum;
    }
}
