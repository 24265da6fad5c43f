//! Uniform blocks as lavapipe of Mesa 22.2 to 23.0 needs them; see `src/kernel/unused_word.rs`.

use std::collections::BTreeSet;

use motes::kernel::{Access, Kernel, Pass};

use crate::drivers::kernels::{every, machines};
use crate::support::machines::without_unused_word;

/// Uniform blocks of a kernel, at most: from the fourth on lavapipe of Mesa 22.2 to 23.0 writes behind a table of its own.
const BLOCKS: usize = 3;

fn too_many(kernel: &Kernel) -> Option<String> {
    let count = |pass: &Pass| pass.bindings().filter(|(_, b)| b.access == Access::Uniform).count();
    let most = kernel.passes.iter().map(count).max().unwrap_or(0);
    (most > BLOCKS).then(|| format!("{most} uniform blocks"))
}

#[test]
fn uniform_blocks_are_few_and_begin_with_the_unused_word() {
    let mut faults = BTreeSet::new();
    for (name, machine) in machines() {
        for (of, kernel) in every(machine) {
            let wrong = without_unused_word(&kernel).into_iter().chain(too_many(&kernel));
            faults.extend(wrong.map(|fault| format!("{of}, {name}: `{}`: {fault}", kernel.name)));
        }
    }
    assert!(faults.is_empty(), "{faults:#?}");
}
