//! Iterations of a solve that is done cost next to nothing: how many workgroups each has stands on the device.

use std::sync::Arc;

use super::{Dfsph, Solve};
use crate::error::Error;
use crate::kernel::{Host, Kernel, Name};

/// The workgroups of the kernels of an iteration: of each of two solves, sweeps, and parts of a sum. The sum itself writes them, so
/// that it cannot be told.
pub const GO: &str = "dfsph_go";
const ALL: &str = "dfsph_all";
/// Kernels of a solve that are told.
const KERNELS: u32 = 2;
/// Words of one.
const EACH: u32 = 3;
/// Words of a solve.
pub const SOLVE: usize = (KERNELS * EACH) as usize;
const WORDS: usize = 2 * SOLVE;

/// What is told how many workgroups it has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Told {
    Sweep,
    Tally,
}

/// The same kernel, told how many workgroups it has, where it is one dispatch: of several, each would be told the same.
pub fn told(mut kernel: Kernel, solve: Solve, what: Told) -> Kernel {
    if let [pass] = &mut kernel.passes[..] {
        pass.told = Some((GO.into(), EACH * (KERNELS * solve as u32 + what as u32)));
    }
    sized(kernel)
}

/// The same kernel, with the size of what tells.
pub fn sized(mut kernel: Kernel) -> Kernel {
    kernel.sizes.extend([GO, ALL].map(|name| (Name::from(name), WORDS as u64)));
    kernel
}

/// The kernel that lets all of them go.
pub fn kernel(of: &Dfsph<'_>, iterations: &[Vec<Kernel>]) -> Result<Kernel, Error> {
    let mut words = vec![0; WORDS];
    for pass in iterations.iter().flatten().flat_map(|kernel| &kernel.passes) {
        if let Some((_, from)) = pass.told {
            let groups = pass.workgroups(of.problem.machine.workgroups)?;
            let from = from as usize;
            words[from..from + groups.len()].copy_from_slice(&groups);
        }
    }
    let twin = |host: &Host| {
        host.writing::<u32>(GO)?.copy_from_slice(&host.reading::<u32>(ALL)?);
        Ok(())
    };
    let kernel = of.plain("fluid go", &[crate::shader!("fluids/dfsph/go.wgsl")], &[], 1, Arc::new(twin))?;
    Ok(Kernel { tables: vec![(ALL.into(), Arc::new(words))], ..sized(kernel) })
}
