//! Seconds of every operation of a batch, from timestamps that the GPU writes between them.

use wgpu::{
    Buffer as GpuBuffer, BufferDescriptor, BufferUsages, CommandEncoder, ComputePass, Features, QUERY_SET_MAX_QUERIES,
    QuerySet, QuerySetDescriptor, QueryType,
};

use super::device::Gpu;
use super::memory::download;
use crate::engine::{EngineError, Spent};
use crate::step::Operation;

/// Room for the timestamps of one batch.
pub(super) struct Timer {
    stamps: QuerySet,
    resolved: GpuBuffer,
    /// s a tick.
    period: f64,
}

impl Timer {
    /// `None` on a GPU that was not opened for it.
    pub fn new(gpu: &Gpu) -> Result<Option<Self>, EngineError> {
        if !gpu.device.features().contains(Features::TIMESTAMP_QUERY_INSIDE_PASSES) {
            return Ok(None);
        }
        let count = QUERY_SET_MAX_QUERIES;
        let usage = BufferUsages::QUERY_RESOLVE | BufferUsages::COPY_SRC;
        let room =
            BufferDescriptor { label: Some("times"), size: 8 * u64::from(count), usage, mapped_at_creation: false };
        let stamps = QuerySetDescriptor { label: Some("times"), ty: QueryType::Timestamp, count };
        let (stamps, resolved) =
            gpu.checked("times", |device| (device.create_query_set(&stamps), device.create_buffer(&room)))?;
        Ok(Some(Self { stamps, resolved, period: 1e-9 * f64::from(gpu.queue.get_timestamp_period()) }))
    }
}

/// The timestamps of one batch: one before its first operation, one after each. Without a timer it does nothing.
pub(super) struct Marks<'a> {
    timer: Option<&'a Timer>,
    operations: Vec<Operation>,
}

impl<'a> Marks<'a> {
    pub fn begin(timer: Option<&'a Timer>, pass: &mut ComputePass<'_>) -> Self {
        let marks = Self { timer, operations: Vec::new() };
        marks.write(pass);
        marks
    }

    pub fn after(&mut self, operation: Operation, pass: &mut ComputePass<'_>) {
        if self.timer.is_some() {
            self.operations.push(operation);
            self.write(pass);
        }
    }

    /// Whether there is room for so many more.
    pub fn hold(&self, more: usize) -> bool {
        self.operations.len() + more < QUERY_SET_MAX_QUERIES as usize
    }

    fn write(&self, pass: &mut ComputePass<'_>) {
        if let Some(timer) = self.timer {
            pass.write_timestamp(&timer.stamps, self.operations.len() as u32);
        }
    }

    pub fn resolve(&self, encoder: &mut CommandEncoder) {
        if let Some(timer) = self.timer {
            encoder.resolve_query_set(&timer.stamps, 0..self.operations.len() as u32 + 1, &timer.resolved, 0);
        }
    }

    /// Adds what the batch took, once it has run.
    pub fn add_to(&self, gpu: &Gpu, spent: &mut Spent) -> Result<(), EngineError> {
        let Some(timer) = self.timer else { return Ok(()) };
        let bytes = download(gpu, &[(&timer.resolved, 8 * (self.operations.len() as u64 + 1))])?;
        let ticks: Vec<u64> = bytes.chunks_exact(8).map(bytemuck::pod_read_unaligned).collect();
        for (operation, pair) in self.operations.iter().zip(ticks.windows(2)) {
            *spent.entry(*operation).or_default() += pair[1].saturating_sub(pair[0]) as f64 * timer.period;
        }
        Ok(())
    }
}
