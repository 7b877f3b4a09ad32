// The pressure matrix over cells, 1 of 3: the place of each point's cell; 0 where the pressure is held. Shape: one number a point.

#import points
#import coarse_grids

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let cell = index_of(group, local);
    if cell < CELLS {
        let place = place_of(FINEST, cell);
        for (var k = cell_start[cell]; k < cell_start[cell + 1u]; k++) {
            let i = cell_points[k];
            coarse_cell[i] = select(0u, place, i < PRESSURED && surface[i] == 0u);
        }
    }
}
