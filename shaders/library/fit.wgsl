// Least-squares fit of one field at one point.
//
// Continuous: phi(x) ~ phi_i + grad phi . d + (1/2) d . H d.
// Discrete:   phi_j - phi_i = a1 x + a2 y + a3 x^2 + a4 xy + a5 y^2, (x, y) = d / r_e, weighted by w(r): the paper's (2.5).
// The file that imports this says what is fitted: `value`, the type, and `field`, the value at a point.

#import points
#import space
#import weight
#import normal_equations

struct Fit {
    a1: value,
    a2: value,
    a3: value,
    a4: value,
    a5: value,
    // 1 / r_e, 1/m: one factor a derivative.
    per: real,
}

fn fit(i: u32) -> Fit {
    let here = position[i];
    let per = real(1.0) / support[i];
    let own = field(i);
    var b1 = value();
    var b2 = value();
    var b3 = value();
    var b4 = value();
    var b5 = value();
    let first = at(i, 0u, CAPACITY);
    let last = first + min(neighbour_count[i], CAPACITY) * BLOCK;
    for (var slot = first; slot < last; slot += BLOCK) {
        let j = neighbours[slot];
        let d = shortest(position[j] - here) * per;
        let weighted = weight(d.x * d.x + d.y * d.y) * (field(j) - own);
        b1 += weighted * d.x;
        b2 += weighted * d.y;
        b3 += weighted * (d.x * d.x);
        b4 += weighted * (d.x * d.y);
        b5 += weighted * (d.y * d.y);
    }
    let a = solve(i, Coefficients(b1, b2, b3, b4, b5));
    return Fit(a.a1, a.a2, a.a3, a.a4, a.a5, per);
}
