// Where the fluid that arrives at a standing point came from: r0 - dt u, the velocity being that at the departure point itself
// (TRACE 1), or, where it is prescribed, half way (TRACE 1/2); to second order.

#import evaluate
#import finite
#import space

fn evaluate(j: u32, place: vector) -> vector {
    return evaluate_offset(j, shortest(place - position[j]), real(1.0) / support[j]);
}

// What is no number stays none: a lost velocity must be seen, and min and max may replace it by that of a corner.
fn back(here: vector, velocity: vector) -> vector {
    let place = here - clock[CLOCK_DT] * velocity;
    let inside = min(max(wrapped(place), vector()), SIZE);
    return select(place, inside, finite(place.x) && finite(place.y));
}

fn origin_of(i: u32) -> vector {
    let here = position[i];
    return back(here, evaluate(i, back(here, TRACE * moving[i])));
}
