//! What is read: scenes, files of particles, shapes; and what is wrong with them.

#[path = "../support/golden.rs"]
mod golden;

mod formats;
mod messages;
mod misnamed;
mod plans;
mod scenes;
mod shapes;
mod typed;
