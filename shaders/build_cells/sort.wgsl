// Counting sort of the points into cells, 7 of 7: sorts each cell's few points, so that every run gives the same order.

#import points

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let cell = index_of(group, local);
    if cell < CELLS {
        let first = cell_start[cell];
        let last = cell_start[cell + 1u];
        for (var k = first + 1u; k < last; k++) {
            let point = cell_points[k];
            var hole = k;
            while hole > first {
                let before = cell_points[hole - 1u];
                if before < point {
                    break;
                }
                cell_points[hole] = before;
                hole--;
            }
            cell_points[hole] = point;
        }
    }
}
