//! What old and bare drivers ask of kernels.

mod bare;
mod blocks;
mod kernels;
mod tint;
