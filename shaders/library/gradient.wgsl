// The factors of the gradient's sum: of the difference of neighbour `slot` of point `i`, along x and along y, 1/m.

#import points

fn gradient_factors(i: u32, slot: u32) -> vector {
    let along_x = at(i, slot, 2u * CAPACITY);
    return vector(gradient_row[along_x], gradient_row[along_x + CAPACITY * BLOCK]);
}
