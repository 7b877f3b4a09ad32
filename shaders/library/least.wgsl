// Weighted means of the pressure above the least one around a point, (D / n0) sum_j (p_j - p_min) d / |d|^2 w, Pa/m.
//
// p_min is the least pressure around the point, its own among them, which keeps points from clumping. The file that imports this says
// what else is made of the neighbours that have a pressure: `count`, with the offset over the radius and w / |d|^2.

#import mirror
#import mean

var<private> pass_two: bool;
var<private> least: real;
var<private> sum: vector;

fn visit(near: Neighbour) {
    if near.j >= PRESSURED {
        return;
    }
    if !pass_two {
        least = min(least, pressure[near.j]);
    } else if near.square > real(0.0) {
        let factor = mean_weight(near.square) / near.square;
        sum += (pressure[near.j] - least) * factor * near.offset;
        count(near.offset, factor);
    }
}

// The mean at point `i`, over the radius.
fn mean_above_least(i: u32) -> vector {
    least = pressure[i];
    pass_two = false;
    look_around(i);
    sum = vector();
    pass_two = true;
    look_around(i);
    return DIMENSIONS / LATTICE_DENSITY * sum;
}

// u' = u* - (dt / rho) grad p, and the way dt (u' - u*), of a gradient in units of the radius.
fn correct(i: u32, gradient: vector) {
    let change = -clock[CLOCK_CORRECTION] / RADIUS * gradient;
    projected[i] += change;
    displacement[i] = clock[CLOCK_DT] * change;
}
