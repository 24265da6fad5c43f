//! Evacuations: how long the pedestrians of a floor plan need to leave, how much of that they lose to others, and where.
//!
//! The delay of a pedestrian with the desired speed v₀ between two times is Δt − (T₁ − T₂) / v₀, with T the distance to the nearest exit round walls: the
//! time integral of 1 − v·e / v₀ along −e = ∇T. It telescopes, so that the sum over a map of delays is that over pedestrians of the time to
//! leave less the time that each would need alone, whatever the interval between samples is.

mod bottleneck;
mod map;
mod passage;
#[cfg(feature = "images")]
pub mod pictures;
mod record;
mod report;
mod start;
mod text;
mod ways;

pub use bottleneck::{Bottleneck, HELD_UP};
pub use map::Map;
pub use passage::Passage;
pub use record::Record;
pub use report::{Left, Pedestrian, Report, SHARE};
pub use start::{Crowd, Model, Start, scene};
pub use text::text;
pub use ways::Ways;
