//! Stages of the kernels that end loops.

use std::cell::RefCell;
use std::rc::Rc;

use motes::kernel::repeat::{ARGUMENTS, EVEN, ITERATIONS, ODD, WORKGROUPS, proceed, reset};
use motes::kernel::{Backend, Flag, Kernel};

use crate::stages::{Device, FEW, Stage, moving};
use crate::support::equivalents::{Equivalent, same};
use crate::support::machines::alone;

const ALL: &str = "all invocations would write the same";

pub const EQUIVALENT: &[Equivalent] = &[
    same("repeat/reset.wgsl", "if k == 0u {", "==", "!=", ALL),
    same("repeat/reset.wgsl", "if k == 0u {", "0u", "1u", ALL),
];

/// Words of the arguments of an iteration, and slots of them.
const WORDS: u32 = 6;
const SLOTS: u32 = 4;

/// Iterations of either parity, with the flag and without; and more arguments than a row of workgroups has lanes.
pub fn all(device: &Device, stages: &mut Vec<Stage>) {
    let simulation = Rc::new(RefCell::new(moving(device, FEW, None)));
    let mut stage = |name: &str, kernel: Kernel, fields: &[(&str, Vec<u32>)]| {
        simulation.borrow_mut().backend().compile(&alone(kernel.clone())).expect("a kernel");
        for (field, words) in fields {
            let bytes = bytemuck::cast_slice(words);
            simulation.borrow_mut().backend().write_bytes(field, 0, bytes).expect("a field");
        }
        stages.push(Stage::amid(name, &simulation, alone(kernel)));
    };
    let some = |first: u32, words: u32| (first..first + words).collect::<Vec<u32>>();
    let flag = Flag { field: "flags".into(), word: 2, member: "code" };
    for (iterations, set) in [(0, 0), (1, 0), (2, 0), (5, 0), (7, 0), (4, 1)] {
        let kernel = proceed(&flag, WORDS, SLOTS).expect("a kernel");
        let fields = [
            ("flags", vec![3, 7, set]),
            (WORKGROUPS, some(11, WORDS)),
            (ARGUMENTS, some(100, WORDS * SLOTS)),
            (ITERATIONS, vec![iterations]),
        ];
        stage(&format!("proceed, {iterations}, {set}"), kernel, &fields);
    }
    let words = 500;
    let fields = [(ODD, some(1, words)), (EVEN, some(1000, words)), (ITERATIONS, vec![9])];
    stage("reset", reset(words).expect("a kernel"), &fields);
}
