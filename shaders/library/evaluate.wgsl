// The stored fit of point `j` at offset `d` from it: u_j + a1 x + a2 y + a3 x^2 + a4 xy + a5 y^2, (x, y) = d / r_e. m/s.

#import points

fn evaluate_offset(j: u32, d: vector, per: real) -> vector {
    let k = at(j, 0u, 2u * COEFFICIENTS);
    let x = d.x * per;
    let y = d.y * per;
    var sum = moving[j];
    sum += vector(coefficients[k], coefficients[k + 5u * BLOCK]) * x;
    sum += vector(coefficients[k + BLOCK], coefficients[k + 6u * BLOCK]) * y;
    sum += vector(coefficients[k + 2u * BLOCK], coefficients[k + 7u * BLOCK]) * (x * x);
    sum += vector(coefficients[k + 3u * BLOCK], coefficients[k + 8u * BLOCK]) * (x * y);
    sum += vector(coefficients[k + 4u * BLOCK], coefficients[k + 9u * BLOCK]) * (y * y);
    return sum;
}
