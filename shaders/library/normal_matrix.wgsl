// Normal matrix of one point's least squares over its stored neighbours, and its Cholesky factor.
//
// Discrete: N = sum w b b^T, b = (x, y, x^2, xy, y^2, ...), (x, y) = d / radius; the paper's (2.5). N = L L^T.
// Shapes: sums of monomials make up the entries below the diagonal; the factor keeps reciprocals on the diagonal.

#import points
#import weight
#import unrolled/matrix

const TINY: real = 1e-30;

// A coefficient whose pivot fails is left out.
fn reciprocal_root(pivot: real, relative: real) -> real {
    return select(real(0.0), real(1.0) / sqrt(max(pivot, TINY)), relative > PIVOT_THRESHOLD);
}

fn relative_pivot(pivot: real, diagonal: real) -> real {
    return pivot / max(diagonal, TINY);
}

fn lower(least: real, pivot: real) -> real {
    return least - max(least - pivot, real(0.0));
}

fn moments_of(i: u32, radius: real, count: u32) -> Moments {
    let here = position[i];
    let per = real(1.0) / radius;
    var sum = Moments();
    let first = at(i, 0u, CAPACITY);
    let last = first + min(count, CAPACITY) * BLOCK;
    for (var slot = first; slot < last; slot += BLOCK) {
        let d = (position[neighbours[slot]] - here) * per;
        sum = add_moments(sum, d, weight(d.x * d.x + d.y * d.y));
    }
    return sum;
}
