//! Which search finds neighbours, where that is left open: by how many there are at the start, and for a whole run.

use motes::forces::{Component, Law, Over};
use motes::kernel::{Machine, Plan, Source};
use motes::visit::{Loads, few_neighbors};
use motes::{Bounds, Setup};

use crate::neighbors::exact::same;
use crate::neighbors::growth::inward;
use crate::neighbors::list::{Weak, accelerations, on, setup, wanted};
use crate::neighbors::variants;
use crate::support::{self, machines};

fn auto(range: f64) -> Over {
    Over::Auto { range, skin: None }
}

/// The weak law as one that asks for velocities, and does nothing with them.
#[derive(Clone)]
struct Moving(Over);

impl Component for Moving {
    fn laws(&self) -> Vec<Law> {
        let mut law = Weak(self.0).laws().remove(0);
        let wgsl = format!("{}\nfn idle(you: Particle) -> vec3f {{ return velocity_of(you); }}", law.wgsl.text);
        law.wgsl = Source { text: wgsl.into(), ..law.wgsl };
        vec![law]
    }
}

fn keeps_a_list(plan: &Plan) -> bool {
    plan.steps().any(|kernel| kernel.name.starts_with("list "))
}

fn step(setup: &Setup, machine: Machine) -> Plan {
    setup.plans(machine).expect("plans").step
}

#[test]
fn few_neighbours_are_kept_on_a_list_where_that_is_measured() {
    let state = support::cloud(400, 9);
    let mean = |range: f64| {
        let places = state.position();
        let near =
            |i: usize| places.iter().enumerate().filter(|(j, x)| *j != i && x.distance(places[i]) < range).count();
        (0..places.len()).map(near).sum::<usize>() as f64 / places.len() as f64
    };
    let mut seen = [0, 0];
    for software in [false, true] {
        let machine = Machine { software, ..Machine::HOST };
        for range in [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1.2] {
            for (loads, force) in [
                (Loads::Positions, Box::new(Weak(auto(range))) as Box<dyn Component>),
                (Loads::Velocities, Box::new(Moving(auto(range)))),
            ] {
                let setup = setup(&state, Bounds::default(), force, 7e-3);
                let few = few_neighbors(&machine, loads);
                let list = few > 0.0 && mean(range) <= few;
                let plan = step(&setup, machine);
                assert_eq!(keeps_a_list(&plan), list, "{software}, {range}: {} neighbours, {plan}", mean(range));
                seen[usize::from(list)] += 1;
            }
        }
    }
    assert!(seen[0] > 16 && seen[1] > 3, "{seen:?}");
}

#[test]
fn both_find_what_brute_force_finds() {
    let shared = support::device();
    for (variant, machine) in variants(&shared) {
        for range in [0.2, 0.7] {
            let setup = setup(&support::cloud(300, 8), Bounds::default(), Box::new(Moving(auto(range))), 2e-3);
            let mut simulation = on(&shared, machine, &setup);
            for _ in 0..4 {
                simulation.step(5).expect("steps");
                let want = wanted(&mut simulation, &Bounds::default(), range);
                same(&accelerations(&mut simulation), &want, &format!("{variant}, {range}"));
            }
        }
    }
}

/// A cloud that has fallen in would go by the cell list, were it a beginning.
#[test]
fn a_run_that_goes_on_keeps_its_search() {
    let shared = support::device();
    let machine = Machine { software: true, ..variants(&shared)[0].1 };
    let whole = inward(300, 8, Box::new(Moving(auto(0.31))));
    let mut gpu = machines::gpu(&shared, 300);
    gpu.pretend(machine);
    let mut simulation = motes::Simulation::on(gpu, &whole).expect("a simulation");
    simulation.step(100).expect("steps");
    let state = pollster::block_on(simulation.snapshot()).expect("a state");
    assert!(keeps_a_list(&step(&whole, machine)));
    let later = Setup { state: state.clone(), ..whole.clone() };
    assert!(keeps_a_list(&step(&later, machine)));
    assert!(!keeps_a_list(&step(&Setup { state: state.begin_anew(), ..whole.clone() }, machine)));
    let mut again = on(&shared, machine, &later);
    assert!(again.goes_on());
    [&mut simulation, &mut again].into_iter().for_each(|one| one.step(10).expect("steps"));
    assert_eq!(accelerations(&mut simulation), accelerations(&mut again));
}
