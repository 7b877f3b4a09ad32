//! Which GPUs there are, and which of them a run takes.

use wgpu::{Adapter, DeviceType, DownlevelFlags, Features};

use crate::engine::{AdapterInfo, EngineError};

const NONE_FOUND: &str = "no GPU adapter found; install your GPU's Vulkan driver, or for a software one on Debian: apt-get install mesa-vulkan-drivers libvulkan1";

/// An adapter that a run could take.
#[derive(Debug, Clone)]
pub struct Candidate {
    pub info: AdapterInfo,
    /// Computes in f64 as well.
    pub double_precision: bool,
    /// Largest single array, bytes.
    pub largest_array: u64,
    pub(super) adapter: Adapter,
}

/// Every adapter that can run the shaders; hardware first, discrete GPUs before integrated ones.
pub fn list() -> Vec<Candidate> {
    let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
    // Validation of indirect dispatches would run a kernel before each of ours.
    descriptor.flags = wgpu::InstanceFlags::empty();
    descriptor.backends = wgpu::Backends::PRIMARY;
    let instance = wgpu::Instance::new(descriptor);
    let mut adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::PRIMARY));
    adapters.retain(|adapter| {
        let flags = adapter.get_downlevel_capabilities().flags;
        flags.contains(DownlevelFlags::COMPUTE_SHADERS | DownlevelFlags::INDIRECT_EXECUTION)
    });
    adapters.sort_by_key(|adapter| rank(adapter.get_info().device_type));
    adapters.into_iter().map(Candidate::new).collect()
}

/// The first adapter, or the first whose name contains `name`, capitals or not.
pub fn choose(name: Option<&str>) -> Result<Candidate, EngineError> {
    let all = list();
    if all.is_empty() {
        return Err(EngineError::Adapter(NONE_FOUND.to_owned()));
    }
    let names: Vec<String> = all.iter().map(|candidate| format!("{:?}", candidate.info.name)).collect();
    let wanted = name.map(str::to_lowercase);
    let fits = |candidate: &Candidate| {
        wanted.as_ref().is_none_or(|wanted| candidate.info.name.to_lowercase().contains(wanted))
    };
    all.into_iter().find(fits).ok_or_else(|| {
        let wanted = name.unwrap_or_default();
        EngineError::Adapter(format!("no GPU adapter has {wanted:?} in its name; there are: {}", names.join(", ")))
    })
}

fn rank(kind: DeviceType) -> u8 {
    match kind {
        DeviceType::DiscreteGpu => 0,
        DeviceType::IntegratedGpu => 1,
        DeviceType::VirtualGpu => 2,
        DeviceType::Other => 3,
        DeviceType::Cpu => 4,
    }
}

impl Candidate {
    fn new(adapter: Adapter) -> Self {
        let info = adapter.get_info();
        let limits = adapter.limits();
        Self {
            double_precision: adapter.features().contains(Features::SHADER_F64),
            largest_array: limits.max_storage_buffer_binding_size.min(limits.max_buffer_size),
            info: AdapterInfo {
                name: info.name,
                backend: info.backend.to_string(),
                driver: info.driver,
                driver_info: info.driver_info,
                software: info.device_type == DeviceType::Cpu,
            },
            adapter,
        }
    }
}
