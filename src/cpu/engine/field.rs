//! What is done to a known field.

use super::{CpuEngine, with_taken};
use crate::cpu::operations::{derivative, integral};
use crate::cpu::real::Real;
use crate::engine::EngineError;
use crate::step::{Buffer, Operation};
use crate::with_space;

impl<T: Real> CpuEngine<T> {
    /// What is done to a known field.
    pub(super) fn field(&mut self, operation: Operation) -> Result<(), EngineError> {
        match operation {
            Operation::Average => {
                with_taken!(self.fields, [out = Buffer::FieldAverage], {
                    let field = self.fields.real(Buffer::Field)?;
                    with_space!(self.domain, space => integral::average(self.means(space)?, field, &mut out));
                });
            }
            Operation::Gradient => {
                with_taken!(self.fields, [out = Buffer::FieldGradient], {
                    derivative::gradient(self.gradient()?, self.fields.real(Buffer::Field)?, &mut out);
                });
            }
            _ => {
                with_taken!(self.fields, [out = Buffer::FieldLaplacian], {
                    derivative::laplacian(self.laplacian()?, self.fields.real(Buffer::Field)?, &mut out);
                });
            }
        }
        Ok(())
    }
}
