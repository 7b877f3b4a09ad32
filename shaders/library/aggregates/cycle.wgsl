// One cycle through the levels of aggregates, in four parts as that through grids: see `coarse/cycle.wgsl`.

#import coarse_grids

fn smoothing(place: u32) -> real {
    return aggregate_matrix[PLACES + place];
}

// The right side, and the first smoothing.
fn begin(place: u32, right: real) {
    coarse_right[place] = right;
    coarse_value[place] = smoothing(place) * right;
}

// b - K x at an aggregate. One that has no links has no row, and nothing on its right side.
fn left_on(level: Level, place: u32) -> real {
    if smoothing(place) == real(0.0) {
        return real(0.0);
    }
    var left = coarse_right[place] - aggregate_matrix[place] * coarse_value[place];
    var entry = entry_of(level, place);
    for (var slot = 0u; slot < level.slots; slot++) {
        left += link(entry) * coarse_value[aggregate_neighbours[entry]];
        entry += width_of(level);
    }
    return left;
}

// What the parts of an aggregate leave.
fn left_below(fine: Level, coarse: Level, aggregate: u32) -> real {
    var sum = real(0.0);
    let place = place_of(coarse, aggregate);
    for (var k = aggregate_start[place]; k < aggregate_start[place + 1u]; k++) {
        sum += left_on(fine, aggregate_parts[k]);
    }
    return sum;
}

fn parent_of(fine: Level, coarse: Level, aggregate: u32) -> u32 {
    return aggregate_parent[place_of(fine, aggregate)];
}
