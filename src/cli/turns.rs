//! The bar that shows how far a study has come.

use std::io::{self, IsTerminal};
use std::time::Duration;

use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::study::Turn;

/// Draws on standard error, where that is a terminal.
#[derive(Debug)]
pub(super) struct Turns(ProgressBar);

impl Turns {
    pub fn new(quiet: bool) -> Self {
        let target = match quiet || !io::stderr().is_terminal() {
            true => ProgressDrawTarget::hidden(),
            false => ProgressDrawTarget::stderr(),
        };
        let bar = ProgressBar::with_draw_target(Some(0), target);
        // The template is fixed and has a test; a plain bar is what remains of a broken one.
        if let Ok(style) = style() {
            bar.set_style(style);
        }
        Self(bar)
    }

    pub fn show(&self, turn: Turn<'_>) {
        self.0.set_length(turn.all as u64);
        self.0.set_position(turn.done as u64);
        self.0.set_message(message(turn));
        self.0.tick();
    }

    /// Takes the bar off the screen.
    pub fn finish(&self) {
        self.0.finish_and_clear();
    }
}

fn style() -> Result<ProgressStyle, indicatif::style::TemplateError> {
    Ok(ProgressStyle::with_template("[{bar:24}] {msg}")?.progress_chars("=> "))
}

fn message(Turn { done, all, words, left }: Turn<'_>) -> String {
    let left = left.map(|left| format!(", about {} left", HumanDuration(Duration::from_secs(left.as_secs()))));
    format!("run {} of {all}: {words}{}", done + 1, left.unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_template_is_valid() {
        style().expect("a valid template");
    }

    #[test]
    fn a_turn_says_which_run_it_is_and_how_long_the_rest_takes() {
        let turn = Turn { done: 3, all: 12, words: "random, 1/32", left: Some(Duration::from_millis(95_700)) };
        assert_eq!(message(turn), "run 4 of 12: random, 1/32, about 2 minutes left");
        assert_eq!(message(Turn { left: None, ..turn }), "run 4 of 12: random, 1/32");
    }
}
