//! Stability limits: the largest dt of an integrator, measured from its own steps, and the frequencies of a network of
//! springs, bounded from above and from below; and those of a fluid on its lattice.

mod acting;
mod bound;
mod flow;
mod mode;
mod oscillator;
mod others;
mod verdict;

use acting::acting;
pub use bound::{Bound, Row};
pub use flow::{Asks, Flow};
pub use mode::{Mode, Network};
pub use oscillator::{Oscillator, largest_step, oscillator, spectral_radius};
pub use verdict::{Build, Verdict};
