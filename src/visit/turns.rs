//! Laws with loops: the files joined with them, and the iterations that their visits leave to them.

use super::Law;
use crate::kernel::{ALARM, ALARM_WORDS, LAW, Machine, Name, Source};

/// The number of iterations that the loops of a visit and of its law may take in one invocation on a software adapter.
const TURNS: u32 = 60_000;
/// The expected iterations of a law's loops for one pair: more are detected as the law runs.
const EXPECTED: u32 = 100;
/// The number of targets of an invocation of a walk without subgroups.
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
    /// The alarm file of this check, for a visit without one.
    pub(super) fn alarm_file(&self) -> Option<Source> {
        self.has_loops().then(|| crate::shader!("own/alarm.wgsl"))
    }
    /// The constant by which an alarm names the law; `None` where it has no loops.
    pub(super) fn mark(&self) -> Option<(&'static str, f64)> {
        // FNV-1a; the largest number means no alarm.
        let hash = |hash: u32, byte: u8| (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193);
        let words = self.name.bytes().chain([0]).chain(self.wgsl.file.bytes());
        self.has_loops().then(|| (LAW, f64::from(words.fold(0x811c_9dc5, hash).min(u32::MAX - 1))))
    }
    /// The alarm's size, where its loops raise one.
    pub(super) fn alarm(&self) -> Vec<(Name, u64)> {
        if self.has_loops() { vec![(ALARM.name.into(), ALARM_WORDS as u64)] } else { Vec::new() }
    }
    /// The machine as seen by a visit whose walk may stop and continue: a loop in the law leaves a walk fewer iterations, and one particle
    /// is evaluated at a time, by [`TARGETS`].
    pub(super) fn leaves(&self, machine: &Machine) -> Machine {
        if self.has_loops() && machine.software {
            Machine { subgroup: 0, turns: machine.turns / (TARGETS * EXPECTED), ..*machine }
        } else {
            *machine
        }
    }
    /// The maximum number of sources that one invocation of `pairs` evaluates in one dispatch, each for `targets` targets.
    pub(super) fn sources(&self, most: u32, targets: u32, software: bool) -> u32 {
        match (self.has_loops(), software) {
            (false, _) => most,
            (true, true) => TURNS / (targets * EXPECTED + 1),
            // An invocation counts its iterations, and ends at 2²⁴: that is 4096 for each pair.
            (true, false) => 1024,
        }
    }
}
