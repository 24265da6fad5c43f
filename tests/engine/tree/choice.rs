//! When a tree is walked, and when it cannot be.

use motes::Error;
use motes::forces::Stage;
use motes::kernel::{Machine, Pass, Plan, Problem};
use motes::visit::crossing;

use crate::support::{self, machines::walkers};
use crate::tree::sets::cloud;
use crate::tree::walks::{Settings, USUAL, Walk, gravity, walks};

#[test]
fn auto_is_whichever_is_faster() {
    for software in [false, true] {
        let machine = Machine { software, subgroup: 0, invocations: 1 << 18, ..Machine::HOST };
        let at = crossing(&machine);
        for (count, tree) in [(1, false), (at - 1, false), (at, true), (at + 1, true)] {
            let problem = Problem::new(count, machine);
            for (over, tree) in [("auto", tree), ("tree", true), ("pairs", false)] {
                let law = gravity(over, USUAL).laws().swap_remove(0);
                assert_eq!(law.tree(&problem).is_some(), tree, "{over}, {count}");
                let kernel = law.kernel(&problem).expect("a kernel");
                assert_eq!(kernel.passes.iter().any(walks), tree, "{over}, {count}");
                assert!(kernel.reference.is_some(), "{over}");
            }
        }
    }
}

#[test]
fn an_opening_angle_is_above_0_and_1_at_most() {
    let problem = Problem::new(100, Machine { software: false, subgroup: 0, invocations: 1, ..Machine::HOST });
    for alpha in [0.0, 0.005] {
        for theta in [1.001, 2.0, 0.0, -0.5, 1e-300, f64::NAN, 1e-6, 0.01, 1.0] {
            let gravity = gravity("tree", Settings { theta, alpha, ..USUAL });
            let mut plan = Plan::default();
            match gravity.stage(Stage::Evaluate { earlier: 0 }, &mut plan, &problem) {
                Ok(()) => assert!((1e-6..=1.0).contains(&theta), "{theta}"),
                Err(Error::Scene(said)) => {
                    assert!(
                        !(1e-6..=1.0).contains(&theta) && ["θ", "theta"].iter().any(|name| said.contains(name)),
                        "{said}"
                    );
                }
                Err(other) => panic!("{theta}: {other}"),
            }
        }
    }
}

/// What no device here holds can still be planned; without particles there is nothing to walk.
#[test]
fn plans_for_none_and_for_the_most() {
    for machine in [true, false].map(|software| Machine { software, subgroup: 8, invocations: 1, ..Machine::HOST }) {
        for (count, least) in [(0, 0), (1, 1), (33, 1), ((1 << 18) + 1, 2), (1 << 27, 512)] {
            let law = gravity("tree", USUAL).laws().swap_remove(0);
            let kernel = law.kernel(&Problem::new(count, machine)).expect("a kernel");
            assert!(kernel.passes.len() >= least && (count > 33 || kernel.passes.len() == least), "{count}");
            let begins = |pass: &&Pass| pass.shader.reflection().entry == "walk" && pass.indirect.is_none();
            let lanes: u64 = kernel.passes.iter().filter(begins).map(|pass| u64::from(pass.threads.count)).sum();
            let workgroup = kernel.passes.first().map_or(1, |pass| pass.shader.reflection().workgroup);
            assert_eq!(lanes, u64::from(count.div_ceil(32)) * u64::from(workgroup), "{count}");
        }
    }
}

#[test]
fn each_machine_has_a_walk_of_its_own() {
    let shared = support::device();
    for (name, machine) in walkers(&shared) {
        let walk = Walk::new(&shared, machine, &cloud(40, 22), gravity("tree", USUAL));
        for file in ["alone", "tile", "subgroup"] {
            assert_eq!(walk.has(&format!("tree_{file}.wgsl")), file == name, "{name}, {file}");
        }
    }
}
