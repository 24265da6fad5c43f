//! Laws of one's own: what they may do, what is refused, and that no wrong sum goes unsaid.

mod refusals;
#[path = "../support/mod.rs"]
mod support;
mod turns;
mod visits;
