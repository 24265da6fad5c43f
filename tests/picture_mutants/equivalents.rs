//! Mutants that no test of pictures can notice, because they do the same; each with its reason.

use crate::support::equivalents::{Equivalent, same};

const ANY_SIZE: &str = "the host reads the size of a workgroup by reflection, and any will do";
const ALWAYS_SET: &str = "the host sets every override";

pub const EQUIVALENT: &[Equivalent] = &[
    same("", "const WORKGROUP: u32 = 64u;", "64u", "65u", ANY_SIZE),
    same("disc.wgsl", "override ROWS: i32 = 64;", "64", "65", ALWAYS_SET),
];
