//! The scalar fields that the flow carries along.

use serde::Serialize;

use crate::case::{Case, Effects};

/// One of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
pub enum Carried {
    /// K
    Temperature,
    /// No unit; by its place in the case file.
    Tracer(usize),
}

impl Carried {
    /// Name in snake case.
    pub fn name(self) -> String {
        match self {
            Carried::Temperature => "temperature".to_owned(),
            Carried::Tracer(number) => format!("tracer_{number}"),
        }
    }
}

impl Case {
    /// The scalar fields of the case: the temperature, then the tracers.
    pub fn carried(&self) -> Vec<Carried> {
        let temperature = self.effects.heat.iter().map(|_| Carried::Temperature);
        temperature.chain((0..self.effects.tracers.len()).map(Carried::Tracer)).collect()
    }

    /// Those that diffuse.
    pub fn diffusing(&self) -> Vec<Carried> {
        self.carried().into_iter().filter(|&field| self.diffusivity(field) > 0.0).collect()
    }

    /// m^2/s
    pub fn diffusivity(&self, field: Carried) -> f64 {
        let Effects { heat, tracers, .. } = &self.effects;
        match field {
            Carried::Temperature => heat.as_ref().map_or(0.0, |heat| heat.diffusivity),
            Carried::Tracer(number) => tracers.get(number).map_or(0.0, |tracer| tracer.diffusivity),
        }
    }

    /// What a field is called where it is written.
    pub fn field_name(&self, field: Carried) -> String {
        match field {
            Carried::Temperature => field.name(),
            Carried::Tracer(number) => {
                self.effects.tracers.get(number).map_or(field.name(), |tracer| tracer.name.clone())
            }
        }
    }
}
