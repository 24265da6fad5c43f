//! Measurements of a state, in f64.

mod energy;
mod flock;
mod fluid;

pub use energy::Measure;
pub use flock::Flock;
pub use fluid::Ledger;
