//! What may go to another thread, and be kept there for as long as one likes.

use glam::Vec4;
use motes::simulation::Readback;
use motes::{Cpu, Gpu, Setup, Simulation, State};

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
