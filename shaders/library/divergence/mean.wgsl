// Divergence of the velocity of MPS, 1/s: (D / n0) sum_j (u_j - u_i) . d / |d|^2 w, as (2.3) of the paper; nothing at the surface.

#import mirror
#import mean

var<private> flux: real;
var<private> own: vector;

fn visit(near: Neighbour) {
    if near.square > real(0.0) {
        flux += mean_weight(near.square) / near.square * dot(projected[near.j] - own, near.offset);
    }
}

fn divergence_of(i: u32) -> real {
    if i >= INTERIOR || surface[i] != 0u {
        return real(0.0);
    }
    flux = real(0.0);
    own = projected[i];
    look_around(i);
    return DIMENSIONS / LATTICE_DENSITY / RADIUS * flux;
}
