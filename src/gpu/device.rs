//! One opened GPU: its queue, its faults, and waiting for it.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use wgpu::{CommandBuffer, Device, ErrorFilter, Features, Limits, PollType, Queue};

use super::adapter::Candidate;
use super::prelude::Precision;
use super::self_test;
use crate::engine::{AdapterInfo, EngineError};

/// How long one submission may take before the GPU counts as hung.
const PATIENCE: Duration = Duration::from_secs(120);

/// Most characters of what a driver says that are passed on.
const LONGEST_LINE: usize = 300;

/// A GPU, opened.
pub struct Gpu {
    pub(super) device: Device,
    pub(super) queue: Queue,
    pub(super) limits: Limits,
    pub precision: Precision,
    pub info: AdapterInfo,
    /// Rounds after which the driver silently leaves a loop, where the self-test found such a limit. The engine's own
    /// loops stay far below it.
    pub loop_limit: Option<u32>,
    /// The first fault that the driver reported outside a call of ours.
    fault: Arc<Mutex<Option<String>>>,
}

impl Gpu {
    /// Opens an adapter for floats of `precision`.
    pub fn open(candidate: &Candidate, precision: Precision) -> Result<Self, EngineError> {
        Self::open_with(candidate, precision, Features::empty())
    }

    /// The same, with times taken of every operation where the adapter can.
    pub fn open_timed(candidate: &Candidate, precision: Precision) -> Result<Self, EngineError> {
        let wanted = Features::TIMESTAMP_QUERY | Features::TIMESTAMP_QUERY_INSIDE_PASSES;
        let offered = candidate.adapter.features().contains(wanted);
        Self::open_with(candidate, precision, if offered { wanted } else { Features::empty() })
    }

    fn open_with(candidate: &Candidate, precision: Precision, more: Features) -> Result<Self, EngineError> {
        if precision == Precision::Double && !candidate.double_precision {
            let name = &candidate.info.name;
            return Err(EngineError::Adapter(format!("{name} has no f64 in shaders; allowed: f32, or the CPU engine")));
        }
        let adapter = &candidate.adapter;
        let offered = adapter.limits();
        let limits = Limits {
            max_storage_buffers_per_shader_stage: offered.max_storage_buffers_per_shader_stage,
            max_storage_buffer_binding_size: offered.max_storage_buffer_binding_size,
            max_buffer_size: offered.max_buffer_size,
            ..Limits::downlevel_defaults()
        };
        let features = match precision {
            Precision::Single => Features::empty(),
            Precision::Double => Features::SHADER_F64,
        };
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("stillpoint"),
            required_features: features | more,
            required_limits: limits.clone(),
            ..Default::default()
        };
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor))
            .map_err(|error| EngineError::Adapter(format!("{}: {error}", candidate.info.name)))?;
        let fault = Arc::new(Mutex::new(None));
        let noted = Arc::clone(&fault);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| note(&noted, error.to_string())));
        let noted = Arc::clone(&fault);
        device.set_device_lost_callback(move |reason, message| {
            // Dropping the device ends here too.
            if reason != wgpu::DeviceLostReason::Destroyed {
                note(&noted, format!("the device was lost: {message}"));
            }
        });
        let mut gpu = Self { device, queue, limits, precision, info: candidate.info.clone(), loop_limit: None, fault };
        if gpu.info.software {
            gpu.loop_limit = self_test::loop_limit(&gpu)?;
        }
        Ok(gpu)
    }

    /// Runs `body` and turns what the device objects to in it into an error.
    pub(super) fn checked<T>(&self, what: &str, body: impl FnOnce(&Device) -> T) -> Result<T, EngineError> {
        let scopes = [ErrorFilter::OutOfMemory, ErrorFilter::Internal, ErrorFilter::Validation]
            .map(|filter| self.device.push_error_scope(filter));
        let result = body(&self.device);
        // Scopes nest: the last one pushed is the first one popped.
        let errors: Vec<_> = scopes.into_iter().rev().filter_map(|scope| pollster::block_on(scope.pop())).collect();
        match errors.into_iter().next() {
            Some(error) => Err(explain(what, &error)),
            None => self.healthy().map(|()| result),
        }
    }

    /// Submits and waits until it is done.
    pub(super) fn run(&self, commands: CommandBuffer) -> Result<(), EngineError> {
        let index = self.checked("submit", |_| self.queue.submit([commands]))?;
        self.wait(index)
    }

    pub(super) fn wait(&self, index: wgpu::SubmissionIndex) -> Result<(), EngineError> {
        let poll = PollType::Wait { submission_index: Some(index), timeout: Some(PATIENCE) };
        self.device
            .poll(poll)
            .map_err(|error| EngineError::Device(format!("no answer within {} s: {error}", PATIENCE.as_secs())))?;
        self.healthy()
    }

    fn healthy(&self) -> Result<(), EngineError> {
        match &*self.fault.lock().unwrap_or_else(PoisonError::into_inner) {
            Some(fault) => Err(EngineError::Device(fault.clone())),
            None => Ok(()),
        }
    }
}

fn note(fault: &Mutex<Option<String>>, message: String) {
    fault.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(one_line(&message));
}

/// What a device objects to, as an error of the engine.
pub(super) fn explain(what: &str, error: &wgpu::Error) -> EngineError {
    match error {
        wgpu::Error::OutOfMemory { .. } => EngineError::OutOfMemory { what: what.to_owned() },
        error => EngineError::Device(format!("{what}: {}", one_line(&error.to_string()))),
    }
}

/// Drivers and shader compilers say it on many lines.
fn one_line(message: &str) -> String {
    let words: Vec<&str> = message.split_whitespace().collect();
    let line = words.join(" ");
    match line.char_indices().nth(LONGEST_LINE) {
        Some((end, _)) => format!("{}...", &line[..end]),
        None => line,
    }
}
