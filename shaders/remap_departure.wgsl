// Advection, departure-point remap: the fluid that arrives at a standing point came from r0 - dt u, the velocity being
// that at the departure point itself, to second order; the fit of the point nearest to that place is evaluated there.
//
// Continuous: Du/Dt along the path of a fluid point. Discrete: u(r0) = u'(r0 - dt u'). Units: m/s.

#import evaluate
#import finite
#import space

fn evaluate(j: u32, place: vector) -> vector {
    return evaluate_offset(j, shortest(place - position[j]), real(1.0) / support[j]);
}

fn square_to(j: u32, place: vector) -> real {
    let d = shortest(position[j] - place);
    return d.x * d.x + d.y * d.y;
}

// The point nearest to `place`, found by walking from point to nearer point among those around it: its neighbours, or
// those across the faces of its Voronoi cell.
fn nearest(place: vector, start: u32) -> u32 {
    var here = start;
    var least = square_to(here, place);
    loop {
        var next = here;
        let first = at(here, 0u, AROUND_CAPACITY);
        let last = first + min(around_count[here], AROUND_CAPACITY) * BLOCK;
        for (var slot = first; slot < last; slot += BLOCK) {
            let j = around[slot];
            let square = square_to(j, place);
            if square < least {
                next = j;
                least = square;
            }
        }
        if next == here {
            return here;
        }
        here = next;
    }
    return here;
}

// What is no number stays none: a lost velocity must be seen, and min and max may replace it by that of a corner.
fn back(here: vector, velocity: vector) -> vector {
    let place = here - clock[CLOCK_DT] * velocity;
    let inside = min(max(wrapped(place), vector()), SIZE);
    return select(place, inside, finite(place.x) && finite(place.y));
}

@compute @workgroup_size(GROUP)
fn main(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let i = index_of(group, local);
    if i >= INTERIOR {
        return;
    }
    let here = position[i];
    let departure = back(here, evaluate(i, back(here, moving[i])));
    velocity[i] = evaluate(nearest(departure, i), departure);
}
