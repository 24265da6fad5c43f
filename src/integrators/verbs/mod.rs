//! The verbs in which integrators are written, one file for each shader; the three of a Runge–Kutta step share a file, and those of an
//! implicit solve and those of declared columns have a folder each.

pub mod adaptive;
pub mod at;
pub mod block;
pub mod clear;
pub mod compensated;
pub mod drift;
pub mod held;
pub mod keep;
pub mod kick;
pub mod kick_drift;
pub mod life;
pub mod pairs;
pub mod radau;
pub mod runge_kutta;
pub mod solve;
pub mod tick;
pub mod watch;
