// The coarse pressure arrives at the smallest aggregates and is smoothed there; its product with the residual over them.

#import sums
#import coarse_cycle

// What stands at an aggregate once what the larger one has found is added.
fn value_at(place: u32) -> real {
    if cells_of(SECOND) > 0u {
        return coarse_value[place] + coarse_smoothed[aggregate_parent[place]];
    }
    return coarse_value[place];
}

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let aggregate = index_of(group, local);
    var product = real(0.0);
    if aggregate < cells_of(FINEST) {
        let place = place_of(FINEST, aggregate);
        let factor = smoothing(place);
        if factor != real(0.0) {
            let own = value_at(place);
            var left = coarse_right[place] - aggregate_matrix[place] * own;
            var entry = entry_of(FINEST, place);
            for (var slot = 0u; slot < FINEST.slots; slot++) {
                left += link(entry) * value_at(aggregate_neighbours[entry]);
                entry += width_of(FINEST);
            }
            let smoothed = own + factor * left;
            coarse_smoothed[place] = smoothed;
            product = coarse_right[place] * smoothed;
        }
    }
    let number = group_of(group);
    add_up_one_to(GROUPS + number, number < COARSE_GROUPS, local, product);
}
