//! The backend that runs plans on a device through wgpu. Outside of this folder only `simulation.rs` names wgpu, for the
//! caller's device.

mod adapter;
mod buffers;
#[cfg(feature = "panel")]
mod canvas;
mod done;
mod driver;
mod fault;
#[cfg(not(target_arch = "wasm32"))]
mod patience;
mod pipeline;
mod program;
mod read;
mod repeat;
mod saved;
mod submit;
mod timing;
#[cfg(feature = "panel")]
mod window;

use std::time::Duration;

pub use adapter::{Choice, Found, adapters, best, choose, instance, open, wanted_features, wanted_limits};
#[doc(hidden)]
pub use adapter::{NO_DRIVER, flags};
use buffers::Buffers;
#[cfg(feature = "panel")]
#[doc(hidden)]
pub use canvas::{Canvas, Controls, ROW, Sheet};
#[doc(hidden)]
pub use fault::Faults;
use pipeline::Pipelines;
#[doc(hidden)]
pub use program::Program;
use read::Incoming;
use saved::Saved;
use submit::Queue;
#[cfg(feature = "panel")]
#[doc(hidden)]
pub use window::Window;

use crate::error::Error;
use crate::kernel::{Array, Arrival, Backend, Flag, Machine, Packed, Plan, Shader, World};

/// A device that is borrowed from its owner, with the fields and pipelines made on it.
pub struct Gpu {
    device: wgpu::Device,
    queue: Queue,
    buffers: Buffers,
    pipelines: Pipelines,
    machine: Machine,
    count: u32,
    packed: Packed,
    world: World,
    saved: Saved,
}

impl Gpu {
    /// Borrows a device for `count` particles. The handles are cheap clones; the owner continues using its own.
    ///
    /// # Errors
    /// [`Error::Scene`] when there are no particles.
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue, count: u32) -> Result<Self, Error> {
        if count == 0 {
            return Err(Error::Scene("there are no particles: a simulation needs one or more".to_owned()));
        }
        // The layout of `World` is read out of the WGSL, like every other.
        let world = Shader::join(&[crate::shader!("world.wgsl"), crate::shader!("integrators/tick.wgsl")])?;
        let packed = world.reflection().binding("world").map(|b| b.packed.clone()).unwrap_or_default();
        let mut buffers = Buffers::new(device.clone(), count);
        buffers.require("world", packed.size as u64)?;
        Ok(Self {
            queue: Queue::new(device.clone(), queue.clone()),
            buffers,
            pipelines: Pipelines::new(device.clone(), queue.clone()),
            machine: adapter::machine(device),
            device: device.clone(),
            count,
            packed,
            world: World::default(),
            saved: Saved::default(),
        })
    }
    /// Sets the properties of another machine, so that a test can run variants that this one would not choose.
    pub fn pretend(&mut self, machine: Machine) {
        self.machine = machine;
    }
    /// Divides submissions so that each takes about this long, and times out after waiting for `patience`.
    pub fn limit_submissions(&mut self, submission: Duration, patience: Duration) {
        self.queue.limit_submissions(submission, patience);
    }
    /// Retains the existing pipelines, even if others are dropped later.
    pub fn keep_pipelines(&mut self) {
        self.pipelines.keep();
    }
    /// Drops pipelines that no program uses and that were made since [`Gpu::keep_pipelines`]: thousands of different plans would use much
    /// memory.
    pub fn forget_pipelines(&mut self) {
        self.pipelines.forget();
    }
    /// The number of pipelines: shaders with their constants, each compiled once.
    #[must_use]
    pub fn pipelines(&self) -> usize {
        self.pipelines.len()
    }
    /// The number of submissions so far.
    #[must_use]
    pub fn submissions(&self) -> u64 {
        self.queue.submissions()
    }
    /// Adds `elements` elements of 16 bytes to every field created from now on; a test fills them and checks that no kernel has written
    /// there.
    pub fn pad(&mut self, elements: u64) {
        self.buffers.pad(elements);
    }
    /// A field's buffer, if it exists. It may be used as a vertex buffer, and copied from.
    #[must_use]
    pub fn buffer(&self, name: &str) -> Option<&wgpu::Buffer> {
        self.buffers.get(name)
    }
    /// Encodes a program into a caller's encoder, in one compute pass, and submits nothing.
    pub fn encode(&self, program: &Program, times: u32, encoder: &mut wgpu::CommandEncoder) {
        let mut pass =
            encoder.begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some("motes"), timestamp_writes: None });
        program.encode(times, &mut pass);
    }
    /// The name of the adapter and its driver.
    #[must_use]
    pub fn describe(&self) -> String {
        adapter::describe(&self.device.adapter_info())
    }
    /// A known defect of its driver that costs time and memory, if there is one.
    #[must_use]
    pub fn warning(&self) -> Option<String> {
        driver::warning(&self.device.adapter_info())
    }
    /// Waits until the device has completed all submitted work.
    ///
    /// # Errors
    /// When it is lost or does not answer in time.
    pub fn wait(&mut self) -> Result<(), Error> {
        self.queue.wait()
    }
    /// Runs a program in one submission, and returns the seconds by the device's own clock, if that is available.
    ///
    /// # Errors
    /// When the device is lost or does not answer in time.
    pub async fn timed(&mut self, program: &Program, times: u32) -> Result<Option<f64>, Error> {
        timing::timed(&self.device, &mut self.queue, program, times).await
    }
    /// Runs a program once, and gives the kernel of each dispatch, by its place in the plan, and its seconds by the device's own
    /// clock, if it has one for us. What is a loop's own has no kernel.
    ///
    /// # Errors
    /// When the device is lost or does not answer in time.
    pub async fn timed_dispatches(&mut self, program: &Program) -> Result<Option<Vec<(Option<usize>, f64)>>, Error> {
        let seconds = timing::each(&self.device, &mut self.queue, program).await?;
        let owners = program.dispatches.iter().map(|dispatch| program.owner(dispatch));
        Ok(seconds.map(|seconds| owners.zip(seconds).collect()))
    }
    /// Reads the parameters of every kernel: the clock from the device, and the rest as it was set.
    ///
    /// # Errors
    /// When the device is lost or does not answer in time.
    pub async fn world(&mut self) -> Result<World, Error> {
        let bytes = self.bytes("world", 0, self.packed.size as u64).await?;
        Ok(self.world.updated(&self.packed, &bytes))
    }
    /// Reads the periods of the box and one over them, which all kernels know beside its corners.
    ///
    /// # Errors
    /// When the device is lost, or does not answer in time.
    pub(crate) async fn periods(&mut self) -> Result<[glam::Vec3; 2], Error> {
        let bytes = self.bytes("world", 0, self.packed.size as u64).await?;
        Ok(["period", "frequency"].map(|name| self.packed.vector(&bytes, name)))
    }
    /// Reads the bytes of a field.
    ///
    /// # Errors
    /// When there is no such field, the device is lost, or it does not answer in time.
    pub async fn bytes(&mut self, name: &str, from: u64, len: u64) -> Result<Vec<u8>, Error> {
        let buffer = self.buffers.get(name).ok_or_else(|| buffers::missing(name))?;
        read::bytes(&self.device, &mut self.queue, buffer, from, len).await
    }
    /// Whether a flag is set.
    ///
    /// # Errors
    /// When there is no such field, the device is lost, or it does not answer in time.
    pub async fn is_set(&mut self, flag: &Flag) -> Result<bool, Error> {
        let bytes = self.bytes(&flag.field, 4 * u64::from(flag.word), 4).await?;
        Ok(bytes.iter().any(|byte| *byte != 0))
    }
    /// The length of a field, in bytes, with padding.
    #[must_use]
    pub fn size(&self, name: &str) -> u64 {
        self.buffers.get(name).map_or(0, wgpu::Buffer::size)
    }
    /// Writes bytes into a field, from an offset on.
    ///
    /// # Errors
    /// When there is no such field, or it is shorter.
    pub fn write_bytes(&mut self, name: &str, from: u64, bytes: &[u8]) -> Result<(), Error> {
        let buffer = self.buffers.get(name).ok_or_else(|| buffers::missing(name))?;
        if from.checked_add(bytes.len() as u64).is_none_or(|end| end > buffer.size()) {
            let text = format!("the field `{name}` holds {} bytes, not {}", buffer.size(), bytes.len());
            return Err(Error::Device(text));
        }
        self.queue.write(buffer, from, bytes)
    }
}

impl Backend for Gpu {
    type Program = Program;

    fn machine(&self) -> Machine {
        self.machine
    }
    fn compile(&mut self, plan: &Plan) -> Result<Program, Error> {
        for indirect in plan.kernels.iter().flat_map(|k| &k.passes).filter_map(|pass| pass.indirect.as_ref()) {
            if !indirect.field.contains(' ') {
                let text = format!(
                    "the indirect arguments `{}` could be written by any shader: their name needs a space",
                    indirect.field
                );
                return Err(Error::Device(text));
            }
            self.buffers.dispatches(&indirect.field);
        }
        for (name, bytes) in plan.fields(self.count) {
            if name != "world"
                && self.buffers.require(&name, bytes)?
                && let Some(words) = plan.table(&name)
            {
                self.write_bytes(&name, 0, bytemuck::cast_slice(words))?;
            }
        }
        Program::new(&mut self.queue, &mut self.pipelines, &self.buffers, plan)
    }
    fn compile_often(&mut self, plan: &Plan) -> Result<Program, Error> {
        // A browser takes text, which a fused shader has none of.
        if cfg!(target_arch = "wasm32") { self.compile(plan) } else { self.compile(&plan.fused()) }
    }
    fn run(&mut self, program: &Program, times: u32) -> Result<(), Error> {
        self.queue.run(program, times)
    }
    fn set_world(&mut self, world: World) -> Result<(), Error> {
        self.world = world;
        let bytes = self.packed.pack("World", &world.members())?;
        self.write_bytes("world", 0, &bytes)
    }
    fn alike(&self, rows: u32) -> Result<Self, Error> {
        let mut gpu = Self::new(&self.device, &self.queue.wgpu(), rows)?;
        gpu.machine = self.machine;
        gpu.buffers.pad(self.buffers.padding());
        gpu.queue.like(&self.queue);
        Ok(gpu)
    }
    fn resize(&mut self, rows: u32) {
        self.count = rows;
        self.buffers.resize(rows);
    }
    fn set_rows(&mut self, count: u32, free: u32) -> Result<(), Error> {
        self.world = World { count, free, ..self.world };
        for (name, value) in [("count", count), ("capacity", self.world.capacity())] {
            let member = self.packed.members.iter().find(|member| member.name == name);
            let offset = member.map_or(0, |member| member.offset) as u64;
            self.write_bytes("world", offset, &value.to_le_bytes())?;
        }
        Ok(())
    }
    fn save(&mut self, fields: &[String]) -> Result<(), Error> {
        let all: Vec<String> = fields.iter().cloned().chain(["world".to_owned()]).collect();
        self.saved.save(&self.device, &mut self.queue, &self.buffers, &all)
    }
    fn restore(&mut self) -> Result<(), Error> {
        self.saved.restore(&self.device, &mut self.queue, &self.buffers)
    }
    fn write_at(&mut self, name: &str, first: usize, array: &Array) -> Result<(), Error> {
        let each = array.zeros(1).to_bytes().len() as u64;
        self.write_bytes(name, each * first as u64, &array.to_bytes())
    }
    fn forget(&mut self, name: &str) {
        self.buffers.forget(name);
    }
    async fn read(&mut self, name: &str, like: &Array, len: usize) -> Result<Array, Error> {
        let bytes = like.zeros(1).to_bytes().len() as u64 * len as u64;
        Ok(like.like(&self.bytes(name, 0, bytes).await?))
    }
    fn request(&mut self, name: &str, like: &Array, len: usize) -> Result<Box<dyn Arrival>, Error> {
        let bytes = like.zeros(1).to_bytes().len() as u64 * len as u64;
        let buffer = self.buffers.get(name).ok_or_else(|| buffers::missing(name))?;
        let request = read::request(&self.device, &mut self.queue, buffer, 0, bytes)?;
        Ok(Box::new(Incoming::new(request, like.zeros(0))))
    }
}
