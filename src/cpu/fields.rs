//! The arrays of the CPU engine, by name.

use std::collections::BTreeMap;

use crate::cpu::real::Real;
use crate::engine::{Data, EngineError, first_lost};
use crate::step::{Buffer, Element, Plan, Sizes};

/// Every array that a plan uses, in floats of type `T`.
#[derive(Debug, Clone)]
pub struct Fields<T> {
    reals: BTreeMap<Buffer, Vec<T>>,
    indexes: BTreeMap<Buffer, Vec<u32>>,
    sizes: Sizes,
}

impl<T: Real> Fields<T> {
    /// Zeros everywhere.
    pub fn new(plan: &Plan, sizes: Sizes) -> Self {
        let (mut reals, mut indexes) = (BTreeMap::new(), BTreeMap::new());
        for buffer in plan.buffers() {
            let length = buffer.length(&sizes);
            match buffer.element() {
                Element::Real => drop(reals.insert(buffer, vec![T::zero(); length])),
                Element::Index => drop(indexes.insert(buffer, vec![0; length])),
            }
        }
        Self { reals, indexes, sizes }
    }

    pub fn real(&self, buffer: Buffer) -> Result<&[T], EngineError> {
        self.reals.get(&buffer).map(Vec::as_slice).ok_or(EngineError::Absent(buffer))
    }

    pub fn index(&self, buffer: Buffer) -> Result<&[u32], EngineError> {
        self.indexes.get(&buffer).map(Vec::as_slice).ok_or(EngineError::Absent(buffer))
    }

    /// Takes an array out, to be changed while others are read; [`Fields::put`] brings it back.
    pub fn take(&mut self, buffer: Buffer) -> Result<Vec<T>, EngineError> {
        self.reals.get_mut(&buffer).map(std::mem::take).ok_or(EngineError::Absent(buffer))
    }

    pub fn put(&mut self, buffer: Buffer, values: Vec<T>) {
        self.reals.insert(buffer, values);
    }

    pub fn take_index(&mut self, buffer: Buffer) -> Result<Vec<u32>, EngineError> {
        self.indexes.get_mut(&buffer).map(std::mem::take).ok_or(EngineError::Absent(buffer))
    }

    pub fn put_index(&mut self, buffer: Buffer, values: Vec<u32>) {
        self.indexes.insert(buffer, values);
    }

    /// Replaces an array by what the host holds. Every index is checked: the operations rely on it.
    pub fn write(&mut self, buffer: Buffer, data: &Data) -> Result<(), EngineError> {
        let expected = buffer.length(&self.sizes);
        let given = match data {
            Data::Real(values) => values.len(),
            Data::Index(values) => values.len(),
        };
        if given != expected {
            return Err(EngineError::Length { buffer, expected, given });
        }
        match (data, buffer.element()) {
            (Data::Real(values), Element::Real) if self.reals.contains_key(&buffer) => {
                self.put(buffer, values.iter().map(|&value| T::from_f64(value)).collect());
                Ok(())
            }
            (Data::Index(values), Element::Index) if self.indexes.contains_key(&buffer) => {
                let bound = bound(buffer, &self.sizes);
                if let Some(entry) = values.iter().position(|&index| index as usize >= bound) {
                    return Err(EngineError::Index { buffer, entry, index: values[entry] });
                }
                self.put_index(buffer, values.clone());
                Ok(())
            }
            _ => Err(EngineError::Absent(buffer)),
        }
    }

    /// As [`Fields::read`], into memory at hand: that of a long array costs more than what is in it. The first entry that is
    /// no finite number, found in the same pass.
    pub fn read_into(&self, buffer: Buffer, data: &mut Data) -> Result<Option<usize>, EngineError> {
        match (buffer.element(), &mut *data) {
            (Element::Real, Data::Real(values)) => {
                let stored = self.real(buffer)?;
                values.resize(stored.len(), 0.0);
                let mut finite = true;
                for (value, stored) in values.iter_mut().zip(stored) {
                    *value = stored.to_f64();
                    finite &= value.is_finite();
                }
                return Ok(if finite { None } else { first_lost(values, |value| !value.is_finite()) });
            }
            (Element::Index, Data::Index(values)) => {
                values.clear();
                values.extend_from_slice(self.index(buffer)?);
            }
            _ => *data = self.read(buffer)?,
        }
        Ok(data.first_non_finite())
    }

    /// What the host is to see of an array.
    pub fn read(&self, buffer: Buffer) -> Result<Data, EngineError> {
        match buffer.element() {
            Element::Real => Ok(Data::Real(self.real(buffer)?.iter().map(|value| value.to_f64()).collect())),
            Element::Index => Ok(Data::Index(self.index(buffer)?.to_vec())),
        }
    }
}

/// What every entry of an index array must be below.
fn bound(buffer: Buffer, sizes: &Sizes) -> usize {
    match buffer {
        Buffer::Neighbours(_)
        | Buffer::FaceNeighbours
        | Buffer::FluxPoints
        | Buffer::DepartureNearest
        | Buffer::OpenPoints
        | Buffer::CellPoints(_) => sizes.points,
        Buffer::NeighbourCount(_) => sizes.capacity + 1,
        Buffer::FaceCount => sizes.face_capacity + 1,
        Buffer::FluxCount => sizes.flux_capacity + 1,
        Buffer::OpenCount => sizes.open_capacity + 1,
        Buffer::CoarseCell | Buffer::AggregateParent | Buffer::AggregateNeighbours => sizes.coarse,
        Buffer::CellStart(_) => sizes.points + 1,
        Buffer::AggregateStart => sizes.parts + 1,
        Buffer::AggregateParts => sizes.points.max(sizes.coarse),
        _ => u32::MAX as usize + 1,
    }
}
