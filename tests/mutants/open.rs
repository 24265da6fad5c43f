//! Mutants that no stage notices yet. Numbers may only fall: a stage that shows what such a line does takes them away.

use crate::support::equivalents::{Equivalent, Open, same};

const fn open(file: &'static str, most: usize) -> Open {
    Open { file, most }
}

/// Mutants with loops that have no end: a driver ends them after a minute or more, in which the other device waits too. Each is noticed, and is tried only
/// where files are chosen.
pub const ENDLESS: &[Equivalent] =
    &[same("visit/tree_look", "fn begun()", "/", "*", "a search that has not begun never ends")];

pub const OPEN: &[Open] = &[
    // Walks that continue: what they keep is read again only where they stop late, and workgroups too many do nothing.
    // The last coefficient of an arc tangent changes an energy by 1e-4, which is a hundredth of that of the contact beside it.
    open("shaders/grains/bridge.wgsl", 1),
    open("shaders/visit/tree_rest.wgsl", 14),
    open("shaders/visit/tree_subgroup.wgsl", 7),
    open("shaders/visit/tree_broadcast.wgsl", 1),
    // One more since `bounded.rs` ends loops: `>` or `0u` there. Which of them loops without an end is not known yet.
    open("shaders/visit/tree_look.wgsl", 2),
    open("shaders/tree/demand.wgsl", 2),
    // No stage has a tree with free rows behind the particles; `tests/physics/births/spawn.rs` has.
    open("shaders/visit/tree_nodes.wgsl", 1),
    open("shaders/sph/dfsph/listed.wgsl", 1),
    // One floor and one crowd: no pedestrian stands exactly on an edge, and most cells around one are open. Cells without a way hold 1e9, beside which
    // errors of distances are nothing to the comparison with the reference; `tests/physics/crowds/plans.rs` compares distances.
    open("shaders/crowds/begin.wgsl", 2),
    open("shaders/crowds/exits.wgsl", 1),
    open("shaders/crowds/inside.wgsl", 1),
    open("shaders/crowds/ways.wgsl", 6),
    open("shaders/interactions/navigate.wgsl", 26),
    // `distance > 0.0`: the two that begin at one place may have parted in the step before the stage, which was not looked into.
    open("shaders/interactions/collision_free_speed.wgsl", 1),
    open("shaders/interactions/social_wall.wgsl", 17),
    // No stage has a periodic box about a beam; `tests/physics/boundary/laws.rs` has.
    open("shaders/interactions/tweezers.wgsl", 1),
];
