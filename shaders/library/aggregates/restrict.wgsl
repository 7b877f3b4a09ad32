// A residual summed up over the smallest aggregates. The file that imports this says which: `restricted`, its value at a point.

#import points
#import coarse_cycle

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let aggregate = index_of(group, local);
    if aggregate < cells_of(FINEST) {
        let place = place_of(FINEST, aggregate);
        var sum = real(0.0);
        for (var k = aggregate_start[place]; k < aggregate_start[place + 1u]; k++) {
            sum += restricted(aggregate_parts[k]);
        }
        begin(place, sum);
    }
}
