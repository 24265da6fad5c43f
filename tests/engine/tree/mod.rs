//! Trees: what the device builds and how it walks, against references and against direct sums.

#![allow(clippy::cast_possible_truncation, reason = "numbers are rounded to what f32 holds")]

mod accuracy;
mod bounded;
mod build;
mod choice;
mod complete;
mod curve;
mod lockstep;
#[path = "../../../benches/baselines/met.rs"]
mod met;
mod sets;
mod softenings;
mod turns;
mod walks;
