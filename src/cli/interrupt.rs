//! Ctrl-C: the first asks a run to stop after its step and write what it has, the second kills it.

use std::process;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use super::CliError;

/// What a shell reports for a process that SIGINT ended.
const KILLED: i32 = 130;

/// True once Ctrl-C was pressed.
#[derive(Debug, Clone, Default)]
pub(super) struct StopFlag(Arc<AtomicBool>);

impl StopFlag {
    /// A flag that Ctrl-C raises. Once a process.
    ///
    /// # Errors
    /// The system refuses the handler, or there is one.
    pub fn on_interrupt() -> Result<Self, CliError> {
        let flag = Self::default();
        let handlers = flag.clone();
        ctrlc::set_handler(move || {
            if handlers.raise() {
                process::exit(KILLED);
            }
        })?;
        Ok(flag)
    }

    /// Whether it was up already.
    fn raise(&self) -> bool {
        self.0.swap(true, Ordering::Relaxed)
    }

    pub fn is_raised(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_second_time_is_told_from_the_first() {
        let flag = StopFlag::default();
        let seen_by_the_run = flag.clone();
        assert!(!seen_by_the_run.is_raised());
        assert!(!flag.raise());
        assert!(seen_by_the_run.is_raised());
        assert!(flag.raise());
    }
}
