//! What may go to another thread, and be kept there for as long as one likes.

use glam::Vec4;
use motes::simulation::Readback;
use motes::typed::{Gravity, default};
use motes::{Cpu, Gpu, POSITION, Setup, Simulation, State};

const fn goes_anywhere<T: Send + Sync + 'static>() {}

const _: () = {
    goes_anywhere::<Simulation<Gpu>>();
    goes_anywhere::<Simulation<Cpu>>();
    goes_anywhere::<Readback<Vec4>>();
    goes_anywhere::<Setup>();
    goes_anywhere::<State>();
    goes_anywhere::<motes::Error>();
    goes_anywhere::<motes::run::Run>();
    goes_anywhere::<motes::scene::Scene>();
};

#[test]
fn a_simulation_steps_in_another_thread() {
    let shared = crate::support::device();
    let setup = super::setup(crate::support::cloud(9, 3), Vec::new());
    let mut simulation = super::on_gpu(&shared, &setup);
    let steps = std::thread::spawn(move || simulation.step(3).map(|()| simulation.steps())).join().expect("no panic");
    assert_eq!(steps.expect("steps"), 3);
}

/// Reads of each of the threads. In a version that waited for a time, one look in a few hundred ended in a panic.
const READS: u32 = 100;

#[test]
fn simulations_in_threads_share_a_device() {
    let shared = crate::support::device();
    let simulations = [3, 4, 5, 6, 7, 8].map(|seed| {
        let setup =
            super::setup(crate::support::cloud(2500, seed), vec![Gravity { softening: 0.05, ..default() }.into()]);
        super::on_gpu(&shared, &setup)
    });
    let threads = simulations.map(|mut simulation| {
        std::thread::spawn(move || {
            for _ in 0..READS {
                simulation.step(1).expect("a step");
                pollster::block_on(simulation.read(POSITION)).expect("positions");
            }
            simulation.steps()
        })
    });
    for thread in threads {
        assert_eq!(thread.join().expect("no panic"), u64::from(READS));
    }
}
