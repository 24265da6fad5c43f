//! What old and bare drivers ask of kernels.

mod blocks;
mod kernels;
#[path = "../support/mod.rs"]
mod support;
