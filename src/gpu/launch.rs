//! Compiled kernels with their arrays bound, ready to be dispatched.

use std::collections::HashMap;

use wgpu::{
    BindGroup, BindGroupDescriptor, BindGroupEntry, BindGroupLayout, BindGroupLayoutDescriptor, BindGroupLayoutEntry,
    BindingType, Buffer as GpuBuffer, BufferBindingType, ComputePass, ComputePipeline, ComputePipelineDescriptor,
    Device, PipelineCompilationOptions, PipelineLayoutDescriptor, ShaderModuleDescriptor, ShaderSource, ShaderStages,
};

use super::bindings::{Binding, bindings, declare};
use super::device::Gpu;
use super::layout::Extent;
use super::memory::Memory;
use super::prelude::prelude;
use super::sources::{self, Stage};
use crate::engine::EngineError;
use crate::scene::Scene;
use crate::step::Buffer;

/// One kernel, bound.
#[derive(Clone)]
pub(super) struct Launch {
    pipeline: ComputePipeline,
    group: BindGroup,
    extent: Option<Extent>,
}

impl Launch {
    pub fn encode(&self, pass: &mut ComputePass<'_>, dispatches: &GpuBuffer) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.group, &[]);
        match self.extent {
            Some(extent) => pass.dispatch_workgroups_indirect(dispatches, 12 * extent as u64),
            None => pass.dispatch_workgroups(1, 1, 1),
        }
    }
}

/// The source of a kernel as the driver gets it, and what it binds.
pub(super) fn assemble(
    stage: &Stage,
    scene: &Scene,
    prelude: &str,
    [reads, writes]: &[Vec<(Buffer, String)>; 2],
) -> Result<(String, Vec<Binding>), EngineError> {
    let text = sources::expand(stage, scene)?;
    let bindings = bindings(&text, reads, writes);
    Ok((format!("{prelude}\n{}\n{text}", declare(&bindings)), bindings))
}

/// Compiles each distinct source once.
pub(super) struct Compiler<'a> {
    gpu: &'a Gpu,
    scene: &'a Scene,
    memory: &'a Memory,
    prelude: String,
    compiled: HashMap<String, (ComputePipeline, BindGroupLayout)>,
}

impl<'a> Compiler<'a> {
    pub fn new(gpu: &'a Gpu, scene: &'a Scene, memory: &'a Memory) -> Self {
        Self { gpu, scene, memory, prelude: prelude(scene, gpu.precision), compiled: HashMap::new() }
    }

    pub fn launch(&mut self, stage: &Stage, arrays: &[Vec<(Buffer, String)>; 2]) -> Result<Launch, EngineError> {
        let (source, bindings) = assemble(stage, self.scene, &self.prelude, arrays)?;
        let allowed = self.gpu.limits.max_storage_buffers_per_shader_stage;
        if bindings.len() > allowed as usize {
            let (what, needed) = (format!("arrays bound at once by {}", stage.name), bindings.len());
            return Err(EngineError::Adapter(format!(
                "{what}: {needed}, and the adapter allows {allowed}; use the CPU engine"
            )));
        }
        let (pipeline, layout) = match self.compiled.get(&source) {
            Some(compiled) => compiled.clone(),
            None => {
                let compiled = built(self.gpu, stage.name, &source, &bindings)?;
                self.compiled.insert(source, compiled.clone());
                compiled
            }
        };
        let buffers = bindings.iter().map(|binding| self.memory.array(binding.array)).collect::<Result<Vec<_>, _>>()?;
        let entries: Vec<_> = (0_u32..)
            .zip(&buffers)
            .map(|(binding, buffer)| BindGroupEntry { binding, resource: buffer.as_entire_binding() })
            .collect();
        let descriptor = BindGroupDescriptor { label: Some(stage.name), layout: &layout, entries: &entries };
        let group = self.gpu.checked(stage.name, |device| device.create_bind_group(&descriptor))?;
        Ok(Launch { pipeline, group, extent: stage.extent })
    }
}

/// A shader that the driver takes.
pub(super) fn built(
    gpu: &Gpu,
    name: &str,
    source: &str,
    bindings: &[Binding],
) -> Result<(ComputePipeline, BindGroupLayout), EngineError> {
    gpu.checked(name, |device| compile(device, name, source, bindings)).map_err(|error| match error {
        EngineError::Device(message) => EngineError::Shader { name: name.to_owned(), message },
        error => error,
    })
}

fn compile(device: &Device, name: &str, source: &str, bindings: &[Binding]) -> (ComputePipeline, BindGroupLayout) {
    let entries: Vec<_> = (0_u32..)
        .zip(bindings)
        .map(|(number, binding)| BindGroupLayoutEntry {
            binding: number,
            visibility: ShaderStages::COMPUTE,
            ty: BindingType::Buffer {
                ty: BufferBindingType::Storage { read_only: !binding.written },
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        })
        .collect();
    let layout = device.create_bind_group_layout(&BindGroupLayoutDescriptor { label: Some(name), entries: &entries });
    let pipeline_layout = device.create_pipeline_layout(&PipelineLayoutDescriptor {
        label: Some(name),
        bind_group_layouts: &[Some(&layout)],
        immediate_size: 0,
    });
    let source = ShaderSource::Wgsl(source.into());
    let module = device.create_shader_module(ShaderModuleDescriptor { label: Some(name), source });
    let pipeline = device.create_compute_pipeline(&ComputePipelineDescriptor {
        label: Some(name),
        layout: Some(&pipeline_layout),
        module: &module,
        entry_point: Some("main"),
        // Every kernel writes its workgroup memory before it reads it.
        compilation_options: PipelineCompilationOptions {
            zero_initialize_workgroup_memory: false,
            ..Default::default()
        },
        cache: None,
    });
    (pipeline, layout)
}
