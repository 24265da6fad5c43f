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
    grid: Grid,
    pub work: u64,
}

/// How many workgroups there are.
#[derive(Clone)]
enum Grid {
    Known([u32; 3]),
    /// By three words of a field, from this byte on.
    Told(wgpu::Buffer, u64),
}

impl Dispatch {
    pub fn encode(&self, pass: &mut wgpu::ComputePass) {
        pass.set_pipeline(&self.pipeline);
        for (index, group) in &self.groups {
            pass.set_bind_group(*index, group, &[]);
        }
        match &self.grid {
            Grid::Known([x, y, z]) => pass.dispatch_workgroups(*x, *y, *z),
            Grid::Told(buffer, from) => pass.dispatch_workgroups_indirect(buffer, *from),
        }
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
    let grid = match &pass.told {
        None => Grid::Known(pass.workgroups(device.limits().max_compute_workgroups_per_dimension)?),
        Some((field, word)) => {
            Grid::Told(buffers.get(field).ok_or_else(|| missing(field))?.clone(), 4 * u64::from(*word))
        }
    };
    let groups = fault::scoped(&device, || groups(queue, buffers, pass, &pipeline))??;
    Ok(Dispatch { pipeline: pipeline.pipeline, groups, grid, work: pass.work })
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
