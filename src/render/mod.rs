//! Pictures, drawn by kernels like any other: on a device, or by their references with no driver at all.
//!
//! Few or large particles are shaded balls with trails; many small ones are lights that add up on a canvas of whole
//! numbers, so that a picture has the same bytes on every run. Cloth is a surface, springs are lines, and solids stand
//! among them, in the light of one lamp.

mod absent;
mod blank;
mod camera;
mod cover;
mod draw;
mod drops;
mod fields;
mod film;
mod fluid;
mod foam;
mod frame;
mod halo;
mod heading;
mod hide;
mod keys;
mod light;
mod look;
mod meter;
mod paint;
mod palette;
mod picture;
#[cfg(feature = "scene")]
mod png;
mod project;
mod raster;
mod scenery;
mod settle;
mod shade;
mod sky;
mod solid;
mod splat;
mod streak;
mod stroke;
pub mod styles;
mod tank;
mod tear;
mod tone;
mod trail;
mod vertex;
mod water;

pub use absent::absent;
pub use camera::{Camera, framed};
pub use draw::{Image, draw};
pub use film::{Film, shoot};
pub use frame::Frame;
pub use keys::KEYS;
pub use meter::Exposure;
pub use palette::{Color, group_color, pack};
pub use picture::Picture;
pub use scenery::Scenery;
pub use solid::{Shape, Solid};
pub use trail::Trail;
pub use water::Water;
