//! Particles moved by forces, on any GPU, checked against a second opinion in f64.

pub mod error;
#[cfg(feature = "scene")]
pub mod io;
pub mod particles;
pub mod settings;
