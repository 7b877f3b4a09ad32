// Sums over the points by a fixed tree, so that every run gives the same bits: eight times eight invocations a
// workgroup, one partial sum a workgroup; `total` adds those up.

#import points

var<workgroup> lane_sums: array<sums, GROUP>;
var<workgroup> row_sums: array<sums, GROUP_ROWS>;

// Writes the workgroup's sums. Every invocation calls it, those past the last point with zeros.
fn add_up(group: u32, local: u32, own: sums) {
    lane_sums[local] = own;
    workgroupBarrier();
    if local < GROUP_ROWS {
        var sum = sums();
        for (var k = 0u; k < GROUP / GROUP_ROWS; k++) {
            sum += lane_sums[local * (GROUP / GROUP_ROWS) + k];
        }
        row_sums[local] = sum;
    }
    workgroupBarrier();
    if local == 0u && group < GROUPS {
        var sum = sums();
        for (var k = 0u; k < GROUP_ROWS; k++) {
            sum += row_sums[k];
        }
        partials[group] = sum;
    }
}

// The same of a single number: a quarter of the work.
var<workgroup> lane_values: array<real, GROUP>;
var<workgroup> row_values: array<real, GROUP_ROWS>;

fn add_up_one(group: u32, local: u32, own: real) {
    add_up_one_to(group, group < GROUPS, local, own);
}

fn add_up_one_to(place: u32, counts: bool, local: u32, own: real) {
    lane_values[local] = own;
    workgroupBarrier();
    if local < GROUP_ROWS {
        var sum = real(0.0);
        for (var k = 0u; k < GROUP / GROUP_ROWS; k++) {
            sum += lane_values[local * (GROUP / GROUP_ROWS) + k];
        }
        row_values[local] = sum;
    }
    workgroupBarrier();
    if local == 0u && counts {
        var sum = real(0.0);
        for (var k = 0u; k < GROUP_ROWS; k++) {
            sum += row_values[k];
        }
        partials[place] = sums(sum, 0.0, 0.0, 0.0);
    }
}
