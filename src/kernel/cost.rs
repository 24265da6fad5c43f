//! The cost of a run of a plan, by counts that need no device.

use super::{Access, Kernel, Op, Pass, Plan};
use crate::error::Error;

/// The cost of the dispatches of one kernel.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Cost {
    /// The index of the kernel in [`Plan::kernels`]; `None` for the control dispatches of loops.
    pub kernel: Option<usize>,
    /// The number of runs when every loop ends after its first iteration.
    pub least: u64,
    /// The number of runs when no loop ends early.
    pub most: u64,
    /// Dispatches of one run.
    pub dispatches: u64,
    /// Workgroups of one run, without indirect dispatches, whose numbers are known only on the device.
    pub workgroups: u64,
    /// Bytes of the storage buffers that one run binds: each buffer counts once in each dispatch.
    pub bytes: u64,
    /// Work of one run; see [`Pass::work`].
    pub work: u64,
}

impl Plan {
    /// The cost of each kernel for `count` particles, on a device that dispatches `limit` workgroups in one dimension.
    ///
    /// # Errors
    /// [`Error::Limit`] when a dispatch is too wide for the device.
    pub fn costs(&self, count: u32, limit: u32) -> Result<Vec<Cost>, Error> {
        let fields = self.fields(count);
        let bound = |pass: &Pass| -> u64 {
            let storage = pass.bindings().filter(|(_, binding)| binding.access != Access::Uniform);
            storage.filter_map(|(field, _)| fields.get(field)).sum()
        };
        let mut costs = Vec::new();
        for (place, kernel) in self.kernels.iter().enumerate() {
            let runs = |full: bool| self.ops.iter().map(|op| runs(op, place, full)).sum();
            let known = kernel.passes.iter().filter(|pass| pass.indirect.is_none());
            let groups: Result<Vec<[u32; 3]>, _> = known.map(|pass| pass.workgroups(limit)).collect();
            let cost = Cost {
                kernel: Some(place),
                least: runs(false),
                most: runs(true),
                dispatches: kernel.passes.len() as u64,
                workgroups: groups?.iter().map(|groups| groups.iter().map(|n| u64::from(*n)).product::<u64>()).sum(),
                bytes: kernel.passes.iter().map(bound).sum(),
                work: kernel.passes.iter().map(|pass| pass.work).sum(),
            };
            if cost.most > 0 {
                costs.push(cost);
            }
        }
        let [least, most] = [false, true].map(|full| self.ops.iter().map(|op| controls(op, full)).sum::<u64>());
        if most > 0 {
            let cost = Cost { kernel: None, least, most, dispatches: 1, workgroups: 1, bytes: 0, work: 0 };
            costs.push(cost);
        }
        Ok(costs)
    }
    /// The name of the kernel of a cost.
    #[must_use]
    pub fn name(&self, cost: &Cost) -> &str {
        let kernel = cost.kernel.and_then(|place| self.kernels.get(place));
        kernel.map_or("iterations of loops", |kernel: &Kernel| &kernel.name)
    }
}

/// The number of times an operation runs a kernel, with loops in full or with one iteration of each.
fn runs(op: &Op, kernel: usize, full: bool) -> u64 {
    match op {
        Op::Run(index) => u64::from(*index == kernel),
        Op::Repeat { most, body, .. } => times(*most, full) * body.iter().map(|op| runs(op, kernel, full)).sum::<u64>(),
    }
}

/// The number of times an operation begins an iteration of a loop or ends the loop: iterations that are not needed are dispatches of no
/// workgroups.
fn controls(op: &Op, full: bool) -> u64 {
    match op {
        Op::Run(_) => 0,
        Op::Repeat { most, body, .. } => {
            let inner: u64 = body.iter().map(|op| controls(op, full)).sum();
            times(*most, full) * inner + if *most > 1 { times(*most - 1, full) + 1 } else { 0 }
        }
    }
}

fn times(most: u32, full: bool) -> u64 {
    if full { most.into() } else { u64::from(most > 0) }
}
