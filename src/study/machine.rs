//! The machine that a study runs on, as its pictures name it.

use std::fmt::{self, Display, Formatter};
use std::fs;
use std::thread;

use serde::{Deserialize, Serialize};

#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Machine {
    /// The processor's name; its architecture where the system does not tell.
    pub processor: String,
    /// Threads that it runs side by side.
    pub cores: usize,
    pub system: String,
}

impl Machine {
    pub fn here() -> Self {
        let named = fs::read_to_string("/proc/cpuinfo").ok().and_then(|text| processor(&text));
        Self {
            processor: named.unwrap_or_else(|| std::env::consts::ARCH.to_owned()),
            cores: thread::available_parallelism().map_or(1, usize::from),
            system: std::env::consts::OS.to_owned(),
        }
    }
}

impl Display for Machine {
    fn fmt(&self, out: &mut Formatter<'_>) -> fmt::Result {
        let cores = if self.cores == 1 { "core" } else { "cores" };
        write!(out, "{}, {} {cores}, {}", self.processor, self.cores, self.system)
    }
}

/// The first processor's name in what Linux says of them.
fn processor(text: &str) -> Option<String> {
    let name = |line: &str| {
        line.split_once(':').filter(|(key, _)| key.trim() == "model name").map(|(_, name)| name.to_owned())
    };
    let name = text.lines().find_map(name)?;
    let plain = name.replace("(R)", "").replace("(TM)", "").replace(" CPU", "");
    Some(plain.split_whitespace().collect::<Vec<_>>().join(" ")).filter(|name| !name.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_processor_is_the_first_one_named() {
        let text = "processor\t: 0\nmodel\t\t: 143\nmodel name\t: Intel(R) Xeon(R)  CPU @ 2.50GHz\nprocessor\t: 1\nmodel name\t: Other\n";
        assert_eq!(processor(text), Some("Intel Xeon @ 2.50GHz".to_owned()));
        assert_eq!(processor("processor\t: 0\n"), None);
        assert_eq!(processor("model name\t: \n"), None);
    }

    #[test]
    fn a_machine_is_one_line() {
        let machine = Machine { processor: "A Chip".into(), cores: 2, system: "linux".into() };
        assert_eq!(machine.to_string(), "A Chip, 2 cores, linux");
        assert!(Machine::here().cores >= 1 && !Machine::here().to_string().contains('\n'));
    }
}
