//! Trees: what the device builds, against its twins and against direct sums.

#[path = "../support/mod.rs"]
mod support;

mod build;
mod curve;
mod sets;
