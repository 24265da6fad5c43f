//! Only what a state holds continues: whatever else is in the memory of a kernel when a run begins or continues, its bits are the same.

use std::cell::Cell;
use std::collections::BTreeSet;

use motes::formats::Precision;
use motes::kernel::{Access, Backend, Kernel, Role};
use motes::{Error, Gpu, Setup, Simulation};
use pollster::block_on;

use super::restarts::{compare, every_scene, mixed};
use crate::support;

/// What begins with zeros: alarms, the clock, that no list of neighbours is there, the pressure from which a solver starts, and the
/// pressure of walls, which no kernel writes and states hold; and torques, which a state restores and which are zero where no grain touches
/// another; and the low words of numbers that are exact in one.
const ZEROS: &[&str] = &[
    "alarm",
    "world",
    "list_state",
    "warm_start",
    "stiffness",
    "torque",
    "kept_torque",
    "position_low",
    "velocity_low",
];

/// Words that fill memory, in turns: those of NaN, and 1.5.
const WORDS: [u32; 2] = [0x7fc1_2345, 0x3fc0_0000];

/// Fills all fields that kernels write, and into which nothing was put; gives how many.
fn poisoned(simulation: &mut Simulation<Gpu>, setup: &Setup, word: u32) -> Result<usize, Error> {
    let plans = setup.plans(simulation.backend().machine())?;
    let written = |kernel: &Kernel| -> Vec<String> {
        kernel.bindings().filter(|(_, of)| of.access == Access::Write).map(|(name, _)| name.to_owned()).collect()
    };
    let names: BTreeSet<String> = plans.all().flat_map(|plan| plan.steps().flat_map(written)).collect();
    // What components and integrators remember begins with its initial value.
    let columns = setup.columns()?;
    let remembered = |name: &str| columns.get(name).is_some_and(|column| column.role == Role::State);
    let state = |name: &str| remembered(name) || setup.state.columns().any(|(column, _)| column.name == name);
    let mut filled = 0;
    for name in names.iter().filter(|name| !state(name) && !ZEROS.contains(&name.as_str())) {
        let gpu = simulation.backend();
        let size = gpu.size(name);
        if size == 0 || block_on(gpu.bytes(name, 0, size))?.iter().any(|byte| *byte != 0) {
            continue;
        }
        let words: Vec<u8> = (0..size / 4).flat_map(|_| word.to_le_bytes()).collect();
        gpu.write_bytes(name, 0, &words)?;
        filled += 1;
    }
    Ok(filled)
}

#[test]
fn what_no_state_holds_does_not_matter() {
    let shared = support::device();
    let (turn, filled) = (Cell::new(0_usize), Cell::new(0_usize));
    let on = |setup: &Setup| {
        let mut simulation = Simulation::new(&shared.found.device, &shared.found.queue, setup)?;
        // A run in one go has NaN, which no sum forgets, and the second part of one in two another word.
        let word = WORDS[turn.get() % WORDS.len()];
        turn.set(turn.get() + 1);
        filled.set(filled.get() + poisoned(&mut simulation, setup, word)?);
        Ok(simulation)
    };
    every_scene(&on, Precision::Single);
    // What no scene has: every integrator.
    let mut failures = Vec::new();
    for entry in motes::integrators::INTEGRATORS {
        let ended = compare(&|| mixed(entry.name), &on, Precision::Single);
        failures.extend(ended.err().map(|why| format!("{}: {why}", entry.name)));
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    assert!(filled.get() > 100, "{} fields", filled.get());
}
