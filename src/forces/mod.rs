//! Forces of a scene: the interactions, the constraints and the updaters, and users' laws.

mod custom;

pub use custom::{Custom, scalar};

pub use crate::component::{
    Change, Component, Entry, Pressed, Projection, Properties, Resolved, Role, Stage, Tail, evaluate, numbered,
};
pub use crate::constraints::*;
pub use crate::interactions::*;
pub use crate::kernel::Problem;
pub use crate::updaters::*;
pub use crate::visit::{Distant, Jacobian, Law, Over, Particle};

/// All of them.
pub fn entries() -> impl Iterator<Item = &'static Entry> {
    [INTERACTIONS, CONSTRAINTS, UPDATERS].into_iter().flatten()
}

/// The one of a scene's word.
#[must_use]
pub fn entry(name: &str) -> Option<&'static Entry> {
    entries().find(|entry| entry.name == name)
}
