//! The command `motes` as a process: exit codes, folders, streams, checkpoints, films.

#[path = "../support/golden.rs"]
mod golden;
#[path = "../support/mod.rs"]
mod support;

mod baselines;
mod bench;
mod checkpoints;
mod cli;
mod components;
mod convert;
mod cpu_backend;
mod crowds;
mod far;
mod film;
mod json;
mod messages;
mod own_contact;
mod own_metal;
mod plans;
mod process;
mod purity;
mod stiff;
mod sweep;
mod tied;
mod validate;
