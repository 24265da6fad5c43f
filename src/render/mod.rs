//! Pictures, drawn by kernels on a device; without a driver a plain renderer draws the same in f64, up to invisible differences.
//!
//! Few or large particles are shaded balls with trails; many small ones are lights that are added on an integer canvas, so that a picture
//! has the same bytes on every run. Cloth is drawn as a surface, springs as lines, and solids among them, in the light of one lamp.

mod camera;
mod draw;
mod exposure;
mod fields;
#[cfg(feature = "images")]
mod file;
mod film;
mod fluid;
mod frame;
mod heading;
mod keys;
mod light;
#[cfg(feature = "panel")]
mod live;
#[cfg(feature = "images")]
mod notes;
mod palette;
mod passes;
mod picture;
mod plain;
mod scenery;
mod solid;
pub mod styles;
mod tank;
mod trail;

pub use camera::{Camera, framed};
pub use draw::{Image, draw};
pub use exposure::Exposure;
#[cfg(feature = "panel")]
pub use fields::PIXELS;
#[cfg(feature = "panel")]
pub(crate) use fields::PROJECTED;
pub use film::{Ends, Film, shoot};
pub use fluid::{Plane, Water};
pub use frame::Frame;
pub use keys::KEYS;
#[cfg(feature = "panel")]
pub use live::Live;
pub use palette::{Color, Scaled, bytes, group_color, pack, value_color};
pub use passes::absent;
#[cfg(feature = "panel")]
pub(crate) use picture::AREA;
pub use picture::Picture;
pub use scenery::Scenery;
pub use solid::{Shape, Solid};
pub use trail::Trail;
