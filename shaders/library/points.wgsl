// Which point, cell or partial sum an invocation stands for, and where its numbers stand in blocked arrays.

fn group_of(group: vec3<u32>) -> u32 {
    return group.y * MOST_GROUPS + group.x;
}

fn index_of(group: vec3<u32>, local: u32) -> u32 {
    return group_of(group) * GROUP + local;
}

// Number `slot` of `slots` of point `i`; the next slot stands BLOCK further on.
fn at(i: u32, slot: u32, slots: u32) -> u32 {
    return (i / BLOCK) * BLOCK * slots + slot * BLOCK + i % BLOCK;
}
