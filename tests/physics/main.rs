//! Forces, integrators and constraints against closed forms, published numbers and their references.

#[path = "../support/mod.rs"]
mod support;

mod adaptive;
mod at_scale;
mod births;
mod bits;
mod blocks;
mod bodies;
mod boundary;
mod collisions;
mod crowds;
mod dfsph;
mod ewald;
mod flock;
mod fluids;
mod implicit;
mod matter;
mod molecular;
mod orders;
mod oscillator;
mod pairs;
mod pins;
mod precision;
mod questions;
mod radau;
mod rods;
mod runaway;
mod solids;
mod springs;
mod stability;
mod steering;
mod two_words;
mod vicsek;
mod walls;
