//! A state is saved while a run continues, changed, and another run continues from it: bit for bit where nothing is changed.
//!
//! `cargo run --release --example save_and_restore`

use std::error::Error;

use motes::typed::{Spring, Uniform, cloth};
use motes::{POSITION, Setup, Simulation, VELOCITY, gpu};

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let state = cloth(20, 20).build()?;
    let setup = Setup::new(state, vec![Spring::default().into(), Uniform::default().into()], 0.002);
    pollster::block_on(async {
        let found = gpu::best().await?;
        let on_device = |setup: &Setup| Simulation::new(&found.device, &found.queue, setup);
        let mut simulation = on_device(&setup)?;
        simulation.step(100)?;
        // All of it: columns, links, fixed particles, motions, the clock, and what a step keeps for the next.
        let saved = simulation.snapshot().await?;
        // Settings that change later are those of `simulation.setup()` then.
        let before = simulation.setup().clone();
        simulation.set("uniform", "acceleration", glam::DVec3::X)?;
        simulation.step(100)?;

        let mut restored = on_device(&before.with_state(saved.clone()))?;
        assert!(restored.goes_on());
        restored.set("uniform", "acceleration", glam::DVec3::X)?;
        restored.step(100)?;
        assert_eq!(simulation.steps(), restored.steps());
        assert_eq!(simulation.read(POSITION).await?, restored.read(POSITION).await?);

        // A state is data: another one begins where this one was, at rest.
        let mut calm = saved;
        calm.velocity_mut().fill(glam::DVec3::ZERO);
        let mut other = on_device(&before.with_state(calm))?;
        assert!(!other.goes_on());
        other.step(100)?;
        assert_ne!(simulation.read(VELOCITY).await?, other.read(VELOCITY).await?);
        println!("step {}: the restored run has the same bits, the changed one has its own", restored.steps());
        Ok(())
    })
}
