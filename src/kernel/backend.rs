//! The interface of backends: hold fields by name, and run plans.

use std::task::Waker;

use super::{Array, Host, Plan, World};
use crate::error::Error;

/// What a plan may want to know of the machine it will run on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Machine {
    /// The device is a software adapter (lavapipe, SwiftShader, WARP): barriers cost, lanes are few.
    pub software: bool,
    /// The size of every subgroup, when kernels may use subgroups and the size is fixed; else 0.
    pub subgroup: u32,
    /// Invocations that keep the device busy.
    pub invocations: u32,
    /// Bytes of a field that one binding holds, at most; 0 where nothing is bound.
    pub bindable: u64,
    /// Workgroups that it dispatches in one dimension, at most.
    pub workgroups: u32,
    /// Iterations that the loops of an invocation may take, all together: some software drivers end them after 65 535.
    pub turns: u32,
}

impl Machine {
    /// The host, which runs the references.
    pub const HOST: Self =
        Self { software: true, subgroup: 0, invocations: 1, bindable: 0, workgroups: 65_535, turns: Self::TURNS };
    /// A number of iterations below which no known driver ends a loop, with a margin for one that is not counted.
    pub const TURNS: u32 = 60_000;
}

/// What may go to other threads: everything that does, but in a browser, where devices stay in theirs.
#[cfg(not(target_arch = "wasm32"))]
pub trait Mobile: Send + Sync {}
#[cfg(not(target_arch = "wasm32"))]
impl<T: Send + Sync> Mobile for T {}
/// What may go to other threads: everything that does, but in a browser, where devices stay in theirs.
#[cfg(target_arch = "wasm32")]
pub trait Mobile {}
#[cfg(target_arch = "wasm32")]
impl<T> Mobile for T {}

/// An array that is on its way to the host.
pub trait Arrival: Mobile {
    /// The array, once it is there, or why it will not come. Waits for nothing.
    fn look(&mut self) -> Option<Result<Array, Error>>;
    /// Wakes a task once there is something to look at.
    fn wake(&mut self, waker: &Waker);
}

/// Runs plans. The two backends are the GPU and the references.
pub trait Backend {
    /// A plan made ready.
    type Program;
    /// Properties of the device.
    fn machine(&self) -> Machine;
    /// The fields themselves, where they are on the host: a picture of them is drawn without kernels.
    fn host(&self) -> Option<&Host> {
        None
    }
    /// Makes a plan ready: checks limits, makes the fields that it names and that do not exist yet.
    ///
    /// # Errors
    /// [`Error::Limit`] when a field does not fit, [`Error::Shader`] when a shader does not compile,
    /// [`Error::Scene`] when the plan has a kernel that this backend cannot run.
    fn compile(&mut self, plan: &Plan) -> Result<Self::Program, Error>;
    /// Runs a program a number of times, in order. May return before the device is done.
    ///
    /// # Errors
    /// When the device is lost, out of memory or does not answer in time.
    fn run(&mut self, program: &Self::Program, times: u32) -> Result<(), Error>;
    /// Sets what every kernel knows.
    ///
    /// # Errors
    /// When the device is lost.
    fn set_world(&mut self, world: World) -> Result<(), Error>;
    /// Another one of the same kind on the same device, for so many rows of particles, without any field.
    ///
    /// # Errors
    /// When there are none.
    fn alike(&self, rows: u32) -> Result<Self, Error>
    where
        Self: Sized;
    /// Makes fields from now on for so many rows of particles.
    fn resize(&mut self, rows: u32);
    /// Sets how many rows are in use, and how many are free behind them.
    ///
    /// # Errors
    /// When the device is lost.
    fn set_rows(&mut self, count: u32, free: u32) -> Result<(), Error>;
    /// Copies these fields and the clock as they are behind all that was run, in place of the copies that there are.
    ///
    /// # Errors
    /// When there is no such field, or the device is lost or out of memory.
    fn save(&mut self, fields: &[String]) -> Result<(), Error>;
    /// Puts the copies back, behind all that was run.
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
    /// Asks for a field as it is behind all that was run, and waits for nothing: `len` elements of the kind of `like`.
    ///
    /// # Errors
    /// When there is no such field, or the device is lost.
    fn request(&mut self, name: &str, like: &Array, len: usize) -> Result<Box<dyn Arrival>, Error>;
}
