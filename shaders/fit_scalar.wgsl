// The fit of a carried field: (2.5).
//
// Shapes: the value, then the coefficients, scaled by the support radius, blocked; in the unit of the field.

#import fit
#import unrolled/store_scalar_fit

alias value = real;

fn field(i: u32) -> value {
    return carried[i];
}

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < PADDED {
        store_scalar_fit(i, carried[i], fit(i));
    }
}
