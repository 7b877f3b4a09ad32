// BiCGStab, with a coarse pressure: it is part of M^-1 s.

#import points
#import coarse_at

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i < PADDED {
        preconditioned[i] += coarse_at(i);
    }
}
