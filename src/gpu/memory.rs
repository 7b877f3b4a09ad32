//! The arrays on the GPU: allocated within its limits, written and read as the host's numbers.

use std::collections::BTreeMap;

use wgpu::{Buffer as GpuBuffer, BufferDescriptor, BufferUsages, MapMode};

use super::bindings::{Array, Own};
use super::device::Gpu;
use super::layout::{Extent, Scalar, Time, Word};
use super::prelude::{Precision, Shape};
use crate::engine::{Data, EngineError};
use crate::scene::Scene;
use crate::step::{Buffer, Element, Sizes};

/// Every array of a plan, and the engine's own.
pub(super) struct Memory {
    fields: BTreeMap<Buffer, GpuBuffer>,
    own: Vec<GpuBuffer>,
    sizes: Sizes,
    precision: Precision,
}

impl Memory {
    /// Allocates zeros. Fails where an array is larger than the GPU allows.
    pub fn new(gpu: &Gpu, scene: &Scene) -> Result<Self, EngineError> {
        let real = gpu.precision.bytes();
        let mut fields = BTreeMap::new();
        for buffer in scene.plan.buffers() {
            let bytes = scene.plan.bytes(buffer, &scene.sizes, real);
            fields.insert(buffer, allocate(gpu, &buffer.name(), bytes, BufferUsages::empty())?);
        }
        let shape = Shape::new(scene);
        let groups = shape.points as usize;
        let mut own = Vec::new();
        for array in Own::ALL {
            let (bytes, more) = match array {
                Own::Control => (4 * Word::NAMES.len(), BufferUsages::empty()),
                Own::Dispatches => (12 * Extent::NAMES.len(), BufferUsages::INDIRECT),
                Own::Clock => (real * Time::NAMES.len(), BufferUsages::empty()),
                Own::Scalars => (real * Scalar::NAMES.len(), BufferUsages::empty()),
                Own::Partials => (4 * real * (groups + shape.coarse as usize), BufferUsages::empty()),
                Own::CoarseRight | Own::CoarseValue | Own::CoarseSmoothed => {
                    (real * scene.sizes.coarse.max(1), BufferUsages::empty())
                }
                Own::Maxima => (2 * real * groups, BufferUsages::empty()),
                Own::Tally => (4 * (scene.sizes.cells + 1), BufferUsages::empty()),
                Own::TileSums => (4 * shape.cells as usize, BufferUsages::empty()),
            };
            own.push(allocate(gpu, array.name(), bytes, more)?);
        }
        Ok(Self { fields, own, sizes: scene.sizes, precision: gpu.precision })
    }

    pub fn own(&self, array: Own) -> &GpuBuffer {
        &self.own[array as usize]
    }

    pub fn field(&self, buffer: Buffer) -> Result<&GpuBuffer, EngineError> {
        self.fields.get(&buffer).ok_or(EngineError::Absent(buffer))
    }

    pub fn array(&self, array: Array) -> Result<&GpuBuffer, EngineError> {
        match array {
            Array::Field(buffer) => self.field(buffer),
            Array::Own(own) => Ok(self.own(own)),
        }
    }

    /// Replaces a whole array.
    pub fn write(&self, gpu: &Gpu, buffer: Buffer, data: &Data) -> Result<(), EngineError> {
        let target = self.field(buffer)?;
        let expected = buffer.length(&self.sizes);
        let length = match data {
            Data::Real(values) => values.len(),
            Data::Index(values) => values.len(),
        };
        let same_kind = matches!(data, Data::Index(_)) == (buffer.element() == Element::Index);
        if length != expected || !same_kind {
            return Err(EngineError::Length { buffer, expected, given: if same_kind { length } else { 0 } });
        }
        match data {
            Data::Real(values) => self.upload(gpu, target, values),
            Data::Index(values) => {
                self.check_indexes(buffer, values)?;
                self.upload_words(gpu, target, values)
            }
        }
    }

    /// Every array of indexes names points, but for counts and rungs.
    fn check_indexes(&self, buffer: Buffer, values: &[u32]) -> Result<(), EngineError> {
        if !matches!(
            buffer,
            Buffer::Neighbours(_)
                | Buffer::FaceNeighbours
                | Buffer::FluxPoints
                | Buffer::DepartureNearest
                | Buffer::OpenPoints
                | Buffer::CellPoints(_)
        ) {
            return Ok(());
        }
        match values.iter().position(|&index| index as usize >= self.sizes.points) {
            Some(entry) => Err(EngineError::Index { buffer, entry, index: values[entry] }),
            None => Ok(()),
        }
    }

    /// Writes floats in the engine's precision.
    pub fn upload(&self, gpu: &Gpu, target: &GpuBuffer, values: &[f64]) -> Result<(), EngineError> {
        gpu.checked("write", |_| match self.precision {
            Precision::Single => {
                let values: Vec<f32> = values.iter().map(|&value| value as f32).collect();
                gpu.queue.write_buffer(target, 0, bytemuck::cast_slice(&values));
            }
            Precision::Double => gpu.queue.write_buffer(target, 0, bytemuck::cast_slice(values)),
        })
    }

    pub fn upload_words(&self, gpu: &Gpu, target: &GpuBuffer, words: &[u32]) -> Result<(), EngineError> {
        gpu.checked("write", |_| gpu.queue.write_buffer(target, 0, bytemuck::cast_slice(words)))
    }

    /// A whole array.
    pub fn read(&self, gpu: &Gpu, buffer: Buffer) -> Result<Data, EngineError> {
        let mut arrays = [(buffer, Data::empty(buffer.element()))];
        self.read_all(gpu, &mut arrays)?;
        let [(_, data)] = arrays;
        Ok(data)
    }

    /// Several in one transfer.
    pub fn read_all(&self, gpu: &Gpu, arrays: &mut [(Buffer, Data)]) -> Result<(), EngineError> {
        let width = |buffer: Buffer| match buffer.element() {
            Element::Index => 4,
            Element::Real => self.precision.bytes(),
        };
        let size = |buffer: Buffer| width(buffer) * buffer.length(&self.sizes);
        let source = |(buffer, _): &(Buffer, Data)| Ok((self.field(*buffer)?, size(*buffer) as u64));
        let bytes = download(gpu, &arrays.iter().map(source).collect::<Result<Vec<_>, EngineError>>()?)?;
        let mut rest = &bytes[..];
        for (buffer, data) in arrays {
            let (own, others) = rest.split_at(size(*buffer));
            rest = others;
            *data = match buffer.element() {
                Element::Index => Data::Index(words(own)),
                Element::Real => Data::Real(self.reals(own)),
            };
        }
        Ok(())
    }

    /// The state of the batch and the scalars.
    pub fn read_state(&self, gpu: &Gpu) -> Result<(Vec<u32>, Vec<f64>), EngineError> {
        let state = 4 * Word::NAMES.len();
        let scalars = self.precision.bytes() * Scalar::NAMES.len();
        let arrays = [(self.own(Own::Control), state as u64), (self.own(Own::Scalars), scalars as u64)];
        let bytes = download(gpu, &arrays)?;
        let (state, scalars) = bytes.split_at(state);
        Ok((words(state), self.reals(scalars)))
    }

    /// Puts the state of the batch and the scalars back.
    pub fn write_state(&self, gpu: &Gpu, (words, scalars): (&[u32], &[f64])) -> Result<(), EngineError> {
        self.upload_words(gpu, self.own(Own::Control), words)?;
        self.upload(gpu, self.own(Own::Scalars), scalars)
    }

    /// Bytes of all arrays, the engine's own among them.
    pub fn bytes(&self) -> u64 {
        self.fields.values().chain(&self.own).map(GpuBuffer::size).sum()
    }

    fn reals(&self, bytes: &[u8]) -> Vec<f64> {
        match self.precision {
            Precision::Single => {
                bytes.chunks_exact(4).map(|entry| f64::from(bytemuck::pod_read_unaligned::<f32>(entry))).collect()
            }
            Precision::Double => bytes.chunks_exact(8).map(bytemuck::pod_read_unaligned::<f64>).collect(),
        }
    }
}

fn words(bytes: &[u8]) -> Vec<u32> {
    bytes.chunks_exact(4).map(bytemuck::pod_read_unaligned::<u32>).collect()
}

fn allocate(gpu: &Gpu, name: &str, bytes: usize, more: BufferUsages) -> Result<GpuBuffer, EngineError> {
    // An array without entries still has to be bound.
    let size = (bytes as u64).max(32).next_multiple_of(4);
    let allowed = gpu.limits.max_buffer_size.min(gpu.limits.max_storage_buffer_binding_size);
    if size > allowed {
        return Err(EngineError::TooLarge { what: name.to_owned(), needed: size, allowed });
    }
    let usage = BufferUsages::STORAGE | BufferUsages::COPY_SRC | BufferUsages::COPY_DST | more;
    let descriptor = BufferDescriptor { label: Some(name), size, usage, mapped_at_creation: false };
    gpu.checked(name, |device| device.create_buffer(&descriptor))
}

/// The first bytes of some buffers, one after another.
pub(super) fn download(gpu: &Gpu, sources: &[(&GpuBuffer, u64)]) -> Result<Vec<u8>, EngineError> {
    let size = sources.iter().map(|(_, bytes)| bytes).sum();
    let usage = BufferUsages::COPY_DST | BufferUsages::MAP_READ;
    let descriptor = BufferDescriptor { label: Some("read"), size, usage, mapped_at_creation: false };
    let (staging, commands) = gpu.checked("read", |device| {
        let staging = device.create_buffer(&descriptor);
        let mut encoder = device.create_command_encoder(&Default::default());
        let mut offset = 0;
        for (source, bytes) in sources {
            encoder.copy_buffer_to_buffer(source, 0, &staging, offset, *bytes);
            offset += bytes;
        }
        (staging, encoder.finish())
    })?;
    let index = gpu.checked("read", |_| gpu.queue.submit([commands]))?;
    // The outcome of the mapping shows when the range is asked for.
    gpu.checked("read", |_| staging.map_async(MapMode::Read, .., |_| {}))?;
    gpu.wait(index)?;
    let view = staging.get_mapped_range(..).map_err(|error| EngineError::Device(format!("read: {error}")))?;
    Ok(view.to_vec())
}
