// Shortens the way dt (u' - u*) that the pressure moves a point to LONGEST_PUSH spacings, less in short steps, and the change of velocity
// with it; counts the steps in which it did. m, m/s.

#import points

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i >= INTERIOR {
        return;
    }
    let longest = clock[CLOCK_SHARE] * clock[CLOCK_SHARE] * LONGEST_PUSH * SPACING;
    let length = sqrt(dot(displacement[i], displacement[i]));
    if length > longest {
        let less = (longest / length - real(1.0)) * displacement[i];
        displacement[i] += less;
        projected[i] += less / clock[CLOCK_DT];
        bounded[i] += 1u;
    }
}
