//! Pipelines, made once for each shader and set of constants. Layouts come from reflection.

use std::collections::{BTreeMap, HashMap};
use std::time::Duration;

use super::fault;
use crate::error::Error;
use crate::kernel::{Access, Binding, Pass, Shader};

/// A pipeline with the layouts of its groups.
#[derive(Clone)]
pub struct Pipeline {
    pub pipeline: wgpu::ComputePipeline,
    pub groups: BTreeMap<u32, wgpu::BindGroupLayout>,
}

/// The text, and the constants by their bits.
type Key = (String, Vec<(&'static str, u64)>);

pub struct Pipelines {
    device: wgpu::Device,
    queue: wgpu::Queue,
    made: HashMap<Key, Pipeline>,
    kept: HashMap<Key, Pipeline>,
}

impl Pipelines {
    pub fn new(device: wgpu::Device, queue: wgpu::Queue) -> Self {
        Self { device, queue, made: HashMap::new(), kept: HashMap::new() }
    }

    /// Retains the existing pipelines.
    pub fn keep(&mut self) {
        self.kept.extend(self.made.drain());
    }

    /// The number of pipelines.
    pub fn len(&self) -> usize {
        self.made.len() + self.kept.len()
    }

    /// Drops all that are not retained; programs keep their own.
    pub fn forget(&mut self) {
        self.made.clear();
    }

    /// The pipeline of a pass; for a user's law compilation times out after `patience`.
    pub fn get(&mut self, pass: &Pass, patience: Duration) -> Result<Pipeline, Error> {
        let constants = pass.constants.iter().map(|(name, value)| (*name, value.to_bits())).collect();
        let key = (pass.shader.text().to_owned(), constants);
        if let Some(known) = self.kept.get(&key).or_else(|| self.made.get(&key)) {
            return Ok(known.clone());
        }
        self.check(&pass.shader)?;
        let law = pass.shader.sources().iter().any(|source| source.law);
        let made = if law { patiently(&self.device, &self.queue, pass, patience) } else { scoped(&self.device, pass) };
        let pipeline = made.map_err(|error| blame(error, &pass.shader))?;
        self.made.insert(key, pipeline.clone());
        Ok(pipeline)
    }

    /// Checks a user's shader against the device's limits, with a readable error.
    fn check(&self, shader: &Shader) -> Result<(), Error> {
        let (limits, reflection) = (self.device.limits(), shader.reflection());
        let storage = reflection.bindings.iter().filter(|b| b.access != Access::Uniform).count();
        let theirs = shader.sources().iter().rfind(|source| !source.ours);
        let file = theirs.or(shader.sources().last()).map_or("a shader", |source| &source.file);
        let over = |what: &str, need: u64, limit: u64| {
            if need > limit {
                return Err(Error::Limit(format!("{file} needs {need} {what}; this device has {limit}")));
            }
            Ok(())
        };
        let groups = reflection.bindings.iter().map(|b| b.group + 1).max().unwrap_or(0);
        over("bind groups", groups.into(), limits.max_bind_groups.into())?;
        let bindings = reflection.bindings.iter().map(|b| b.binding).max().unwrap_or(0);
        over("as the number of a binding", bindings.into(), (limits.max_bindings_per_bind_group - 1).into())?;
        over("storage buffers", storage as u64, limits.max_storage_buffers_per_shader_stage.into())?;
        over(
            "invocations in a workgroup",
            reflection.workgroup.into(),
            limits.max_compute_invocations_per_workgroup.into(),
        )?;
        over("bytes of workgroup memory", reflection.workgroup_bytes, limits.max_compute_workgroup_storage_size.into())
    }
}

fn scoped(device: &wgpu::Device, pass: &Pass) -> Result<Pipeline, Error> {
    fault::scoped(device, || make(device, pass))
}

/// The same for a user's law, which a driver may never finish to compile.
#[cfg(not(target_arch = "wasm32"))]
fn patiently(device: &wgpu::Device, queue: &wgpu::Queue, pass: &Pass, patience: Duration) -> Result<Pipeline, Error> {
    super::patience::made(device, queue, pass, patience)
}

#[cfg(target_arch = "wasm32")]
fn patiently(device: &wgpu::Device, _: &wgpu::Queue, pass: &Pass, _: Duration) -> Result<Pipeline, Error> {
    scoped(device, pass)
}

/// A device error about a user's file is an error of that file.
fn blame(error: Error, shader: &Shader) -> Error {
    match (error, shader.sources().iter().find(|s| !s.ours)) {
        (Error::Device(message), Some(theirs)) => Error::Shader { message: format!("{}: {message}", theirs.file) },
        (error, _) => error,
    }
}

#[expect(unsafe_code, reason = "the only way to switch off checks that cost time in every iteration of an inner loop")]
fn module(device: &wgpu::Device, shader: &Shader) -> wgpu::ShaderModule {
    let label = shader.sources().last().map(|s| s.file.as_ref());
    let descriptor = wgpu::ShaderModuleDescriptor { label, source: source(shader) };
    if !shader.trusted() {
        return device.create_shader_module(descriptor);
    }
    // SAFETY: every loop of this crate's shaders is bounded by a uniform or a constant, tests reach each of them, and
    // bounds checks stay on. A user's shader is never compiled here.
    unsafe {
        let mut checks = wgpu::ShaderRuntimeChecks::checked();
        checks.force_loop_bounding = false;
        device.create_shader_module_trusted(descriptor, checks)
    }
}

/// The module that is parsed already; a browser takes text.
#[cfg(not(target_arch = "wasm32"))]
fn source(shader: &Shader) -> wgpu::ShaderSource<'_> {
    wgpu::ShaderSource::Naga(std::borrow::Cow::Owned(shader.module().clone()))
}

#[cfg(target_arch = "wasm32")]
fn source(shader: &Shader) -> wgpu::ShaderSource<'_> {
    wgpu::ShaderSource::Wgsl(shader.text().into())
}

pub fn make(device: &wgpu::Device, pass: &Pass) -> Pipeline {
    let (shader, reflection) = (&pass.shader, pass.shader.reflection());
    let mut groups: BTreeMap<u32, Vec<&Binding>> = BTreeMap::new();
    for binding in &reflection.bindings {
        groups.entry(binding.group).or_default().push(binding);
    }
    let groups: BTreeMap<u32, _> =
        groups.into_iter().map(|(group, bindings)| (group, layout(device, &bindings))).collect();
    let last = groups.keys().last().copied().unwrap_or(0);
    let layouts: Vec<_> = (0..=last).map(|group| groups.get(&group)).collect();
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: None,
        bind_group_layouts: &layouts,
        immediate_size: 0,
    });
    let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some(&reflection.entry),
        layout: Some(&layout),
        module: &module(device, shader),
        entry_point: Some(&reflection.entry),
        compilation_options: wgpu::PipelineCompilationOptions {
            constants: &pass.constants,
            // Every tile is written before it is read.
            zero_initialize_workgroup_memory: !shader.trusted(),
        },
        cache: None,
    });
    Pipeline { pipeline, groups }
}

fn layout(device: &wgpu::Device, bindings: &[&Binding]) -> wgpu::BindGroupLayout {
    let entry = |binding: &&Binding| wgpu::BindGroupLayoutEntry {
        binding: binding.binding,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty: wgpu::BindingType::Buffer {
            ty: match binding.access {
                Access::Uniform => wgpu::BufferBindingType::Uniform,
                Access::Read => wgpu::BufferBindingType::Storage { read_only: true },
                Access::Write => wgpu::BufferBindingType::Storage { read_only: false },
            },
            has_dynamic_offset: false,
            min_binding_size: std::num::NonZeroU64::new(binding.stride),
        },
        count: None,
    };
    let entries: Vec<_> = bindings.iter().map(entry).collect();
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: None, entries: &entries })
}
