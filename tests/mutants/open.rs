//! Mutants that no stage notices yet. Numbers may only fall: a stage that shows what such a line does takes them away.

use crate::support::equivalents::Open;

const fn open(file: &'static str, most: usize) -> Open {
    Open { file, most }
}

pub const OPEN: &[Open] = &[
    // Walks that continue: what they keep is read again only where they stop late, and workgroups too many do nothing.
    open("shaders/visit/tree_rest.wgsl", 14),
    open("shaders/visit/tree_subgroup.wgsl", 10),
    open("shaders/visit/tree_broadcast.wgsl", 1),
    open("shaders/visit/tree_look.wgsl", 1),
    open("shaders/tree/demand.wgsl", 2),
    // No stage has a tree with free rows behind the particles; `tests/physics/births/spawn.rs` has.
    open("shaders/visit/tree_nodes.wgsl", 1),
    open("shaders/sph/dfsph/listed.wgsl", 1),
    // Higher terms of exp(x) − 1, which show in no change as small as those of the stages; periods and frequencies, which no lockstep compares;
    // workgroups too many, which do nothing. `tests/physics/molecular/barostats.rs` has runs.
    open("shaders/barostat/advance.wgsl", 24),
    open("shaders/barostat/due.wgsl", 1),
    // No stage has a particle that the box moves to its far side, or forces that hardly add up.
    open("shaders/barostat/measure.wgsl", 4),
    open("shaders/barostat/scale.wgsl", 3),
    // The first of three normal numbers is the same in the plane.
    open("shaders/updaters/cell_rescaling.wgsl", 1),
];
