//! What steps stand on: columns, laws, searches, primitives, backends, states.

#[path = "../support/mod.rs"]
mod support;

mod budget;
mod columns;
mod drivers;
mod errors;
mod fused;
mod laws;
mod library;
mod measures;
mod neighbors;
mod own_laws;
mod packing;
mod primitives;
mod references;
mod repeat;
mod state;
mod stress;
mod structure;
mod tree;
