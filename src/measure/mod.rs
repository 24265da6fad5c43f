//! What is measured of a state, in f64.

mod energy;
mod flock;

pub use energy::Measure;
pub use flock::Flock;
