//! Particles moved by forces, on any GPU, checked against a second opinion in f64.

pub mod error;
pub mod particles;
pub mod settings;
