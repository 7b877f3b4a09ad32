// Where points may go. Between mirrors a point that would come nearer to a wall than CLEARANCE is put back as far as it came too near
// and loses its velocity towards the wall. Where walls are made of points, one that has passed them is lost: it stays where it is, at rest.

fn keep(i: u32, here: vector, there: vector, velocity: vector) {
    let least = vector(CLEARANCE, CLEARANCE);
    if MIRRORS {
        let high = SIZE - least;
        var speed = velocity;
        speed = select(speed, max(speed, vector()), there < least);
        speed = select(speed, min(speed, vector()), there > high);
        // A place that is no number stays none.
        let back = select(there, max(high + high - there, least), there > high);
        position[i] = select(back, min(least + least - there, high), there < least);
        projected[i] = speed;
        return;
    }
    let outside = any(here < -least) || any(here > SIZE + least);
    position[i] = select(there, here, outside);
    projected[i] = select(velocity, vector(), outside);
}
