//! What a software adapter gets wrong without saying so.

use wgpu::util::{BufferInitDescriptor, DeviceExt};
use wgpu::{BufferUsages, ComputePipelineDescriptor, ShaderSource};

use super::device::Gpu;
use super::memory;
use crate::engine::EngineError;

/// More rounds than the 65,535 after which Mesa's lavapipe before 23 leaves a loop.
const ROUNDS: u32 = 70_000;

/// Rounds after which the driver leaves a loop, where it does so before [`ROUNDS`].
pub(super) fn loop_limit(gpu: &Gpu) -> Result<Option<u32>, EngineError> {
    let (commands, counted) = gpu.checked("self-test", |device| {
        let source = ShaderSource::Wgsl(include_str!("../../shaders/self_test/count.wgsl").into());
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor { label: Some("self_test"), source });
        let pipeline = device.create_compute_pipeline(&ComputePipelineDescriptor {
            label: Some("self_test"),
            layout: None,
            module: &module,
            entry_point: Some("main"),
            compilation_options: Default::default(),
            cache: None,
        });
        let counted = device.create_buffer_init(&BufferInitDescriptor {
            label: Some("self_test"),
            contents: bytemuck::cast_slice(&[0, ROUNDS, 0]),
            usage: BufferUsages::STORAGE | BufferUsages::COPY_SRC,
        });
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("self_test"),
            layout: &pipeline.get_bind_group_layout(0),
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: counted.as_entire_binding() }],
        });
        let mut encoder = device.create_command_encoder(&Default::default());
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups(1, 1, 1);
        drop(pass);
        (encoder.finish(), counted)
    })?;
    gpu.run(commands)?;
    let words = memory::download(gpu, &[(&counted, 4)])?;
    let rounds = bytemuck::pod_read_unaligned::<u32>(&words);
    Ok((rounds < ROUNDS).then_some(rounds))
}
