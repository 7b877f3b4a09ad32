// The shift: points move apart where they stand closer than elsewhere, and the fields are carried to where they go.
//
// Discrete: delta_i = SHIFT_STRENGTH l0 sum_j -(d / |d|) (1 - |d| / r_s)^2, at most SHIFT_LONGEST spacings; at the surface without its
// part along the normal, beside the surface along it that of points closer than a spacing alone. u(r + delta) by the fit.
// Units: m, m/s.

#import mirror
#import unrolled/monomials
#import unrolled/coefficients
#import unrolled/stored_fit

alias value = vector;

const TINY_LENGTH: real = 1e-12;

var<private> full: vector;
var<private> parting: vector;
var<private> outward: vector;
var<private> shore: bool;

fn visit(near: Neighbour) {
    let distance = sqrt(max(near.square, TINY_LENGTH));
    let spacings = distance * (RADIUS / SPACING);
    let even = max(real(1.0) - spacings / SHIFT_REACH, real(0.0));
    let close = max(real(1.0) - spacings, real(0.0));
    let rest = max(real(1.0) - near.square, real(0.0));
    let direction = near.offset / distance;
    full -= even * even * direction;
    parting -= close * direction;
    outward -= rest * rest * direction;
    shore = shore || surface[near.j] != 0u;
}

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i >= INTERIOR {
        return;
    }
    full = vector();
    parting = vector();
    outward = vector();
    shore = false;
    look_around(i);
    let normal = outward / sqrt(max(dot(outward, outward), TINY_LENGTH));
    var delta = SHIFT_STRENGTH * full;
    let along_normal = dot(delta, normal);
    if surface[i] != 0u {
        delta -= along_normal * normal;
    } else if shore {
        delta += (SHIFT_PARTING * dot(parting, normal) - along_normal) * normal;
    }
    let length = sqrt(max(dot(delta, delta), TINY_LENGTH));
    if length > SHIFT_LONGEST {
        delta *= SHIFT_LONGEST / length;
    }
    delta *= clock[CLOCK_SHARE] * SPACING;
    projected[i] += along(stored_fit(i), monomials(delta / RADIUS));
    displacement[i] += delta;
}
