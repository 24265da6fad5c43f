//! What is read: scenes, files of particles, shapes; and what is wrong with them.

mod formats;
mod misnamed;
mod scenes;
mod shapes;
mod typed;
