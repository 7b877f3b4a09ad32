// Solves the normal equations of one point for one right side: L L^T a = b, forward and backward through the factor.
//
// Shapes: the factor is 15 numbers a point, blocked: l00, l10, l11, ... l44, reciprocals on the diagonal.
// The file that imports this says what is fitted: `value`, a number or a vector of numbers side by side.

#import points

// Of x, y, x^2, xy, y^2.
struct Coefficients {
    a1: value,
    a2: value,
    a3: value,
    a4: value,
    a5: value,
}

fn solve(i: u32, b: Coefficients) -> Coefficients {
    // In scalars: local arrays would go to memory.
    let k = at(i, 0u, FACTOR);
    let l00 = factor[k];
    let l10 = factor[k + BLOCK];
    let l11 = factor[k + 2u * BLOCK];
    let l20 = factor[k + 3u * BLOCK];
    let l21 = factor[k + 4u * BLOCK];
    let l22 = factor[k + 5u * BLOCK];
    let l30 = factor[k + 6u * BLOCK];
    let l31 = factor[k + 7u * BLOCK];
    let l32 = factor[k + 8u * BLOCK];
    let l33 = factor[k + 9u * BLOCK];
    let l40 = factor[k + 10u * BLOCK];
    let l41 = factor[k + 11u * BLOCK];
    let l42 = factor[k + 12u * BLOCK];
    let l43 = factor[k + 13u * BLOCK];
    let l44 = factor[k + 14u * BLOCK];
    let y1 = b.a1 * l00;
    let y2 = (b.a2 - l10 * y1) * l11;
    let y3 = (b.a3 - l20 * y1 - l21 * y2) * l22;
    let y4 = (b.a4 - l30 * y1 - l31 * y2 - l32 * y3) * l33;
    let y5 = (b.a5 - l40 * y1 - l41 * y2 - l42 * y3 - l43 * y4) * l44;
    let a5 = y5 * l44;
    let a4 = (y4 - l43 * a5) * l33;
    let a3 = (y3 - l32 * a4 - l42 * a5) * l22;
    let a2 = (y2 - l21 * a3 - l31 * a4 - l41 * a5) * l11;
    let a1 = (y1 - l10 * a2 - l20 * a3 - l30 * a4 - l40 * a5) * l00;
    return Coefficients(a1, a2, a3, a4, a5);
}
