//! A fountain that runs forever: particles are spawned at its mouth and removed where they fall below it, while the plan stays as it
//! was compiled. Rows are used again, and ids are not.
//!
//! `cargo run --release --example spawn_and_remove`

use std::error::Error;

use glam::{DVec3, Vec4};
use motes::typed::{Uniform, default};
use motes::{POSITION, Setup, Simulation, State, gpu};

/// Particles of a burst, and what is between two of them \[time\].
const BURST: u32 = 64;
const STEPS: u32 = 20;

/// A burst, upwards and a little apart.
fn burst(number: u32) -> State {
    let mut state = State::default();
    for k in 0..BURST {
        let angle = f64::from(number * BURST + k) * 2.4;
        let way = 0.3 * DVec3::new(angle.cos(), 0.0, angle.sin());
        state.push(0.1 * way, 3.0 * DVec3::Y + way, 1.0, 0.01);
    }
    state
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let down = Uniform { acceleration: -9.81 * DVec3::Y, ..default() };
    // Room for all that fly at a time: for 0.75 units of it, that is 15 bursts, and one more.
    let mut state = burst(0);
    state.capacity = Some(16 * BURST);
    let setup = Setup::new(state, vec![down.into()], 0.0025);
    pollster::block_on(async {
        let found = gpu::best().await?;
        let mut simulation = Simulation::new(&found.device, &found.queue, &setup)?;
        let mut spawned = BURST;
        for number in 1..60 {
            simulation.step(STEPS)?;
            let places: Vec<Vec4> = simulation.read(POSITION).await?;
            let below = |(id, x): (Option<u32>, &Vec4)| id.filter(|_| x.y < -0.5);
            let fallen: Vec<u32> = simulation.ids().into_iter().zip(&places).filter_map(below).collect();
            simulation.remove(&fallen).await?;
            spawned += u32::try_from(simulation.spawn(&burst(number)).await?.len())?;
        }
        let flying = simulation.population().await?.active;
        println!(
            "{spawned} spawned, {flying} fly, in {} rows; compiled anew {} times",
            simulation.capacity(),
            simulation.generation()
        );
        Ok(())
    })
}
