//! Neighbours: the cell list against its reference, and searches through it against brute force.
#![allow(
    clippy::cast_sign_loss,
    clippy::cast_possible_truncation,
    clippy::items_after_statements,
    reason = "numbers are small, and what a test needs stands in it"
)]

mod auto;
mod exact;
mod exclusions;
mod far;
mod growth;
mod history;
mod list;
mod places;
mod properties;
mod refusals;
mod runs;
mod sizes;
mod skin;

use crate::support::states::integrator;
use crate::support::{Shared, machines};
use motes::forces::{Component, Law, Over};
use motes::integrators::Step;
use motes::kernel::{Backend, Machine, Problem, Source};
use motes::lockstep::compare;
use motes::{Gpu, Setup, Simulation};
use places::Place;

/// A law that reads all arguments of a visit, and is not 0 at the cut-off radius.
#[derive(Clone)]
pub struct Curious(pub Over);

impl Component for Curious {
    fn laws(&self) -> Vec<Law> {
        let wgsl = "fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
            let v = velocity_of(you) - velocity_of(me);
            let near = 1.0 / (1.0 + dot(r, r));
            (*sum).acceleration += (you.mass * near) * (v + f32(you.index % 7u) * r);
            (*sum).potential += you.mass * me.mass * near;
        }
        fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.acceleration, sum.potential); }";
        vec![Law::between("curious", self.0, Source::ours("curious", wgsl), Vec::new(), |me, you, r| {
            let near = 1.0 / (1.0 + r.length_squared());
            let v = you.velocity - me.velocity + (you.index % 7) as f64 * r;
            (you.mass * near * v).extend(you.mass * me.mass * near)
        })]
    }
}

/// The machines whose files differ.
fn variants(shared: &Shared) -> Vec<(&'static str, Machine)> {
    let mut all = vec![("lanes", Machine { software: false, subgroup: 0, invocations: 1 << 18, ..Machine::HOST })];
    if machines::subgroups_of_eight(shared) {
        all.push(("subgroup", Machine { software: true, subgroup: 8, invocations: 256, ..Machine::HOST }));
    }
    all
}

fn simulation(gpu: Gpu, place: &Place, force: Box<dyn Component>) -> Simulation<Gpu> {
    let setup = Setup {
        state: place.particles.clone(),
        forces: vec![force],
        integrator: integrator("symplectic_euler"),
        dt: 1e-3,
        bounds: place.bounds,
        solver: motes::Solver::default(),
    };
    Simulation::on(gpu, &setup).expect("a simulation")
}

#[test]
fn the_grid_and_the_search_agree_with_brute_force() {
    let shared = crate::support::device();
    for place in places::all() {
        for (name, machine) in variants(&shared) {
            let mut gpu = machines::gpu(&shared, place.particles.len());
            gpu.pretend(machine);
            check(gpu, &place, Over::Near { range: place.range, of: None }, &format!("{}, {name}", place.name));
        }
    }
}

#[test]
fn the_nearest_are_those_that_a_sort_finds() {
    let shared = crate::support::device();
    for place in places::all() {
        for neighbors in [1, 4, 7, 16] {
            let gpu = machines::gpu(&shared, place.particles.len());
            check(gpu, &place, Over::Nearest { count: neighbors }, &format!("{}, {neighbors} nearest", place.name));
        }
    }
}

/// Compares one evaluation of the curious law with its references.
fn check(gpu: Gpu, place: &Place, over: Over, of: &str) {
    let count = u32::try_from(place.particles.len()).expect("few");
    let machine = gpu.machine();
    let mut simulation = simulation(gpu, place, Box::new(Curious(over)));
    let problem = Problem::new(count, machine).at(place.particles.position(), place.bounds);
    let forces: [Box<dyn Component>; 1] = [Box::new(Curious(over))];
    let mut step = Step::new(&forces, problem);
    step.evaluate();
    let plan = step.finished().expect("a plan");
    let verdicts = pollster::block_on(compare(simulation.backend(), &plan, count)).expect("a comparison");
    assert!(verdicts.iter().any(|v| v.kernel.starts_with("grid")), "{of}: {plan}");
    for verdict in verdicts {
        assert!(verdict.good(), "{of}: {plan}: {verdict:?}");
    }
}
