//! Particles moved by forces, on any GPU, checked against a second opinion in f64.

pub mod error;
pub mod forces;
pub mod integrators;
#[cfg(feature = "scene")]
pub mod io;
pub mod particles;
#[cfg(feature = "scene")]
pub mod render;
#[cfg(feature = "scene")]
pub mod scene;
pub mod settings;
