//! What computes a setting: the CPU, or a GPU that is there.

use super::setting::{EngineKind, Knobs, Precision, Trial, refuse};
use crate::case::error::Place;
use crate::case::{Case, CaseError};
use crate::gpu::adapter::{self, Candidate};

/// The GPUs already looked up, by the name that was asked for.
#[derive(Debug, Default)]
pub(super) struct Gpus(Vec<(Option<String>, Candidate)>);

impl Gpus {
    /// A case on what its knobs ask for; `file` is named where no knob is at fault.
    ///
    /// # Errors
    /// A GPU that is not there, or lacks the precision; the name of one where none is asked for.
    pub fn trial(&mut self, case: Case, knobs: Knobs, file: &Place) -> Result<Trial, CaseError> {
        let engine = knobs.engine.as_ref().map_or(EngineKind::Cpu, |(engine, _)| *engine);
        let precision = knobs.precision.as_ref().map(|(precision, _)| *precision);
        let threads = knobs.threads.map_or(1, |(threads, _)| threads);
        let asked = knobs.adapter;
        if engine == EngineKind::Cpu {
            if let Some((name, place)) = &asked {
                let reason = "names a GPU, and engine is \"cpu\"; leave it out".to_owned();
                return Err(refuse("adapter", Some(&name.as_str().into()), place, reason));
            }
            let precision = precision.unwrap_or(Precision::F64);
            return Ok(Trial { case, engine, precision, adapter: None, threads });
        }
        let name = asked.as_ref().map(|(name, _)| name.clone());
        let gpu = match self.0.iter().find(|(known, _)| *known == name) {
            Some((_, gpu)) => gpu.clone(),
            None => {
                let found = adapter::choose(name.as_deref()).map_err(|error| match (&asked, &knobs.engine) {
                    (Some((name, place)), _) => {
                        refuse("adapter", Some(&name.as_str().into()), place, error.to_string())
                    }
                    (None, Some((_, place))) => refuse("engine", Some(&"gpu".into()), place, error.to_string()),
                    (None, None) => refuse("engine", None, file, error.to_string()),
                })?;
                self.0.push((name, found.clone()));
                found
            }
        };
        let adapter = Some(gpu.info.name.clone());
        match knobs.precision {
            Some((Precision::F64, place)) if !gpu.double_precision => {
                let reason = format!("{} has no f64 in shaders; allowed: \"f32\"", gpu.info.name);
                Err(refuse("precision", Some(&"f64".into()), &place, reason))
            }
            _ => Ok(Trial { case, engine, precision: precision.unwrap_or(Precision::F32), adapter, threads }),
        }
    }
}
