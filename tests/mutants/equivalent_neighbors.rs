//! Mutants of the grid and its searches that no test can notice, because they do the same; each with its reason.

use crate::support::equivalents::{Equivalent, same};

pub const EQUIVALENT: &[Equivalent] = &[
    same("visit/nearest", "override COUNT: u32 = 7u;", "7u", "8u", "the host sets every override"),
];
