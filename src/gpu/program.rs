//! A plan made ready: pipelines, bind groups and grids.

use super::buffers::{Buffers, missing};
use super::fault;
use super::pipeline::{Pipeline, Pipelines};
use super::submit::Queue;
use crate::error::Error;
use crate::kernel::{Access, Pass, Plan};

/// A plan made ready for a device.
pub struct Program {
    pub(super) dispatches: Vec<Dispatch>,
}

/// One dispatch, ready to be encoded.
#[derive(Clone)]
pub(super) struct Dispatch {
    pipeline: wgpu::ComputePipeline,
    groups: Vec<(u32, wgpu::BindGroup)>,
    grid: [u32; 3],
    pub work: u64,
}

impl Dispatch {
    pub fn encode(&self, pass: &mut wgpu::ComputePass) {
        pass.set_pipeline(&self.pipeline);
        for (index, group) in &self.groups {
            pass.set_bind_group(*index, group, &[]);
        }
        pass.dispatch_workgroups(self.grid[0], self.grid[1], self.grid[2]);
    }
}

impl Program {
    pub(super) fn new(
        queue: &mut Queue,
        pipelines: &mut Pipelines,
        buffers: &Buffers,
        plan: &Plan,
    ) -> Result<Self, Error> {
        let mut kernels = Vec::new();
        for kernel in &plan.kernels {
            let ready: Result<Vec<_>, _> =
                kernel.passes.iter().map(|p| dispatch(queue, pipelines, buffers, p)).collect();
            kernels.push(ready?);
        }
        let dispatches = plan.order.iter().filter_map(|i| kernels.get(*i)).flatten().cloned().collect();
        Ok(Self { dispatches })
    }
}

fn dispatch(queue: &mut Queue, pipelines: &mut Pipelines, buffers: &Buffers, pass: &Pass) -> Result<Dispatch, Error> {
    let pipeline = pipelines.get(pass)?;
    let device = queue.device().clone();
    let grid = grid(&device, pass)?;
    let groups = fault::scoped(&device, || groups(queue, buffers, pass, &pipeline))??;
    Ok(Dispatch { pipeline: pipeline.pipeline, groups, grid, work: pass.work })
}

/// Workgroups, folded over two dimensions where one is too short.
fn grid(device: &wgpu::Device, pass: &Pass) -> Result<[u32; 3], Error> {
    let limit = device.limits().max_compute_workgroups_per_dimension;
    let workgroups = pass.threads.count.div_ceil(pass.shader.reflection().workgroup).max(1);
    let rows = workgroups.div_ceil(limit);
    if rows > limit || pass.threads.layers > limit {
        let text = format!(
            "{} invocations need {workgroups} workgroups; this device dispatches {limit} × {limit}",
            pass.threads.count
        );
        return Err(Error::Limit(text));
    }
    Ok([workgroups.div_ceil(rows), rows, pass.threads.layers.max(1)])
}

fn groups(
    queue: &mut Queue,
    buffers: &Buffers,
    pass: &Pass,
    pipeline: &Pipeline,
) -> Result<Vec<(u32, wgpu::BindGroup)>, Error> {
    let mut groups = Vec::new();
    for (index, layout) in &pipeline.groups {
        let mut bound = Vec::new();
        for (field, binding) in pass.bindings().filter(|(_, b)| b.group == *index) {
            let own = pass.uniforms.iter().find(|(name, _)| *name == binding.name);
            let buffer = match own {
                Some((name, bytes)) => queue.uniform(name, bytes)?,
                None => buffers.get(field).ok_or_else(|| missing(field))?.clone(),
            };
            if binding.access == Access::Uniform && !buffer.usage().contains(wgpu::BufferUsages::UNIFORM) {
                return Err(missing(field));
            }
            bound.push((binding.binding, buffer));
        }
        let entries: Vec<_> = bound
            .iter()
            .map(|(binding, buffer)| wgpu::BindGroupEntry { binding: *binding, resource: buffer.as_entire_binding() })
            .collect();
        let group =
            queue.device().create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout, entries: &entries });
        groups.push((*index, group));
    }
    Ok(groups)
}
