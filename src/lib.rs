//! Particles moved by forces, on any GPU, checked against a second opinion in f64.

pub mod boundary;
pub mod component;
pub mod cpu;
pub mod error;
pub mod fluids;
pub mod forces;
pub mod gpu;
pub mod integrators;
#[cfg(feature = "scene")]
pub mod io;
pub mod kernel;
pub mod life;
pub mod links;
pub mod lockstep;
pub mod measure;
pub mod motion;
pub mod neighbors;
pub mod particles;
pub mod primitives;
pub mod render;
pub mod rotation;
#[cfg(feature = "scene")]
pub mod scene;
pub mod selftest;
pub mod settings;
pub mod simulation;
pub mod solids;
pub mod stability;
pub mod state;
pub mod tree;
pub mod visit;

pub use cpu::Cpu;
pub use error::Error;
pub use gpu::Gpu;
pub use kernel::{ACCELERATION, Bounds, LIFE, POSITION, SPECIES, Side, Solver, TARGET, VELOCITY};
pub use measure::Measure;
pub use simulation::{Setup, Simulation};
pub use state::State;
/// The version of wgpu whose devices this crate takes.
pub use wgpu;
