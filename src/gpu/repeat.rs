//! Loops: every iteration is encoded, and those that are not needed dispatch nothing; see [`crate::kernel::repeat`].

use super::fault;
use super::program::{Builder, Workgroups};
use crate::error::Error;
use crate::kernel::repeat::{ARGUMENTS, EVEN, ITERATIONS, ODD, WORKGROUPS, proceed, reset};
use crate::kernel::{Flag, Kernel, Op};

/// Bytes of the arguments of one dispatch.
const EACH: u64 = 12;

/// A compiled operation.
pub(super) enum Node {
    /// The compiled passes of a kernel.
    Run(Vec<usize>),
    /// A loop.
    Repeat(Repeat),
}

/// A compiled loop.
pub(super) struct Repeat {
    most: u32,
    body: Vec<Node>,
    /// The buffer and the byte of the flag that ends it.
    flag: (wgpu::Buffer, u64),
    /// The distinct workgroup counts of its dispatches.
    workgroups: Vec<[u32; 3]>,
    /// The arguments of odd iterations, and of even ones.
    arguments: [usize; 2],
    /// The kernels that start an odd iteration, and an even one.
    proceed: [usize; 2],
    reset: usize,
}

/// The arguments of an iteration.
pub(super) struct Gate<'a> {
    arguments: usize,
    offset: u64,
    workgroups: &'a [[u32; 3]],
}

impl Gate<'_> {
    /// The indirect arguments of a dispatch with these workgroups, if the iteration runs.
    pub fn workgroups(&self, known: [u32; 3]) -> Result<Workgroups, Error> {
        let place = self.workgroups.iter().position(|workgroups| *workgroups == known);
        let place = place.ok_or_else(|| Error::Device(format!("a loop has no arguments for {known:?} workgroups")))?;
        Ok(Workgroups::Indirect { arguments: self.arguments, offset: self.offset + EACH * place as u64 })
    }
}

impl Repeat {
    /// Adds all iterations: the first is dispatched like the loop itself, each of the others depends on the one before it.
    pub fn encode(&self, builder: &mut Builder<'_>, outer: Option<&Gate<'_>>) -> Result<(), Error> {
        builder.depth += 1;
        let mut places = Vec::new();
        for iteration in 0..self.most {
            if iteration > 0 {
                places.push(builder.dispatched());
            }
            let parity = usize::from(iteration % 2 == 0);
            let offset = EACH * self.workgroups.len() as u64 * u64::from(iteration.saturating_sub(1) / 2);
            let own = Gate { arguments: self.arguments[parity], offset, workgroups: &self.workgroups };
            let gate = if iteration == 0 { outer } else { Some(&own) };
            self.body.iter().try_for_each(|node| builder.encode(node, gate))?;
            if iteration + 1 < self.most {
                builder.dispatch(self.proceed[1 - parity], gate)?;
            }
        }
        builder.depth -= 1;
        builder.cut(places, &self.flag.0, self.flag.1);
        if self.most > 1 { builder.dispatch(self.reset, outer) } else { Ok(()) }
    }
}

impl Builder<'_> {
    /// Compiles an operation.
    pub fn node(&mut self, op: &Op) -> Result<Node, Error> {
        match op {
            Op::Run(kernel) => Ok(Node::Run(self.passes(*kernel).to_vec())),
            Op::Repeat { most, until, body } => {
                let body: Result<Vec<_>, _> = body.iter().map(|op| self.node(op)).collect();
                self.repeat(*most, until, body?).map(Node::Repeat)
            }
        }
    }
    fn repeat(&mut self, most: u32, until: &Flag, body: Vec<Node>) -> Result<Repeat, Error> {
        // The kernel that starts the next iteration has one workgroup.
        let mut workgroups = vec![[1; 3]];
        self.collect(&body, &mut workgroups);
        let [words, slots] = [3 * u32::try_from(workgroups.len()).unwrap_or(u32::MAX), (most / 2).max(1)];
        let all = words.checked_mul(slots).ok_or_else(|| Error::Limit(format!("a loop of {most} is too long")))?;
        let storage = wgpu::BufferUsages::STORAGE;
        let [odd, even] = [0, 1].map(|_| self.buffer("arguments", all, storage | wgpu::BufferUsages::INDIRECT));
        let (odd, even, iterations) = (odd?, even?, self.buffer("iterations", 1, storage)?);
        let counts = self.buffer("workgroups", words, storage | wgpu::BufferUsages::COPY_DST)?;
        self.queue.write(&counts, 0, bytemuck::cast_slice(&workgroups))?;
        let pass = |kernel: Kernel| kernel.passes.into_iter().next();
        let mut control = |kernel: Kernel, arguments: &wgpu::Buffer| {
            let own =
                [(WORKGROUPS, &counts), (ARGUMENTS, arguments), (ITERATIONS, &iterations), (ODD, &odd), (EVEN, &even)];
            let pass = pass(kernel).ok_or_else(|| Error::Device("a loop has no kernel of its own".to_owned()))?;
            self.ready(&pass, &own)
        };
        let proceed = [control(proceed(until, words, slots)?, &odd)?, control(proceed(until, words, slots)?, &even)?];
        let reset = control(reset(all)?, &odd)?;
        let arguments = [self.arguments(odd), self.arguments(even)];
        let flag = (self.flag(until)?, 4 * u64::from(until.word));
        Ok(Repeat { most, body, flag, workgroups, arguments, proceed, reset })
    }
    /// The distinct workgroup counts of all dispatches.
    fn collect(&self, body: &[Node], all: &mut Vec<[u32; 3]>) {
        let add = |place: usize, all: &mut Vec<[u32; 3]>| {
            if let Some(workgroups) = self.workgroups(place).filter(|its| !all.contains(its)) {
                all.push(workgroups);
            }
        };
        for node in body {
            match node {
                Node::Run(passes) => passes.iter().for_each(|place| add(*place, all)),
                Node::Repeat(inner) => {
                    add(inner.reset, all);
                    self.collect(&inner.body, all);
                }
            }
        }
    }
    fn buffer(&self, label: &str, words: u32, usage: wgpu::BufferUsages) -> Result<wgpu::Buffer, Error> {
        let size = 4 * u64::from(words);
        let descriptor = wgpu::BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false };
        let device = self.queue.device();
        fault::scoped(device, || device.create_buffer(&descriptor))
    }
}
