// Coefficient `k` of the stored fits of u and v at point `i`, m/s, scaled by the radius.

#import points

fn stored_coefficient(i: u32, k: u32) -> vector {
    let first = at(i, 0u, 2u * COEFFICIENTS) + k * BLOCK;
    return vector(coefficients[first], coefficients[first + COEFFICIENTS * BLOCK]);
}
