//! Fluids: smoothed particle hydrodynamics. What is smoothed and how, and the searches that a step of it takes; which of them,
//! and in which order, is for the forces to say.

mod density;
mod dfsph;
mod medium;
mod pressure;
mod smoothing;
mod state;
mod walls;

pub use density::density;
pub use dfsph::{Asked, DFSPH_ERRORS, DFSPH_REPORT, DFSPH_WORDS, Dfsph};
pub use medium::Medium;
pub use pressure::{Friction, pressure};
pub use smoothing::Smoothing;
pub use state::state;
pub use walls::walls;

use crate::kernel::Field;

/// How dense the fluid is around a particle \[mass / length³, or mass / length² in two dimensions\]; of walls it says nothing.
pub const DENSITY: Field<f32> = Field::new("density");
/// The pressure, where it is solved for \[mass / (length time²), or mass / time² in two dimensions\]; of walls it is 0.
pub const PRESSURE: Field<f32> = Field::new("pressure");
/// What a neighbour is asked for, in the order of the grid: density, which is 0 for walls; pressure over its square; internal
/// energy per unit mass.
pub(crate) const FLOW: &str = "flow";
