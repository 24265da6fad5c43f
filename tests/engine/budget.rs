//! What a step of standard scenes costs, by counts that no device is needed for. `tests/engine/budget.txt` holds them, and a change
//! of any is made there on purpose: `UPDATE=1 cargo test --test engine budget` writes the file anew.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use motes::kernel::{Cost, Kernel, Machine};

use crate::support::scenes::{setup, with};

const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/engine/budget.txt");
const HEAD: &str = "\
# What a step costs, by counts that no device is needed for; `UPDATE=1 cargo test --test engine budget` writes this anew.
# least, most: dispatches of a step when loops end after their first iteration, and when none ends early.
# bound: bytes of the storage buffers that the least dispatches bind, for each particle. work: pair evaluations, by which submissions are cut.
# buffers: bytes of all buffers that the scene has on the device, for each particle.
";

/// What it is called, the scene, and what is set in that.
const SCENES: &[(&str, &str, &[&str])] = &[
    ("galaxy", "galaxy", &[]),
    ("all pairs", "plummer", &["particles.0.count=16384", "force.0.over=pairs"]),
    ("tree", "plummer", &["particles.0.count=65536", "force.0.over=tree"]),
    ("a million, all pairs", "plummer", &["particles.0.count=1048576", "force.0.over=pairs"]),
    ("a million, tree", "plummer", &["particles.0.count=1048576", "force.0.over=tree"]),
    ("flock", "flock", &[]),
    ("vicsek", "vicsek", &[]),
    ("weakly compressible", "dam_break", &[]),
    ("incompressible", "dam_break", &["force.1.solver=dfsph"]),
    ("springs", "flag", &[]),
    ("implicit springs", "stiff", &[]),
    ("rods", "hair", &[]),
    ("ions", "salt", &[]),
];

/// The machines with the most different variants: lavapipe, and a discrete GPU.
fn machines() -> [(&'static str, Machine); 2] {
    let (bindable, workgroups) = (128 << 20, 65_535);
    let software = Machine { subgroup: 8, invocations: 256, bindable, workgroups, ..Machine::HOST };
    let gpu =
        Machine { software: false, subgroup: 32, invocations: 1 << 18, meetings: 1 << 32, turns: u32::MAX, ..software };
    [("software", software), ("gpu", gpu)]
}

const NUMBERS: [&str; 7] = ["particles", "least", "most", "bound", "buffers", "work", "workgroups"];

fn row(scene: &str, overrides: &[&str], machine: Machine) -> Vec<u64> {
    let setup = setup(with(scene, overrides));
    let plans = setup.plans(machine).unwrap_or_else(|error| panic!("{scene}: {error}"));
    let count = setup.check().expect("particles");
    let costs = plans.step.fused().costs(count, machine.workgroups).expect("dispatches that fit");
    let sum = |of: &dyn Fn(&Cost) -> u64| costs.iter().map(of).sum::<u64>();
    let mut buffers = BTreeMap::new();
    for (name, bytes) in plans.all().flat_map(|plan| plan.fields(count)) {
        let most = buffers.entry(name).or_insert(0);
        *most = bytes.max(*most);
    }
    let each = |bytes: u64| bytes.div_ceil(count.into());
    vec![
        count.into(),
        sum(&|cost| cost.least * cost.dispatches),
        sum(&|cost| cost.most * cost.dispatches),
        each(sum(&|cost| cost.least * cost.bytes)),
        each(buffers.values().sum()),
        each(sum(&|cost| cost.least * cost.work)),
        sum(&|cost| cost.least * cost.workgroups),
    ]
}

/// A row of the table, and its numbers.
fn read(line: &str) -> Option<(String, Vec<u64>)> {
    let (name, numbers) = (line.get(..31)?.trim(), line.get(31..)?);
    let numbers: Result<Vec<u64>, _> = numbers.split_whitespace().map(str::parse).collect();
    numbers.ok().map(|numbers| (name.to_owned(), numbers))
}

#[test]
fn a_step_costs_what_the_table_says() {
    let mut table = format!("{HEAD}{:<31}", "scene, machine");
    NUMBERS.iter().for_each(|name| write!(table, "{name:>11}").expect("text"));
    table.push('\n');
    for (name, scene, overrides) in SCENES {
        for (kind, machine) in machines() {
            write!(table, "{:<31}", format!("{name}, {kind}")).expect("text");
            row(scene, overrides, machine).iter().for_each(|number| write!(table, "{number:>11}").expect("text"));
            table.push('\n');
        }
    }
    if std::env::var_os("UPDATE").is_some() {
        std::fs::write(FILE, &table).expect("the file can be written");
        return;
    }
    let golden = std::fs::read_to_string(FILE).expect("tests/engine/budget.txt");
    let golden: BTreeMap<String, Vec<u64>> = golden.lines().filter_map(read).collect();
    let mut changed = Vec::new();
    for (name, numbers) in table.lines().filter_map(read) {
        let before = golden.get(&name).cloned().unwrap_or_default();
        for (place, what) in NUMBERS.iter().enumerate() {
            let (old, new) = (before.get(place), numbers.get(place));
            if old != new {
                changed.push(format!("{name}: {what} {old:?} -> {new:?}"));
            }
        }
    }
    let text = "steps cost something else than tests/engine/budget.txt says; if that is meant: UPDATE=1 cargo test --test engine budget";
    assert!(changed.is_empty(), "{text}\n{}", changed.join("\n"));
    assert_eq!(golden.len(), SCENES.len() * machines().len(), "rows of the table");
}

#[test]
fn loops_are_counted_in_full_and_once() {
    let machine = machines()[0].1;
    let setup = setup(with("stiff", &[]));
    let plan = setup.plans(machine).expect("plans").step;
    let costs = plan.costs(setup.check().expect("particles"), machine.workgroups).expect("costs");
    let most: u64 = costs.iter().filter(|cost| cost.kernel.is_some()).map(|cost| cost.most * cost.dispatches).sum();
    assert_eq!(most, plan.dispatches(), "{plan}");
    let least: u64 = costs.iter().filter(|cost| cost.kernel.is_some()).map(|cost| cost.least * cost.dispatches).sum();
    let once: u64 = plan.steps().map(|kernel: &Kernel| kernel.passes.len() as u64).sum();
    assert_eq!(least, once, "{plan}");
    let loops = costs.iter().find(|cost| cost.kernel.is_none()).expect("a loop");
    assert!(least < most && loops.least < loops.most, "{plan}: {loops:?}");
}
