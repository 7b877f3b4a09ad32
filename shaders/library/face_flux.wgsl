// The volume flux of the projected velocity out of cell i, m^2/s: sum_j w_ij d_ij . (u_i + u_j) / 2, the mean of two points on
// every face.

#import points
#import space

fn face_flux(i: u32) -> real {
    let here = position[i];
    let own = projected[i];
    var sum = real(0.0);
    let first = at(i, 0u, FACE_CAPACITY);
    let last = first + min(face_count[i], FACE_CAPACITY) * BLOCK;
    for (var slot = first; slot < last; slot += BLOCK) {
        let j = face_neighbours[slot];
        let d = shortest(position[j] - here);
        let u = projected[j] + own;
        sum += face_weight[slot] * (d.x * u.x + d.y * u.y);
    }
    return real(0.5) * sum;
}
