//! Laws that read and write columns, over every visit of pairs, against their references; and what is refused of them.

mod pairs;
mod refusals;

use crate::support::{Shared, machines};
use glam::DVec3;
use motes::forces::{Law, Over, Particle};
use motes::kernel::{
    ALARM, Array, Backend, Column, Columns, Kind, Machine, POSITION, Plan, Problem, QUIET, Source, World,
};
use motes::lockstep::compare;
use motes::tree::Opening;
use motes::visit::Outcome;

/// Reads a scalar of both particles, and writes a scalar, a vector and a count beside an acceleration.
const CHARGED: &str = "
@group(3) @binding(1) var<storage, read> charge: array<f32>;
@group(3) @binding(2) var<storage, read_write> field: array<f32>;
@group(3) @binding(3) var<storage, read_write> torque: array<vec4f>;
struct Sum { field: f32, torque: vec3f, push: vec3f }
fn merge(total: ptr<function, Sum>, part: Sum) {
    (*total).field += part.field;
    (*total).torque += part.torque;
    (*total).push += part.push;
}
fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let near = 1.0 / (1.0 + dot(r, r));
    (*sum).field += charge[you.index] * near;
    (*sum).torque += (charge[you.index] * near) * cross(r, vec3f(0.3, -0.7, 0.2));
    (*sum).push += (charge[me.index] * charge[you.index] * near) * r;
}
fn finish(me: Particle, sum: Sum) -> vec4f {
    field[me.index] = sum.field;
    torque[me.index] += vec4f(sum.torque, 0.0);
    return vec4f(sum.push, charge[me.index] * sum.field);
}";

#[derive(Default)]
struct Sum {
    field: f64,
    torque: DVec3,
    push: DVec3,
}

fn charged(over: Over) -> Law {
    charging(over, true)
}

fn charging(over: Over, turns: bool) -> Law {
    let charge = |p: &Particle| p.scalar("charge").unwrap_or(f64::NAN);
    let gather = move |me: &Particle, you: &Particle, r: DVec3, _: &World, sum: &mut Sum| {
        let near = 1.0 / (1.0 + r.length_squared());
        sum.field += charge(you) * near;
        sum.torque += charge(you) * near * r.cross(DVec3::new(0.3, -0.7, 0.2));
        sum.push += charge(me) * charge(you) * near * r;
    };
    let finish = move |me: &Particle, sum: &Sum, _: &World, outcome: &mut Outcome| {
        outcome.set("field", sum.field);
        if turns {
            outcome.add("torque", sum.torque);
        }
        outcome.accelerate(sum.push.extend(charge(me) * sum.field));
    };
    let into = ["acceleration", "field", "torque"];
    Law::computing("charged", over, Source::ours("charged", CHARGED), Vec::new(), &into, gather, finish)
}

// A search of the nearest binds so much that a law has room for three buffers of its own.
fn without_torque(over: Over) -> Law {
    let text = CHARGED
        .replace("@group(3) @binding(3) var<storage, read_write> torque: array<vec4f>;\n", "")
        .replace("    torque[me.index] += vec4f(sum.torque, 0.0);\n", "");
    let mut law = charging(over, false);
    law.wgsl = Source::ours("charged", Box::leak(text.into_boxed_str()));
    law.into.retain(|name| name != "torque");
    law
}

fn columns() -> Columns {
    let charge = Column::new("charge", Kind::Scalar, "charge", "how strongly it pushes").required();
    let field = Column::new("field", Kind::Scalar, "charge / length", "what the others make").derived();
    let torque = Column::new("torque", Kind::Vector, "mass length² / time²", "what turns it").summed();
    Columns::with([charge, field, torque]).expect("columns that fit")
}

// The plan of one law of a cloud on a machine, behind the cell list that it searches.
fn plan(law: Law, problem: &Problem) -> Plan {
    let mut plan = Plan::default();
    if let Some((grid, moving)) = law.grid(problem).expect("a range") {
        plan.add(grid.kernel(problem, moving).expect("a cell list"));
    }
    plan.add(law.kernel(problem).expect("a kernel"));
    plan
}

fn problem(count: usize, machine: Machine) -> Problem {
    let cloud = crate::support::cloud(count, 3);
    Problem::new(u32::try_from(count).expect("few"), machine)
        .at(cloud.position(), motes::Bounds::default())
        .of_species(cloud.species())
        .tied(&cloud.links, &[])
        .of_columns(columns())
}

/// Every kernel of a plan in lockstep, of a cloud with charges.
fn check(shared: &Shared, plan: &Plan, count: usize, machine: Machine, what: &str) {
    let cloud = crate::support::cloud(count, 3);
    let mut gpu = machines::gpu(shared, count);
    gpu.pretend(machine);
    gpu.compile(plan).expect("a program");
    let number = u32::try_from(count).expect("few");
    gpu.set_world(World { time: 0.0, dt: 1e-3, step: 0, count: number, free: 0, bounds: motes::Bounds::default() })
        .expect("a world");
    let place = cloud.position().iter().zip(cloud.mass()).map(|(x, m)| x.extend(*m));
    gpu.write(POSITION.name, &Array::Vec4(place.collect())).expect("positions");
    gpu.write(ALARM.name, &Array::Uint(QUIET.to_vec())).ok();
    let mut random = crate::support::Random::new(9);
    let charges: Vec<f64> = (0..count).map(|_| f64::from(random.narrow()) + 0.1).collect();
    gpu.write("charge", &Array::Float(charges)).expect("charges");
    gpu.write("torque", &Array::Vec3(vec![DVec3::new(0.5, -0.25, 2.0); count])).ok();
    let verdicts = pollster::block_on(compare(&mut gpu, plan, number)).expect("verdicts");
    let of_law: Vec<_> = verdicts.iter().filter(|verdict| verdict.kernel == "charged").collect();
    let written = plan.kernels.last().expect("a law").writes();
    for field in ["acceleration", "field", "torque"].into_iter().filter(|name| written.iter().any(|w| w == name)) {
        let verdict = of_law.iter().find(|verdict| verdict.field == field);
        let verdict = verdict.unwrap_or_else(|| panic!("{what}: nothing is said of `{field}`"));
        assert!(verdict.sound() && verdict.changed, "{what}: {verdict:?}");
    }
}

#[test]
fn columns_agree_with_the_reference_over_every_visit_of_pairs() {
    let shared = crate::support::device();
    for (name, machine) in machines::machines(&shared) {
        for count in [1, 63, 300] {
            let searched = [
                Over::Pairs,
                Over::Within { range: 0.8 },
                Over::Near { range: 0.8, of: None },
                Over::Nearest { count: 5 },
            ];
            // Without another particle nothing changes, which proves nothing.
            for over in searched.into_iter().filter(|_| count > 1) {
                let law = if matches!(over, Over::Nearest { .. }) { without_torque(over) } else { charged(over) };
                let plan = plan(law, &problem(count, machine));
                check(&shared, &plan, count, machine, &format!("{name}, {count}, {over:?}"));
            }
        }
    }
}

#[test]
fn a_law_that_gives_no_acceleration_writes_its_columns_alone() {
    let shared = crate::support::device();
    let text = CHARGED
        .replace("-> vec4f {\n    field", "{\n    field")
        .replace("    return vec4f(sum.push, charge[me.index] * sum.field);\n", "");
    let text: &'static str = Box::leak(text.into_boxed_str());
    for over in [Over::Pairs, Over::Near { range: 0.8, of: None }, Over::Nearest { count: 5 }] {
        let (count, machine) = (129, Machine { invocations: 1 << 18, ..Machine::HOST });
        let mut law = charged(over);
        law.wgsl = Source::ours("charged", text);
        law.into.retain(|name| name != "acceleration");
        let plan = plan(law, &problem(count, machine));
        let written = plan.kernels.last().expect("a law").writes();
        assert!(!written.iter().any(|name| name == "acceleration"), "{over:?}: {written:?}");
        assert!(["field", "torque"].iter().all(|name| written.iter().any(|w| w == name)), "{over:?}: {written:?}");
    }
    drop(shared);
}

#[test]
fn each_particle_updates_its_columns() {
    let shared = crate::support::device();
    let wgsl = "@group(3) @binding(1) var<storage, read_write> charge: array<f32>;
        fn update(me: Particle) { charge[me.index] = 0.75 * charge[me.index] + me.position.x; }";
    let law = Law::updating("charged", Source::ours("update", wgsl), Vec::new(), &["charge"], |me, _, outcome| {
        outcome.set("charge", 0.75 * me.scalar("charge").unwrap_or(f64::NAN) + me.position.x);
    });
    let count = 300;
    let problem = problem(count, Machine::HOST);
    let plan = plan(law, &problem);
    let mut gpu = machines::gpu(&shared, count);
    gpu.compile(&plan).expect("a program");
    let number = u32::try_from(count).expect("few");
    gpu.set_world(World { time: 0.0, dt: 1e-3, step: 0, count: number, free: 0, bounds: motes::Bounds::default() })
        .expect("a world");
    let cloud = crate::support::cloud(count, 3);
    let place = cloud.position().iter().zip(cloud.mass()).map(|(x, m)| x.extend(*m));
    gpu.write(POSITION.name, &Array::Vec4(place.collect())).expect("positions");
    gpu.write("charge", &Array::Float(vec![0.3; count])).expect("charges");
    let verdicts = pollster::block_on(compare(&mut gpu, &plan, number)).expect("verdicts");
    assert!(verdicts.iter().all(|v| v.good() && v.changed) && verdicts.len() == 1, "{verdicts:?}");
}

#[test]
fn a_law_over_a_tree_may_write_columns() {
    let problem = problem(300, Machine::HOST);
    let over = Over::Tree { opening: Opening::Geometric { theta: 0.5 }, core: 0.0, auto: false };
    let plan = plan(charged(over), &problem);
    let written = plan.kernels.last().expect("a law").writes();
    assert!(["acceleration", "field", "torque"].iter().all(|name| written.iter().any(|w| w == name)), "{written:?}");
}
