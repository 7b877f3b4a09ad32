//! The mean slope of the temperature across a side: what the cells on the side exchange with the others.
//!
//! Continuous: `(1/L) int n . grad T ds`. Discrete: `(1/L) sum_ij w_ij (T_j - T_i)`, `i` on the side, `j` not: the heat that the
//! diffusion of the run takes from a side that is held there, over the diffusivity. Unit: K/m.
//! A one-sided difference of fourth order in its place, over five values a spacing apart, is 1.0% off the published Nusselt number of
//! the heated cavity at Ra 1e5 on 1/64, and this 0.5%.

use super::MeasureError;
use super::loss::laid_out;
use crate::case::{Case, SideName};
use crate::cloud::Side;

/// Into the domain.
pub fn mean_slope(case: &Case, side: SideName, field: &[f64]) -> Result<f64, MeasureError> {
    let (cloud, cells) = laid_out(case, field, side.word())?;
    let (side, length) = match side {
        SideName::Left => (Side::Left, case.domain.height),
        SideName::Right => (Side::Right, case.domain.height),
        SideName::Bottom => (Side::Bottom, case.domain.width),
        SideName::Top => (Side::Top, case.domain.width),
    };
    let on = |point: usize| point >= cloud.interior && cloud.sides[point - cloud.interior].contains(&side);
    let exchanged = |point: usize| {
        let others = cells.faces(point).filter(|&(other, _)| !on(other));
        others.map(|(other, weight)| weight * (field[other] - field[point])).sum::<f64>()
    };
    Ok((cloud.interior..cloud.len()).filter(|&point| on(point)).map(exchanged).sum::<f64>() / length)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cloud::Cloud;
    use std::path::Path;

    #[test]
    fn a_linear_field_has_its_slope_across_every_side() {
        for arrangement in ["regular", "jittered", "random"] {
            let text = format!(
                "title = 'test'\nfluid.density = 1.0\ntime.end = 1.0\neffects.advection = {{}}\n\
                 domain = {{ width = 1.5, height = 1.0 }}\ncloud = {{ arrangement = '{arrangement}', spacing = 0.0625 }}\n"
            );
            let case = Case::from_text(&text, Path::new("test.toml"), &[]).expect("a case");
            let cloud = Cloud::build(&case).expect("a cloud");
            let field: Vec<f64> = cloud.position.iter().map(|x| 3.0 * x.x - 2.0 * x.y).collect();
            for (side, exact) in
                [(SideName::Left, 3.0), (SideName::Right, -3.0), (SideName::Bottom, -2.0), (SideName::Top, 2.0)]
            {
                // Along the side the cells of corners exchange with those of the other side's points.
                let found = mean_slope(&case, side, &field).expect("a slope");
                assert!((found - exact).abs() < 0.03, "{arrangement}, {side:?}: {found}, not {exact}");
            }
        }
    }
}
