//! The build, kernel by kernel.

use motes::lockstep::compare;

use crate::sets::{Built, GEOMETRIC, MACHINES, RELATIVE, cloud};
use crate::support;

#[test]
fn each_kernel_agrees_with_its_twin_at_every_size() {
    let shared = support::device();
    for machine in MACHINES {
        for count in [1, 2, 3, 4, 5, 31, 32, 33, 63, 64, 65, 1000] {
            for (opening, core) in [(GEOMETRIC, 0.0), (RELATIVE, 0.05)] {
                let felt = cloud(count, 3);
                let mut built = Built::new(&shared, &cloud(count, 2), &felt, opening, core, machine);
                let plan = built.plan.clone();
                let verdicts = pollster::block_on(compare(&mut built.gpu, &plan, count as u32)).expect("a comparison");
                for verdict in &verdicts {
                    assert!(verdict.good(), "{count}, {opening}, {machine:?}: {verdict:?}");
                }
            }
        }
    }
}
