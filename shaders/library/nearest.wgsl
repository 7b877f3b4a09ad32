// The point nearest to `place`, found by walking from point to nearer point among those around it: its neighbours, or those
// across the faces of its Voronoi cell.

#import points
#import space

fn square_to(j: u32, place: vector) -> real {
    let d = shortest(position[j] - place);
    return d.x * d.x + d.y * d.y;
}

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
