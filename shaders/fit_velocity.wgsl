// The fits of the velocity that moves the points: (2.5) for u and for v.
//
// Shapes: ten numbers a point, blocked: a1 .. a5 of u, then of v, m/s, scaled by the support radius.

#import fit

alias value = vector;

fn field(i: u32) -> value {
    return moving[i];
}

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i >= PADDED {
        return;
    }
    let a = fit(i);
    let k = at(i, 0u, 2u * COEFFICIENTS);
    coefficients[k] = a.a1.x;
    coefficients[k + BLOCK] = a.a2.x;
    coefficients[k + 2u * BLOCK] = a.a3.x;
    coefficients[k + 3u * BLOCK] = a.a4.x;
    coefficients[k + 4u * BLOCK] = a.a5.x;
    coefficients[k + 5u * BLOCK] = a.a1.y;
    coefficients[k + 6u * BLOCK] = a.a2.y;
    coefficients[k + 7u * BLOCK] = a.a3.y;
    coefficients[k + 8u * BLOCK] = a.a4.y;
    coefficients[k + 9u * BLOCK] = a.a5.y;
}
