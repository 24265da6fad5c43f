//! The interface of backends: hold fields by name, and run plans.

use std::task::Waker;

use super::{Array, Host, Plan, World};
use crate::error::Error;

/// The properties of a machine that a plan may depend on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Machine {
    /// The device is a software adapter (lavapipe, SwiftShader, WARP): barriers cost, lanes are few.
    pub software: bool,
    /// The size of every subgroup, when kernels may use subgroups and the size is fixed; else 0.
    pub subgroup: u32,
    /// Invocations that keep the device busy.
    pub invocations: u32,
    /// The largest number of pair evaluations of one dispatch: a tenth of a second at most on devices of its kind. Each dispatch ends
    /// with a wait for its last workgroups, so that a fast device has more of them.
    pub meetings: u64,
    /// The largest number of bytes of a field that one binding holds; 0 where nothing is bound.
    pub bindable: u64,
    /// The largest number of workgroups of a dispatch in one dimension.
    pub workgroups: u32,
    /// The number of iterations allowed for all loops of an invocation together: some software drivers end them after 65 535.
    pub turns: u32,
}

impl Machine {
    /// The host, which runs the references.
    pub const HOST: Self = Self {
        software: true,
        subgroup: 0,
        invocations: 1,
        meetings: 1 << 30,
        bindable: 0,
        workgroups: 65_535,
        turns: Self::TURNS,
    };
    /// A number of iterations below which no known driver ends a loop, with a margin for one that is not counted.
    pub const TURNS: u32 = 60_000;
}

/// Types that may move to other threads: all that are `Send + Sync`; in a browser all types, since devices stay in their thread.
#[cfg(not(target_arch = "wasm32"))]
pub trait Mobile: Send + Sync {}
#[cfg(not(target_arch = "wasm32"))]
impl<T: Send + Sync> Mobile for T {}
/// Types that may move to other threads: all that are `Send + Sync`; in a browser all types, since devices stay in their thread.
#[cfg(target_arch = "wasm32")]
pub trait Mobile {}
#[cfg(target_arch = "wasm32")]
impl<T> Mobile for T {}

/// An array that is being read back to the host.
pub trait Arrival: Mobile {
    /// The array, once it has arrived, or the reason of its failure. Returns immediately.
    fn look(&mut self) -> Option<Result<Array, Error>>;
    /// Wakes a task once the array has arrived.
    fn wake(&mut self, waker: &Waker);
}

/// Runs plans. The two backends are the GPU and the references.
pub trait Backend {
    /// A compiled plan.
    type Program;
    /// Properties of the device.
    fn machine(&self) -> Machine;
    /// The fields themselves, where they are on the host: a picture of them is drawn without kernels.
    fn host(&self) -> Option<&Host> {
        None
    }
    /// Compiles a plan: checks limits, and creates the fields that it names and that do not exist yet.
    ///
    /// # Errors
    /// [`Error::Limit`] when a field does not fit, [`Error::Shader`] when a shader does not compile,
    /// [`Error::Scene`] when the plan has a kernel that this backend cannot run.
    fn compile(&mut self, plan: &Plan) -> Result<Self::Program, Error>;
    /// The same for a plan that runs often: a device fuses kernels of it, see [`Plan::fused`].
    ///
    /// # Errors
    /// As [`Backend::compile`].
    fn compile_often(&mut self, plan: &Plan) -> Result<Self::Program, Error> {
        self.compile(plan)
    }
    /// Runs a program a number of times, in order. May return before the device is done.
    ///
    /// # Errors
    /// When the device is lost, out of memory or does not answer in time.
    fn run(&mut self, program: &Self::Program, times: u32) -> Result<(), Error>;
    /// Sets the parameters of every kernel.
    ///
    /// # Errors
    /// When the device is lost.
    fn set_world(&mut self, world: World) -> Result<(), Error>;
    /// Another backend of the same kind on the same device, for `rows` rows of particles, without any field.
    ///
    /// # Errors
    /// When it cannot be created.
    fn alike(&self, rows: u32) -> Result<Self, Error>
    where
        Self: Sized;
    /// From now on creates fields for `rows` rows of particles.
    fn resize(&mut self, rows: u32);
    /// Sets the number of rows in use, and of free rows after them.
    ///
    /// # Errors
    /// When the device is lost.
    fn set_rows(&mut self, count: u32, free: u32) -> Result<(), Error>;
    /// Copies these fields and the clock as they are after all submitted work, and replaces earlier copies.
    ///
    /// # Errors
    /// When there is no such field, or the device is lost or out of memory.
    fn save(&mut self, fields: &[String]) -> Result<(), Error>;
    /// Restores the copies, after all submitted work.
    ///
    /// # Errors
    /// When the device is lost.
    fn restore(&mut self) -> Result<(), Error>;
    /// Fills a field from one of its elements on.
    ///
    /// # Errors
    /// When there is no such field, or it ends before.
    fn write_at(&mut self, name: &str, first: usize, array: &Array) -> Result<(), Error>;
    /// Fills a field from its first element on.
    ///
    /// # Errors
    /// When there is no such field, or it is shorter.
    fn write(&mut self, name: &str, array: &Array) -> Result<(), Error> {
        self.write_at(name, 0, array)
    }
    /// Drops a field; the next plan that names it makes a new one. A program that was compiled before keeps the old one.
    fn forget(&mut self, name: &str);
    /// Reads a field: `len` elements of the kind of `like`.
    ///
    /// # Errors
    /// When there is no such field, the device is lost, or it does not answer in time.
    fn read(&mut self, name: &str, like: &Array, len: usize) -> impl Future<Output = Result<Array, Error>>;
    /// Requests a field as it is after all submitted work, without waiting: `len` elements of the kind of `like`.
    ///
    /// # Errors
    /// When there is no such field, or the device is lost.
    fn request(&mut self, name: &str, like: &Array, len: usize) -> Result<Box<dyn Arrival>, Error>;
}
