//! Fluids: smoothed particle hydrodynamics. This module provides the quantities, kernels and searches of a step; forces select and order
//! them.

mod continuity;
mod density;
mod dfsph;
mod fits;
mod gap;
mod limits;
mod medium;
mod nearby;
mod overdense;
mod pressure;
mod rates;
mod smoothing;
mod start;
mod state;
mod tension;
mod wall_pressure;
mod walls;
mod xsph;

pub use continuity::{Continuity, columns as continuity_columns, rate, summed};
pub use density::density;
pub use dfsph::{Asked, DFSPH_ERRORS, DFSPH_REPORT, DFSPH_WORDS, Dfsph, columns as dfsph_columns};
pub use gap::gap;
pub use limits::{COURANT, Limits, limits, viscous_steps};
pub use medium::{Boxed, Medium, Smoothed};
pub use pressure::{Form, Friction, Walls, pressure};
pub use rates::Rates;
pub use smoothing::Smoothing;
pub use start::{Continuum, Start, Still};
pub use state::state;
pub use tension::{Tension, tension};
pub use wall_pressure::{wall_pressure, wall_state};
pub use walls::{WallMass, walls};
pub use xsph::xsph;

use crate::kernel::Field;

/// The density of the fluid at a particle \[mass / length³, or mass / length² in two dimensions\]; undefined for walls.
pub const DENSITY: Field<f32> = Field::new("density");
/// Its rate, where it is a state: [`rate`].
pub(crate) const DENSITY_RATE: Field<f32> = Field::new("density_rate");
/// The pressure, where it is solved for \[mass / (length time²), or mass / time² in two dimensions\]; of walls it is 0.
pub const PRESSURE: Field<f32> = Field::new("pressure");
/// The data of a neighbour, at its place in the search: density, which is 0 for walls; pressure over its square; internal energy per
/// unit mass.
pub(crate) const FLOW: &str = "flow";
/// The surface normal, at its place in the search.
pub(crate) const NORMAL: &str = "normal";
