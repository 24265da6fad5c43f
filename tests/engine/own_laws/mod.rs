//! Laws of one's own: what they may do, what is refused, and that no wrong sum goes unsaid.
#![allow(clippy::float_cmp, reason = "sums of whole numbers are exact")]

mod refusals;
mod tables;
mod turns;
mod visits;
