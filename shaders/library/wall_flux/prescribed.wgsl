// The volume flux out of cell i through its walls, m^2/s: prescribed.

fn wall_flux_of(i: u32) -> real {
    return wall_flux[i];
}
