// Normal matrix of one point's least squares over its stored neighbours, and its Cholesky factor.
//
// Discrete: N = sum w b b^T, b = (x, y, x^2, xy, y^2), (x, y) = d / radius; the paper's (2.5). N = L L^T.
// Shapes: twelve sums make up the 15 entries below the diagonal; the factor keeps reciprocals on the diagonal.

#import points
#import space
#import weight

// sum w x^a y^b, 2 <= a + b <= 4.
struct Moments {
    xx: real,
    xy: real,
    yy: real,
    xxx: real,
    xxy: real,
    xyy: real,
    yyy: real,
    xxxx: real,
    xxxy: real,
    xxyy: real,
    xyyy: real,
    yyyy: real,
}

fn moments_of(i: u32, radius: real, count: u32) -> Moments {
    let here = position[i];
    let per = real(1.0) / radius;
    var m = Moments();
    let first = at(i, 0u, CAPACITY);
    let last = first + min(count, CAPACITY) * BLOCK;
    for (var slot = first; slot < last; slot += BLOCK) {
        let d = shortest(position[neighbours[slot]] - here) * per;
        let xx = d.x * d.x;
        let xy = d.x * d.y;
        let yy = d.y * d.y;
        let w = weight(xx + yy);
        let wx = w * d.x;
        let wy = w * d.y;
        let wxx = wx * d.x;
        let wxy = wx * d.y;
        let wyy = wy * d.y;
        m.xx += wxx;
        m.xy += wxy;
        m.yy += wyy;
        m.xxx += wxx * d.x;
        m.xxy += wxx * d.y;
        m.xyy += wyy * d.x;
        m.yyy += wyy * d.y;
        m.xxxx += wxx * xx;
        m.xxxy += wxx * xy;
        m.xxyy += wxx * yy;
        m.xyyy += wyy * xy;
        m.yyyy += wyy * yy;
    }
    return m;
}

struct Factor {
    l00: real,
    l10: real,
    l11: real,
    l20: real,
    l21: real,
    l22: real,
    l30: real,
    l31: real,
    l32: real,
    l33: real,
    l40: real,
    l41: real,
    l42: real,
    l43: real,
    l44: real,
    // Least pivot met, relative to the diagonal entry it came from.
    least: real,
}

const TINY: real = 1e-30;

fn reciprocal_root(pivot: real) -> real {
    return real(1.0) / sqrt(max(pivot, TINY));
}

fn lower(least: real, pivot: real, diagonal: real) -> real {
    return least - max(least - pivot / max(diagonal, TINY), real(0.0));
}

fn factor_of(m: Moments) -> Factor {
    var f: Factor;
    f.least = lower(real(1.0), m.xx, m.xx);
    f.l00 = reciprocal_root(m.xx);
    f.l10 = m.xy * f.l00;
    let p1 = m.yy - f.l10 * f.l10;
    f.least = lower(f.least, p1, m.yy);
    f.l11 = reciprocal_root(p1);
    f.l20 = m.xxx * f.l00;
    f.l21 = (m.xxy - f.l20 * f.l10) * f.l11;
    let p2 = m.xxxx - f.l20 * f.l20 - f.l21 * f.l21;
    f.least = lower(f.least, p2, m.xxxx);
    f.l22 = reciprocal_root(p2);
    f.l30 = m.xxy * f.l00;
    f.l31 = (m.xyy - f.l30 * f.l10) * f.l11;
    f.l32 = (m.xxxy - f.l30 * f.l20 - f.l31 * f.l21) * f.l22;
    let p3 = m.xxyy - f.l30 * f.l30 - f.l31 * f.l31 - f.l32 * f.l32;
    f.least = lower(f.least, p3, m.xxyy);
    f.l33 = reciprocal_root(p3);
    f.l40 = m.xyy * f.l00;
    f.l41 = (m.yyy - f.l40 * f.l10) * f.l11;
    f.l42 = (m.xxyy - f.l40 * f.l20 - f.l41 * f.l21) * f.l22;
    f.l43 = (m.xyyy - f.l40 * f.l30 - f.l41 * f.l31 - f.l42 * f.l32) * f.l33;
    let p4 = m.yyyy - f.l40 * f.l40 - f.l41 * f.l41 - f.l42 * f.l42 - f.l43 * f.l43;
    f.least = lower(f.least, p4, m.yyyy);
    f.l44 = reciprocal_root(p4);
    return f;
}

fn store_factor(i: u32, f: Factor) {
    let k = at(i, 0u, FACTOR);
    factor[k] = f.l00;
    factor[k + BLOCK] = f.l10;
    factor[k + 2u * BLOCK] = f.l11;
    factor[k + 3u * BLOCK] = f.l20;
    factor[k + 4u * BLOCK] = f.l21;
    factor[k + 5u * BLOCK] = f.l22;
    factor[k + 6u * BLOCK] = f.l30;
    factor[k + 7u * BLOCK] = f.l31;
    factor[k + 8u * BLOCK] = f.l32;
    factor[k + 9u * BLOCK] = f.l33;
    factor[k + 10u * BLOCK] = f.l40;
    factor[k + 11u * BLOCK] = f.l41;
    factor[k + 12u * BLOCK] = f.l42;
    factor[k + 13u * BLOCK] = f.l43;
    factor[k + 14u * BLOCK] = f.l44;
}
