//! Uniform blocks as lavapipe of Mesa 22.2 to 23.0 needs them; see `src/kernel/unused_word.rs`.

use std::collections::BTreeSet;

use motes::kernel::{Access, Kernel};

use crate::drivers::kernels::{every, machines};
use crate::support::machines::without_unused_word;

/// What is wrong with any kernel of any machine.
fn faults(wrong: impl Fn(&Kernel) -> Option<String>) -> BTreeSet<String> {
    let mut faults = BTreeSet::new();
    for (name, machine) in machines() {
        for (of, kernel) in every(machine) {
            faults.extend(wrong(&kernel).map(|fault| format!("{of}, {name}: `{}`: {fault}", kernel.name)));
        }
    }
    faults
}

#[test]
fn uniform_blocks_begin_with_the_unused_word() {
    let faults = faults(without_unused_word);
    assert!(faults.is_empty(), "{faults:#?}");
}

/// Uniform blocks of a kernel, at most: from the fourth on lavapipe of Mesa 22.2 to 23.0 writes behind a table of its own.
const BLOCKS: usize = 3;

#[test]
fn no_kernel_binds_more_than_three_uniform_blocks() {
    let faults = faults(|kernel| {
        let count = |pass: &motes::kernel::Pass| pass.bindings().filter(|(_, b)| b.access == Access::Uniform).count();
        let most = kernel.passes.iter().map(count).max().unwrap_or(0);
        (most > BLOCKS).then(|| format!("{most} uniform blocks"))
    });
    assert!(faults.is_empty(), "{faults:#?}");
}
