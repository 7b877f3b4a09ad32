// The volume flux of the projected velocity out of cell i, m^2/s: sum_k r_ik . u_k, a quadratic fitted on every face.
// Shapes: FLUX_CAPACITY factors of u a point, then as many of v, blocked.

#import points

fn fitted_flux(i: u32) -> real {
    var sum = real(0.0);
    let first = at(i, 0u, FLUX_CAPACITY);
    let along_x = at(i, 0u, 2u * FLUX_CAPACITY);
    let along_y = at(i, FLUX_CAPACITY, 2u * FLUX_CAPACITY);
    let end = min(flux_count[i], FLUX_CAPACITY) * BLOCK;
    for (var slot = 0u; slot < end; slot += BLOCK) {
        let u = projected[flux_points[first + slot]];
        sum += flux_row[along_x + slot] * u.x + flux_row[along_y + slot] * u.y;
    }
    return sum;
}
