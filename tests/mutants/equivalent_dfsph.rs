//! Mutants of a fluid whose pressure is solved for that no test can notice, because they do the same; each with its reason.

use crate::support::equivalents::{Equivalent, same};

const ALWAYS_SET: &str = "the host sets every override";
const ALL_KNOW: &str = "all lanes hold the same value, so any of them may write it";
const HELD: &str = "behind the fluid stand fixed particles, which visit no neighbours";
const EDGE: &str = "no particle lies exactly at the edge";

pub const EQUIVALENT: &[Equivalent] = &[
    same("sph/dfsph/", "override SOLVE: u32 = 0u;", "0u", "1u", ALWAYS_SET),
    same("sph/dfsph/", "override WARM: f32 = 0.0;", "0.0", "1.0", ALWAYS_SET),
    same("sph/dfsph/", "override RELAXATION: f32 = 0.0;", "0.0", "1.0", ALWAYS_SET),
    same("dfsph/begin.wgsl", "override FEWEST: f32 = 0.0;", "0.0", "1.0", ALWAYS_SET),
    same("sph/dfsph/", "override STRIDE: u32 = 1u;", "1u", "2u", ALWAYS_SET),
    same("sph/dfsph/", "override ROOM: u32 = 1u;", "1u", "2u", ALWAYS_SET),
    same("sph/dfsph/", "override CELLS: u32 = 1u;", "1u", "2u", ALWAYS_SET),
    same("dfsph/paired.wgsl", "if k < STRIDE {", "<", "<=", HELD),
    same("dfsph/decide.wgsl", "override TOLERANCE: f32 = 0.0;", "0.0", "1.0", ALWAYS_SET),
    same("dfsph/decide.wgsl", "override LEAST: f32 = 0.0;", "0.0", "1.0", ALWAYS_SET),
    same("dfsph/decide.wgsl", "override MOST: f32 = 0.0;", "0.0", "1.0", ALWAYS_SET),
    same("dfsph/decide.wgsl", "if lane == 0u {", "0u", "1u", ALL_KNOW),
    same("dfsph/decide.wgsl", "} else if state.error <= TOLERANCE", "<=", "<", EDGE),
    same("dfsph/tally.wgsl", "if lane == 0u && first < end {", "==", "!=", ALL_KNOW),
    same("dfsph/tally.wgsl", "if lane == 0u && first < end {", "0u", "1u", ALL_KNOW),
    same("dfsph/response.wgsl", "let resists = inverse > LEAST", ">", ">=", EDGE),
    same("dfsph/finish.wgsl", "if k >= world.count {", ">=", ">", "behind the last slot stands no valid id"),
];
