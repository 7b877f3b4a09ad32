//! The setup of points that stand still: their neighbours, and the operators as sums over these.

use crate::case::Operators;
use crate::step::{Operation, Points};

/// The rows that a plan needs, and the form that they are of.
pub(super) struct Rows {
    pub operators: Operators,
    /// Every point has its own radius.
    pub graded: bool,
    pub laplacian: bool,
    pub gradient: bool,
}

impl Rows {
    /// Everything up to the rows: the search for neighbours, the fits where something needs them.
    pub fn setup(&self, evaluates_fits: bool) -> Vec<Operation> {
        use Operation::*;
        let points = Points::Standing;
        let interpolation = self.operators == Operators::Interpolation;
        let find = if self.graded { FindLocalNeighbours } else { FindNeighbours(points) };
        let mut setup = vec![BuildCells(points), find];
        if interpolation || evaluates_fits {
            setup.extend([Factorise(points), WidenSupport(points)]);
        }
        if self.laplacian {
            setup.push(if interpolation { AssembleLaplacian } else { AssembleIntegralLaplacian });
        }
        if self.gradient {
            setup.push(if interpolation { AssembleGradient } else { AssembleIntegralGradient });
        }
        setup
    }
}
