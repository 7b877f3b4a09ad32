// Divergence of the projected velocity, 1/s: the volume flux out of a cell over its volume.

#import points
#import space
#import wall_flux_of

fn divergence_of(i: u32) -> real {
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
    return (real(0.5) * sum + wall_flux_of(i)) / volume[i];
}
