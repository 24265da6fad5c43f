//! Particles moved by forces, on any GPU, verified against an f64 reference.
//!
//! ```no_run
//! use motes::typed::{Gravity, default, plummer};
//! use motes::{POSITION, Setup, Simulation, gpu};
//!
//! # pollster::block_on(async {
//! let forces = vec![Gravity { softening: 0.05, ..default() }.into()];
//! let setup = Setup::new(plummer(1000).build()?, forces, 0.01);
//! let found = gpu::best().await?; // or a device of your own
//! let mut simulation = Simulation::new(&found.device, &found.queue, &setup)?;
//! simulation.step(100)?;
//! let positions = simulation.read(POSITION).await?;
//! # assert_eq!(positions.len(), 1000);
//! # Ok::<(), motes::Error>(())
//! # }).unwrap();
//! ```
//!
//! | task | interface |
//! |---|---|
//! | step within your own encoder, draw without a copy | [`Simulation::encode`], [`Simulation::buffer`] |
//! | change settings, obstacles, motions, a law's parameters and tables between frames | [`Simulation::set`], [`Simulation::set_motion`] |
//! | read back without a stall | [`Simulation::request`], [`Readback`] |
//! | add and remove particles | [`Simulation::spawn`], [`Simulation::remove`] |
//! | save, restore, continue bit for bit | [`Simulation::snapshot`], [`Simulation::setup`], [`State`] |
//! | give settings as fields | [`typed`] |
//! | write a law of your own | [`Custom`] |
//! | find faults of a setup before a run | [`diagnose`](diagnose::diagnose) |
//! | open a device yourself | [`gpu::wanted_features`], [`gpu::wanted_limits`] |
//!
//! Each of these is a program of some forty lines under `examples/`, which a test runs; [`examples`] shows them.
//!
//! [`Simulation`], [`Readback`], [`State`], [`Setup`] and [`Run`](run::Run) are `Send + Sync + 'static` (but in a browser, where devices
//! stay in their thread): a simulation may be a resource of a game's schedule, and can be stepped from any thread.
//!
//! This page shows the public interface. Other modules are public for the command and for tests; they are not documented here, and
//! not stable.

#[doc(hidden)]
pub mod boundary;
#[doc(hidden)]
pub mod component;
#[doc(hidden)]
pub mod constraints;
#[doc(hidden)]
pub mod cosmology;
#[doc(hidden)]
pub mod cpu;
#[doc(hidden)]
pub mod crowds;
pub mod diagnose;
#[doc(hidden)]
pub mod error;
#[cfg(feature = "scene")]
#[doc(hidden)]
pub mod evacuation;
mod ewald;
#[cfg(doc)]
pub mod examples;
#[doc(hidden)]
pub mod floor_plan;
#[doc(hidden)]
pub mod forces;
#[cfg(feature = "scene")]
#[doc(hidden)]
pub mod formats;
pub mod gpu;
#[doc(hidden)]
pub mod grains;
pub mod integrators;
#[doc(hidden)]
pub mod interactions;
#[doc(hidden)]
pub mod kernel;
pub mod life;
pub mod links;
#[doc(hidden)]
pub mod lockstep;
#[doc(hidden)]
pub mod measure;
pub mod motion;
#[doc(hidden)]
pub mod neighbors;
#[doc(hidden)]
pub mod primitives;
#[cfg(feature = "render")]
#[doc(hidden)]
pub mod render;
#[doc(hidden)]
pub mod rotation;
#[cfg(feature = "scene")]
pub mod run;
#[cfg(feature = "scene")]
pub mod scene;
#[doc(hidden)]
pub mod selftest;
#[doc(hidden)]
pub mod settings;
#[doc(hidden)]
pub mod shapes;
#[doc(hidden)]
pub mod simulation;
#[doc(hidden)]
pub mod solids;
#[doc(hidden)]
pub mod sph;
#[doc(hidden)]
pub mod stability;
#[doc(hidden)]
pub mod state;
#[doc(hidden)]
pub mod tree;
pub mod typed;
#[doc(hidden)]
pub mod updaters;
#[cfg(feature = "panel")]
#[doc(hidden)]
pub mod view;
#[doc(hidden)]
pub mod visit;

pub use cpu::Cpu;
pub use error::Error;
pub use forces::{Change, Component, Custom, Over};
pub use gpu::Gpu;
pub use kernel::{
    ACCELERATION, Array, Bounds, Column, Element, Field, Kind, LIFE, POSITION, SPECIES, Side, Solver, TARGET, VELOCITY,
};
pub use measure::Energy;
pub use settings::Value;
pub use simulation::{Readback, Setup, Simulation};
pub use state::State;
/// The version of wgpu whose devices this crate accepts.
pub use wgpu;

/// The book's page for programs: its snippets compile.
#[cfg(doctest)]
#[doc = include_str!("../docs/pages/tutorials/embed.md")]
mod embed {}
