//! A compiled plan: pipelines, bind groups, and dispatches in the order in which they are encoded.

use super::buffers::{Buffers, missing};
use super::fault;
use super::pipeline::{Pipeline, Pipelines};
use super::repeat::{Gate, Node};
use super::submit::Queue;
use crate::error::Error;
use crate::kernel::{Access, Flag, Pass, Plan};

/// A plan compiled for a device.
pub struct Program {
    ready: Vec<Ready>,
    arguments: Vec<wgpu::Buffer>,
    pub(super) dispatches: Vec<Dispatch>,
    /// The kernel of each that is ready, by its place in the plan; none for what is a loop's own.
    owners: Vec<Option<usize>>,
    /// Where iterations of loops begin that may not be needed, in the order of dispatches.
    pub(super) cuts: Vec<Cut>,
}

/// The place where a later iteration of a loop begins: if the flag of the loop is set, it and all others dispatch nothing.
pub(super) struct Cut {
    /// Its first dispatch.
    pub at: usize,
    /// The first dispatch after the iterations.
    pub end: usize,
    /// The buffer of the flag.
    #[cfg_attr(target_arch = "wasm32", expect(dead_code, reason = "a browser is not waited for"))]
    pub flag: wgpu::Buffer,
    /// The byte of the flag.
    #[cfg_attr(target_arch = "wasm32", expect(dead_code, reason = "a browser is not waited for"))]
    pub byte: u64,
}

/// A compiled pass.
struct Ready {
    pipeline: wgpu::ComputePipeline,
    groups: Vec<(u32, wgpu::BindGroup)>,
    workgroups: Workgroups,
    /// Whether indirect workgroups are zero once its kernel is complete.
    rests: bool,
    work: u64,
}

/// One dispatch of a compiled pass, by its index.
#[derive(Clone, Copy)]
pub(super) struct Dispatch {
    ready: usize,
    workgroups: Workgroups,
    pub work: u64,
    /// Whether it is of a loop.
    pub loops: bool,
}

/// The workgroups of a dispatch.
#[derive(Clone, Copy)]
pub(super) enum Workgroups {
    Known([u32; 3]),
    /// Three words of a buffer of arguments, from this byte on.
    Indirect {
        arguments: usize,
        offset: u64,
    },
}

impl Program {
    pub(super) fn new(
        queue: &mut Queue,
        pipelines: &mut Pipelines,
        buffers: &Buffers,
        plan: &Plan,
    ) -> Result<Self, Error> {
        let program = Self {
            ready: Vec::new(),
            arguments: Vec::new(),
            dispatches: Vec::new(),
            owners: Vec::new(),
            cuts: Vec::new(),
        };
        let mut builder = Builder { queue, pipelines, buffers, program, kernels: Vec::new(), depth: 0 };
        for kernel in &plan.kernels {
            let ready: Result<Vec<_>, _> = kernel.passes.iter().map(|pass| builder.ready(pass, &[])).collect();
            builder.kernels.push(ready?);
        }
        for op in &plan.ops {
            let node = builder.node(op)?;
            builder.encode(&node, None)?;
        }
        let owner = |place: usize| builder.kernels.iter().position(|ready| ready.contains(&place));
        builder.program.owners = (0..builder.program.ready.len()).map(owner).collect();
        Ok(builder.program)
    }
    /// The kernel of a dispatch, by its place in the plan; none for what is a loop's own.
    pub(super) fn owner(&self, dispatch: &Dispatch) -> Option<usize> {
        self.owners.get(dispatch.ready).copied().flatten()
    }
    /// Encodes all of it, a number of times.
    pub(super) fn encode(&self, times: u32, pass: &mut wgpu::ComputePass) {
        (0..times).for_each(|_| self.encode_some(&self.dispatches, pass));
    }
    /// Encodes some of its dispatches.
    pub(super) fn encode_some<'a>(
        &self,
        dispatches: impl IntoIterator<Item = &'a Dispatch>,
        pass: &mut wgpu::ComputePass,
    ) {
        for dispatch in dispatches {
            let ready = &self.ready[dispatch.ready];
            pass.set_pipeline(&ready.pipeline);
            for (index, group) in &ready.groups {
                pass.set_bind_group(*index, group, &[]);
            }
            match dispatch.workgroups {
                Workgroups::Known([x, y, z]) => pass.dispatch_workgroups(x, y, z),
                Workgroups::Indirect { arguments, offset } => {
                    pass.dispatch_workgroups_indirect(&self.arguments[arguments], offset);
                }
            }
        }
    }
}

/// A program under construction.
pub(super) struct Builder<'a> {
    pub queue: &'a mut Queue,
    pipelines: &'a mut Pipelines,
    buffers: &'a Buffers,
    program: Program,
    /// The indices of the compiled passes of each kernel.
    kernels: Vec<Vec<usize>>,
    /// The number of loops around what is encoded.
    pub depth: u32,
}

/// A buffer in place of a field of that name.
pub(super) type Own<'a> = (&'a str, &'a wgpu::Buffer);

impl Builder<'_> {
    /// Compiles a pass, and returns its index. Some of its fields may be bound to other buffers.
    pub fn ready(&mut self, pass: &Pass, own: &[Own<'_>]) -> Result<usize, Error> {
        let pipeline = self.pipelines.get(pass, self.queue.patience())?;
        let device = self.queue.device().clone();
        let workgroups = match &pass.indirect {
            None => Workgroups::Known(pass.workgroups(device.limits().max_compute_workgroups_per_dimension)?),
            Some(indirect) => {
                let buffer = self.buffers.get(&indirect.field).ok_or_else(|| missing(&indirect.field))?.clone();
                Workgroups::Indirect { arguments: self.arguments(buffer), offset: 4 * u64::from(indirect.word) }
            }
        };
        let groups = fault::scoped(&device, || self.groups(pass, &pipeline, own))??;
        self.program.ready.push(Ready {
            pipeline: pipeline.pipeline,
            groups,
            workgroups,
            rests: pass.indirect.as_ref().is_some_and(|its| its.rests),
            work: pass.work,
        });
        Ok(self.program.ready.len() - 1)
    }
    /// The buffer of a loop's flag.
    pub fn flag(&self, flag: &Flag) -> Result<wgpu::Buffer, Error> {
        self.buffers.get(&flag.field).cloned().ok_or_else(|| missing(&flag.field))
    }
    /// The number of dispatches so far.
    pub fn dispatched(&self) -> usize {
        self.program.dispatches.len()
    }
    /// Adds the places where iterations begin, of a loop that ends here.
    pub fn cut(&mut self, places: Vec<usize>, flag: &wgpu::Buffer, byte: u64) {
        let end = self.dispatched();
        let cuts = places.into_iter().map(|at| Cut { at, end, flag: flag.clone(), byte });
        self.program.cuts.extend(cuts);
        self.program.cuts.sort_by_key(|cut| (cut.at, std::cmp::Reverse(cut.end)));
    }
    /// Adds a buffer of arguments, and returns its index.
    pub fn arguments(&mut self, buffer: wgpu::Buffer) -> usize {
        self.program.arguments.push(buffer);
        self.program.arguments.len() - 1
    }
    /// The compiled passes of a kernel.
    pub fn passes(&self, kernel: usize) -> &[usize] {
        self.kernels.get(kernel).map_or(&[], Vec::as_slice)
    }
    /// The workgroups of a compiled pass, unless it is dispatched indirectly already.
    pub fn workgroups(&self, ready: usize) -> Option<[u32; 3]> {
        match self.program.ready[ready].workgroups {
            Workgroups::Known(workgroups) => Some(workgroups),
            Workgroups::Indirect { .. } => None,
        }
    }
    /// Adds a dispatch of a compiled pass, controlled by a gate if there is one.
    pub fn dispatch(&mut self, place: usize, gate: Option<&Gate<'_>>) -> Result<(), Error> {
        let (ready, known) = (&self.program.ready[place], self.workgroups(place));
        let workgroups = match (gate, known) {
            (None, _) => ready.workgroups,
            (Some(gate), Some(known)) => gate.workgroups(known)?,
            (Some(_), None) if ready.rests => ready.workgroups,
            (Some(_), None) => {
                return Err(Error::Device("a kernel with indirect arguments of its own runs in a loop".to_owned()));
            }
        };
        let work = ready.work;
        let loops = self.depth > 0;
        self.program.dispatches.push(Dispatch { ready: place, workgroups, work, loops });
        Ok(())
    }
    /// Adds the dispatches of an operation, controlled by a gate if there is one.
    pub fn encode(&mut self, node: &Node, gate: Option<&Gate<'_>>) -> Result<(), Error> {
        match node {
            Node::Run(passes) => passes.iter().try_for_each(|place| self.dispatch(*place, gate)),
            Node::Repeat(repeat) => repeat.encode(self, gate),
        }
    }

    fn groups(
        &mut self,
        pass: &Pass,
        pipeline: &Pipeline,
        own: &[Own<'_>],
    ) -> Result<Vec<(u32, wgpu::BindGroup)>, Error> {
        let mut groups = Vec::new();
        for (index, layout) in &pipeline.groups {
            let mut bound = Vec::new();
            for (field, binding) in pass.bindings().filter(|(_, b)| b.group == *index) {
                let block = pass.uniforms.iter().find(|(name, _)| *name == binding.name);
                let own = own.iter().find(|(name, _)| *name == field);
                let buffer = match (block, own) {
                    (Some((name, bytes)), _) => self.queue.uniform(name, bytes)?,
                    (None, Some((_, buffer))) => (*buffer).clone(),
                    (None, None) => self.buffers.get(field).ok_or_else(|| missing(field))?.clone(),
                };
                if binding.access == Access::Uniform && !buffer.usage().contains(wgpu::BufferUsages::UNIFORM) {
                    return Err(missing(field));
                }
                bound.push((binding.binding, buffer));
            }
            let entries: Vec<_> = bound
                .iter()
                .map(|(binding, buffer)| wgpu::BindGroupEntry {
                    binding: *binding,
                    resource: buffer.as_entire_binding(),
                })
                .collect();
            let descriptor = wgpu::BindGroupDescriptor { label: None, layout, entries: &entries };
            groups.push((*index, self.queue.device().create_bind_group(&descriptor)));
        }
        Ok(groups)
    }
}
