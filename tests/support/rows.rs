//! A run whose rows are kept.

use stillpoint::motion;
use stillpoint::simulation::{Diagnostics, Observer};

/// Keeps the rows of diagnostics, and of points that move those about them.
#[derive(Default)]
pub struct Rows {
    pub rows: Vec<Diagnostics>,
    pub moved: Vec<motion::Row>,
}

impl Observer for Rows {
    fn report(&mut self, row: &Diagnostics) {
        self.rows.push(row.clone());
    }

    fn moved(&mut self, row: &motion::Row) {
        self.moved.push(row.clone());
    }

    fn stop_requested(&self) -> bool {
        false
    }
}
