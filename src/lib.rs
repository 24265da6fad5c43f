//! Particles moved by forces, on any GPU, verified against an f64 reference.

pub mod boundary;
pub mod component;
pub mod constraints;
pub mod cpu;
pub mod diagnose;
pub mod error;
pub mod forces;
#[cfg(feature = "scene")]
pub mod formats;
pub mod gpu;
pub mod integrators;
pub mod interactions;
pub mod kernel;
pub mod life;
pub mod links;
pub mod lockstep;
pub mod measure;
pub mod motion;
pub mod neighbors;
pub mod primitives;
#[cfg(feature = "render")]
pub mod render;
pub mod rotation;
#[cfg(feature = "scene")]
pub mod run;
#[cfg(feature = "scene")]
pub mod scene;
pub mod selftest;
pub mod settings;
pub mod shapes;
pub mod simulation;
pub mod solids;
pub mod sph;
pub mod stability;
pub mod state;
pub mod tree;
pub mod typed;
pub mod updaters;
pub mod visit;

pub use cpu::Cpu;
pub use error::Error;
pub use forces::{Change, Component, Custom, Over};
pub use gpu::Gpu;
pub use kernel::{ACCELERATION, Bounds, LIFE, POSITION, SPECIES, Side, Solver, TARGET, VELOCITY};
pub use measure::Measure;
pub use simulation::{Readback, Setup, Simulation};
pub use state::State;
/// The version of wgpu whose devices this crate takes.
pub use wgpu;
