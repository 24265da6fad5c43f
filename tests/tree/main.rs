//! Trees: what the device builds, against its twins and against direct sums.

#![allow(clippy::cast_possible_truncation, reason = "numbers are rounded to what f32 holds")]

#[path = "../support/mod.rs"]
mod support;

mod build;
mod curve;
mod sets;
