// Walls as mirrors: beside a wall every point has an image behind it, and sums over neighbours run over the images too.
//
// The image of (x, y) behind the wall at x = w is (2 w - x, y); in a corner there is one behind each wall and one behind both.
// The file that imports this says what is done with a neighbour: `visit`. Its offset is over the radius; `way` leads from a
// point to its image, m; `flip` is -1 along the axes across which it is an image; the slot of a point's own image is OWN.

#import points

const OWN: u32 = 0xffffffffu;

struct Neighbour {
    slot: u32,
    j: u32,
    offset: vector,
    square: real,
    way: vector,
    flip: vector,
}

fn image(slot: u32, j: u32, here: vector, there: vector, way: vector, flip: vector) {
    let offset = (there + way - here) * (real(1.0) / RADIUS);
    let square = dot(offset, offset);
    if !(square > real(1.0)) {
        visit(Neighbour(slot, j, offset, square, way, flip));
    }
}

fn images(slot: u32, j: u32, here: vector, there: vector, twice: vector, sees: vec2<bool>) {
    let way = twice - there - there;
    let none = real(0.0);
    let one = real(1.0);
    if sees.x {
        image(slot, j, here, there, vector(way.x, none), vector(-one, one));
    }
    if sees.y {
        image(slot, j, here, there, vector(none, way.y), vector(one, -one));
    }
    if sees.x && sees.y {
        image(slot, j, here, there, way, vector(-one, -one));
    }
}

// Visits every neighbour of point `i`, each followed by its images, then the images of the point itself.
fn look_around(i: u32) {
    let here = position[i];
    let per = real(1.0) / RADIUS;
    let low = vec2<bool>(here.x < RADIUS, here.y < RADIUS);
    let high = vec2<bool>(SIZE.x - here.x < RADIUS, SIZE.y - here.y < RADIUS);
    let sees = vec2<bool>(MIRRORS && (low.x || high.x), MIRRORS && (low.y || high.y));
    let twice = select(SIZE + SIZE, vector(), low);
    let first = at(i, 0u, CAPACITY);
    let last = first + min(neighbour_count[i], CAPACITY) * BLOCK;
    for (var slot = first; slot < last; slot += BLOCK) {
        let j = neighbours[slot];
        let there = position[j];
        let offset = (there - here) * per;
        visit(Neighbour(slot, j, offset, dot(offset, offset), vector(), vector(1.0, 1.0)));
        if sees.x || sees.y {
            images(slot, j, here, there, twice, sees);
        }
    }
    if sees.x || sees.y {
        images(OWN, i, here, here, twice, sees);
    }
}
