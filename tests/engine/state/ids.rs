//! Ids are names that stay with particles, apart from the rows of their values.

use motes::kernel::{Array, Backend};
use motes::settings::Value;
use motes::{Bounds, Cpu, Setup, Simulation, State};

use crate::support::states::{force, integrator};
use crate::support::{cloud, device};

/// Particles that wander at random.
fn wandering(mut state: State) -> Setup {
    state.links = motes::links::Links::default();
    Setup {
        state,
        forces: vec![force("wander", &[("strength", Value::Number(0.7))])],
        integrator: integrator("leapfrog"),
        dt: 0.07,
        bounds: Bounds::default(),
        solver: motes::Solver::default(),
    }
}

/// Where particles are after some steps.
fn walked<B: Backend>(mut simulation: Simulation<B>) -> Vec<[u64; 3]> {
    simulation.step(9).expect("steps");
    match pollster::block_on(simulation.read_column("position")).expect("positions") {
        Array::Vec3(list) => list.iter().map(|x| x.to_array().map(f64::to_bits)).collect(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn random_numbers_follow_ids() {
    let all = cloud(12, 3);
    let mut some = all.picked(&[5, 2, 9]);
    let nameless = some.clone();
    some.set_ids(vec![5, 2, 9]).expect("three ids");
    let shared = device();
    let on_gpu = |state| {
        walked(Simulation::new(&shared.found.device, &shared.found.queue, &wandering(state)).expect("a simulation"))
    };
    let on_cpu = |state: State| {
        let count = u32::try_from(state.len()).expect("few");
        walked(Simulation::on(Cpu::new(count).expect("some"), &wandering(state)).expect("a simulation"))
    };
    for (name, all, some, nameless) in [
        ("device", on_gpu(all.clone()), on_gpu(some.clone()), on_gpu(nameless.clone())),
        ("references", on_cpu(all.clone()), on_cpu(some), on_cpu(nameless)),
    ] {
        assert_eq!(some, [all[5], all[2], all[9]], "{name}");
        assert_ne!(some, nameless, "{name}");
    }
}

#[test]
fn snapshots_keep_ids() {
    let mut state = cloud(3, 1);
    state.set_ids(vec![4, 1, 8]).expect("three ids");
    assert!(state.clone().set_ids(vec![1, 1, 2]).is_err() && state.clone().set_ids(vec![0, 1, u32::MAX]).is_err());
    let mut simulation = Simulation::on(Cpu::new(3).expect("three"), &wandering(state)).expect("a simulation");
    simulation.step(2).expect("steps");
    let snapshot = pollster::block_on(simulation.snapshot()).expect("a state");
    assert_eq!((snapshot.ids().to_vec(), snapshot.next_id(), snapshot.place_of(8)), (vec![4, 1, 8], 9, Some(2)));
    let mut more = snapshot.clone();
    more.append(&cloud(2, 2)).expect("two more");
    assert_eq!(more.ids().to_vec(), [4, 1, 8, 9, 10]);
    let mut all = State::default();
    all.append(&snapshot).expect("three");
    assert_eq!((all.ids().to_vec(), all.next_id()), (vec![4, 1, 8], snapshot.next_id()), "none of them was taken");
    let mut plain = cloud(2, 2);
    plain.append(&snapshot).expect("three more");
    assert_eq!(plain.ids().to_vec(), [0, 1, 2, 3, 4]);
    let mut twice = wandering(snapshot);
    twice.state.get_mut("id").into_iter().for_each(|ids| *ids = Array::Uint(vec![1, 1, 2]));
    let why = Simulation::on(Cpu::new(3).expect("three"), &twice).err().expect("a refusal").to_string();
    assert!(why.contains("two particles have id 1"), "{why}");
}
