//! Laws with loops of their own: what is joined with them, and what their visits leave them.

use super::Law;
use crate::kernel::{ALARM, ALARM_WORDS, LAW, Machine, Name, Source};

/// Iterations that the loops of a visit and of its law may take in one invocation on a software adapter.
const TURNS: u32 = 60_000;
/// Turns of a law's loops for one pair that are allowed for: more are found out as the law runs.
const EXPECTED: u32 = 100;
/// Targets that an invocation of a walk has, where it has no subgroups.
const TARGETS: u32 = 4;

impl Law {
    /// Whether it is a user's, and has loops.
    pub(super) fn has_loops(&self) -> bool {
        self.wgsl.law && self.wgsl.has_loops()
    }
    /// The check of its loop iterations.
    pub(super) fn turns(&self) -> Source {
        if self.has_loops() { crate::shader!("own/turns.wgsl") } else { crate::shader!("own/no_turns.wgsl") }
    }
    /// The alarm that this raises, for a visit that has none.
    pub(super) fn alarm_file(&self) -> Option<Source> {
        self.has_loops().then(|| crate::shader!("own/alarm.wgsl"))
    }
    /// The constant by which an alarm names it; none where it has no loops.
    pub(super) fn mark(&self) -> Option<(&'static str, f64)> {
        // FNV-1a; the largest number is the alarm's silence.
        let hash = |hash: u32, byte: u8| (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193);
        let words = self.name.bytes().chain([0]).chain(self.wgsl.file.bytes());
        self.has_loops().then(|| (LAW, f64::from(words.fold(0x811c_9dc5, hash).min(u32::MAX - 1))))
    }
    /// The alarm's size, where its loops raise one.
    pub(super) fn alarm(&self) -> Vec<(Name, u64)> {
        if self.has_loops() { vec![(ALARM.name.into(), ALARM_WORDS as u64)] } else { Vec::new() }
    }
    /// The machine as its visit sees it where a walk may stop and go on: a loop in it leaves a walk fewer turns, and one particle
    /// is met at a time, by [`TARGETS`].
    pub(super) fn leaves(&self, machine: &Machine) -> Machine {
        if self.has_loops() && machine.software {
            Machine { subgroup: 0, turns: machine.turns / (TARGETS * EXPECTED), ..*machine }
        } else {
            *machine
        }
    }
    /// Sources that one invocation of `pairs` evaluates in one dispatch, at most, each by so many targets.
    pub(super) fn sources(&self, most: u32, targets: u32, software: bool) -> u32 {
        match (self.has_loops(), software) {
            (false, _) => most,
            (true, true) => TURNS / (targets * EXPECTED + 1),
            // An invocation counts its turns, and ends at 2²⁴: that is 4096 for each pair.
            (true, false) => 1024,
        }
    }
}
