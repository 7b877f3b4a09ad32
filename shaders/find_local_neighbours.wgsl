// Neighbour search where the spacing varies: the points within each point's own radius, through the cell list.
//
// Shapes: one list of `CAPACITY` slots a point, blocked; unused slots hold the point itself, lists of the padding the last
// point. A list that would overflow raises the largest count met, which the host reports.

#import search

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i >= PADDED {
        return;
    }
    var met = 0u;
    if i < POINTS {
        met = search(i, support[i]);
    }
    pad_slots(i, met, min(i, POINTS - 1u));
    neighbour_count[i] = met;
    if met > CAPACITY {
        atomicMax(&control[MOST_NEIGHBOURS], met);
    }
}
