//! The bar that shows how far a run has come.

use std::io::{self, IsTerminal};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::interrupt::StopFlag;
use crate::simulation::{Diagnostics, Observer};

/// Ticks of a full bar.
const FULL: u64 = 1000;

/// Draws on standard error, where that is a terminal, and passes Ctrl-C on to the run.
///
/// The remaining time is that until `end`: a run that becomes steady first is done sooner.
#[derive(Debug)]
pub(super) struct Progress {
    bar: ProgressBar,
    /// s
    end: f64,
    stop: StopFlag,
}

impl Progress {
    /// `end` is the simulated time at which the bar is full, s.
    pub fn new(end: f64, quiet: bool, stop: StopFlag) -> Self {
        let target = match quiet || !io::stderr().is_terminal() {
            true => ProgressDrawTarget::hidden(),
            false => ProgressDrawTarget::stderr(),
        };
        Self::on(target, end, stop)
    }

    fn on(target: ProgressDrawTarget, end: f64, stop: StopFlag) -> Self {
        let bar = ProgressBar::with_draw_target(Some(FULL), target);
        // The template is fixed and has a test; a plain bar is what remains of a broken one.
        if let Ok(style) = style() {
            bar.set_style(style);
        }
        Self { bar, end, stop }
    }

    /// Takes the bar off the screen.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

fn style() -> Result<ProgressStyle, indicatif::style::TemplateError> {
    Ok(ProgressStyle::with_template("[{bar:24}] {percent:>3}% {msg}, {eta} left")?.progress_chars("=> "))
}

fn message(row: &Diagnostics) -> String {
    let Diagnostics { step, time, dt, residual, .. } = row;
    format!("step {step}, t {time:.3} s, dt {dt:.2e} s, residual {residual:.1e}")
}

impl Observer for Progress {
    fn report(&mut self, row: &Diagnostics) {
        let done = (row.time / self.end).clamp(0.0, 1.0) * FULL as f64;
        self.bar.set_position(done as u64);
        self.bar.set_message(message(row));
    }

    fn stop_requested(&self) -> bool {
        self.stop.is_raised()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_template_is_valid() {
        style().expect("a valid template");
    }

    #[test]
    fn a_row_moves_the_bar_and_says_what_it_holds() {
        let mut progress = Progress::on(ProgressDrawTarget::hidden(), 4.0, StopFlag::default());
        let row = Diagnostics { step: 70, time: 1.0, dt: 0.0125, residual: 3e-7, ..Diagnostics::default() };
        progress.report(&row);
        assert_eq!(progress.bar.position(), FULL / 4);
        assert_eq!(progress.bar.message(), "step 70, t 1.000 s, dt 1.25e-2 s, residual 3.0e-7");
        progress.report(&Diagnostics { time: 5.0, ..row });
        assert_eq!(progress.bar.position(), FULL);
    }
}
