//! The parts of the kernels whose length depends on the order of the fit, written out number by number: a GPU keeps scalars
//! in registers, and would put local arrays into memory. The CPU's twin of all of it is `cpu/operations/moments.rs`.

use std::fmt::Write;

use crate::cpu::operations::moments::{MONOMIALS, coefficients, entries, moments, start};

/// The text of a library file for fits of this order; `None` for a name that stands for none.
pub(super) fn library(name: &str, order: usize) -> Option<String> {
    let mut text = Text(String::new());
    match name {
        "unrolled/monomials" => monomials(&mut text, order),
        "unrolled/coefficients" => combinations(&mut text, order),
        "unrolled/solve" => solution(&mut text, order),
        "unrolled/matrix" => matrix(&mut text, order),
        "unrolled/store_fit" => store_fit(&mut text, order),
        "unrolled/stored_fit" => stored_fit(&mut text, order),
        "unrolled/store_scalar_fit" => store_scalar_fit(&mut text, order),
        "unrolled/stored_scalar_fit" => stored_scalar_fit(&mut text, order),
        _ => return None,
    }
    Some(text.0)
}

/// Lines of WGSL.
struct Text(String);

impl Text {
    fn line(&mut self, content: impl AsRef<str>) {
        // Writing to a string cannot fail.
        let _ = writeln!(self.0, "{}", content.as_ref());
    }

    fn structure(&mut self, name: &str, fields: impl Iterator<Item = String>, kind: &str) {
        self.line(format!("struct {name} {{"));
        fields.for_each(|field| self.line(format!("    {field}: {kind},")));
        self.line("}");
    }
}

/// Degree and power of y.
fn monomial(k: usize) -> (usize, usize) {
    MONOMIALS[k]
}

fn each(letter: char, count: usize) -> impl Iterator<Item = String> {
    (0..count).map(move |k| format!("{letter}{k}"))
}

/// `x, y, x^2, xy, y^2, ...` of a scaled offset.
fn monomials(text: &mut Text, order: usize) {
    let count = coefficients(order);
    text.structure("Monomials", each('b', count), "real");
    text.line("fn monomials(d: vector) -> Monomials {");
    text.line("    let b0 = d.x;\n    let b1 = d.y;");
    for (k, (degree, power)) in MONOMIALS.into_iter().enumerate().take(count).skip(2) {
        let (first, previous) = (start(degree), start(degree - 1));
        if power < degree {
            text.line(format!("    let b{k} = d.x * b{};", previous + k - first));
        } else {
            text.line(format!("    let b{k} = d.y * b{};", first - 1));
        }
    }
    text.line(format!("    return Monomials({});\n}}", each('b', count).collect::<Vec<_>>().join(", ")));
}

/// Coefficients of a fit: as right sides of the normal equations, and as the polynomial that they make.
fn combinations(text: &mut Text, order: usize) {
    let count = coefficients(order);
    text.structure("Coefficients", each('a', count), "value");
    text.line("fn add_term(sum: Coefficients, b: Monomials, weighted: value) -> Coefficients {");
    let terms: Vec<_> = (0..count).map(|k| format!("sum.a{k} + weighted * b.b{k}")).collect();
    text.line(format!("    return Coefficients({});\n}}", terms.join(", ")));
    text.line("fn along(c: Coefficients, b: Monomials) -> value {");
    let terms: Vec<_> = (0..count).map(|k| format!("c.a{k} * b.b{k}")).collect();
    text.line(format!("    return {};\n}}", terms.join(" + ")));
}

/// The normal equations solved through the factor, forward and backward.
fn solution(text: &mut Text, order: usize) {
    let count = coefficients(order);
    text.line("fn solve(i: u32, b: Coefficients) -> Coefficients {\n    let k = at(i, 0u, FACTOR);");
    let entry = |row: usize, column: usize| format!("l{}", entries(row) + column);
    for k in 0..entries(count) {
        text.line(format!("    let l{k} = factor[k + {k}u * BLOCK];"));
    }
    for row in 0..count {
        let known: String = (0..row).map(|k| format!(" - {} * y{k}", entry(row, k))).collect();
        text.line(format!("    let y{row} = (b.a{row}{known}) * {};", entry(row, row)));
    }
    for row in (0..count).rev() {
        let known: String = (row + 1..count).map(|k| format!(" - {} * x{k}", entry(k, row))).collect();
        text.line(format!("    let x{row} = (y{row}{known}) * {};", entry(row, row)));
    }
    text.line(format!("    return Coefficients({});\n}}", each('x', count).collect::<Vec<_>>().join(", ")));
}

/// The sums that make up the normal matrix, and its Cholesky factor with its relative pivots.
fn matrix(text: &mut Text, order: usize) {
    let (count, sums) = (coefficients(order), moments(order));
    text.structure("Moments", each('m', sums), "real");
    text.line("fn add_moments(sum: Moments, d: vector, weight: real) -> Moments {");
    text.line("    let t1_0 = weight * d.x;\n    let t1_1 = weight * d.y;");
    let mut terms = Vec::new();
    for degree in 2..=2 * order {
        for power in 0..=degree {
            let (from, axis) = if power < degree { (power, "x") } else { (power - 1, "y") };
            let k = start(degree) - start(2) + power;
            let product = format!("t{}_{from} * d.{axis}", degree - 1);
            if degree < 2 * order {
                text.line(format!("    let t{degree}_{power} = {product};"));
                terms.push(format!("sum.m{k} + t{degree}_{power}"));
            } else {
                terms.push(format!("sum.m{k} + {product}"));
            }
        }
    }
    text.line(format!("    return Moments({});\n}}", terms.join(", ")));

    text.structure("Factor", each('l', entries(count)).chain(each('p', count)), "real");
    text.line("fn factor_of(m: Moments) -> Factor {\n    var f: Factor;");
    for row in 0..count {
        for column in 0..=row {
            let ((degree, power), (other, its)) = (monomial(row), monomial(column));
            let moment = format!("m.m{}", start(degree + other) - start(2) + power + its);
            let known: String =
                (0..column).map(|k| format!(" - f.l{} * f.l{}", entries(row) + k, entries(column) + k)).collect();
            let place = entries(row) + column;
            if column < row {
                text.line(format!("    f.l{place} = ({moment}{known}) * f.l{};", entries(column) + column));
            } else {
                text.line(format!("    let p{row} = {moment}{known};"));
                text.line(format!("    f.p{row} = relative_pivot(p{row}, {moment});"));
                text.line(format!("    f.l{place} = reciprocal_root(p{row}, f.p{row});"));
            }
        }
    }
    text.line("    return f;\n}");

    // The least pivot of a leading part, and the factor cut back to it.
    text.line("fn least_pivot(f: Factor, order: u32) -> real {\n    var least = real(1.0);");
    for degree in 1..=order {
        text.line(format!("    if order >= {degree}u {{"));
        for k in start(degree)..start(degree + 1) {
            text.line(format!("        least = lower(least, f.p{k});"));
        }
        text.line("    }");
    }
    text.line("    return least;\n}");
    text.line("fn store_factor(i: u32, f: Factor, order: u32) {\n    let k = at(i, 0u, FACTOR);");
    for row in 0..count {
        let (degree, _) = monomial(row);
        for place in entries(row)..entries(row + 1) {
            text.line(format!("    factor[k + {place}u * BLOCK] = select(real(0.0), f.l{place}, order >= {degree}u);"));
        }
    }
    text.line("}");
}

/// Puts the fit of a velocity where it is stored: the coefficients along x, then along y.
fn store_fit(text: &mut Text, order: usize) {
    let count = coefficients(order);
    text.line("fn store_fit(i: u32, a: Coefficients) {\n    let k = at(i, 0u, 2u * COEFFICIENTS);");
    for (axis, first) in [("x", 0), ("y", count)] {
        for k in 0..count {
            text.line(format!("    coefficients[k + {}u * BLOCK] = a.a{k}.{axis};", first + k));
        }
    }
    text.line("}");
}

/// The same taken out again.
fn stored_fit(text: &mut Text, order: usize) {
    let count = coefficients(order);
    text.line("fn stored_fit(i: u32) -> Coefficients {\n    let k = at(i, 0u, 2u * COEFFICIENTS);");
    let of = |k: usize| format!("vector(coefficients[k + {k}u * BLOCK], coefficients[k + {}u * BLOCK])", count + k);
    let all: Vec<_> = (0..count).map(of).collect();
    text.line(format!("    return Coefficients({});\n}}", all.join(", ")));
}

/// Puts the fit of a scalar field where it is stored: the value, then the coefficients.
fn store_scalar_fit(text: &mut Text, order: usize) {
    text.line("fn store_scalar_fit(i: u32, own: real, a: Coefficients) {\n    let k = at(i, 0u, 1u + COEFFICIENTS);");
    text.line("    scalar_fit[k] = own;");
    for k in 0..coefficients(order) {
        text.line(format!("    scalar_fit[k + {}u * BLOCK] = a.a{k};", k + 1));
    }
    text.line("}");
}

/// The coefficients taken out again.
fn stored_scalar_fit(text: &mut Text, order: usize) {
    text.line("fn stored_scalar_fit(i: u32) -> Coefficients {\n    let k = at(i, 0u, 1u + COEFFICIENTS);");
    let all: Vec<_> = (1..=coefficients(order)).map(|k| format!("scalar_fit[k + {k}u * BLOCK]")).collect();
    text.line(format!("    return Coefficients({});\n}}", all.join(", ")));
}
