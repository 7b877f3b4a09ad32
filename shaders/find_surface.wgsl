// How dense the points stand, over a full lattice, and which of them are the free surface.
//
// Of circles about all points, the one about a point of the surface is not covered by the others. A place R e on it lies in the
// circle about the neighbour at d if d.d < 2 R e.d. SURFACE_GAP uncovered places in a row make a surface.

#import mirror
#import crowding
#import unrolled/covered

var<private> density: real;
var<private> covered: u32;

fn visit(near: Neighbour) {
    density += crowd_weight(near.square);
    covered |= covered_by(near.offset, near.square);
}

fn has_gap(uncovered: u32) -> bool {
    var rows = uncovered;
    for (var step = 1u; step < SURFACE_GAP; step++) {
        rows &= (uncovered << step) | (uncovered >> (32u - step));
    }
    return rows != 0u;
}

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i >= PADDED {
        return;
    }
    density = real(0.0);
    covered = 0u;
    look_around(i);
    let crowd = density * (real(1.0) / LATTICE_CROWD);
    crowding[i] = crowd;
    surface[i] = select(0u, 1u, i < PRESSURED && is_free(neighbour_count[i], crowd, has_gap(~covered)));
}
