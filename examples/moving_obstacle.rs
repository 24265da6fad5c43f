//! A flock and a ball that moves through it: the ball's place is set before each frame, and nothing is compiled for that.
//!
//! `cargo run --release --example moving_obstacle`

use std::error::Error;

use glam::DVec3;
use motes::typed::{Boids, Obstacle, RandomBox, default, random_box};
use motes::{Gpu, POSITION, Setup, Simulation, gpu};

const FRAMES: u32 = 30;
const RADIUS: f64 = 0.4;

/// Where the ball is in a frame: it goes once round.
fn ball(frame: u32) -> DVec3 {
    let angle = std::f64::consts::TAU * f64::from(frame) / f64::from(FRAMES);
    0.8 * DVec3::new(angle.cos(), angle.sin(), 0.0)
}

/// The birds inside of the ball.
async fn inside(simulation: &mut Simulation<Gpu>, center: DVec3) -> Result<usize, motes::Error> {
    let birds = simulation.read(POSITION).await?;
    Ok(birds.iter().filter(|x| x.truncate().as_dvec3().distance(center) < 0.5 * RADIUS).count())
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let state = RandomBox { size: DVec3::splat(2.0), ..random_box(2000) }.build()?;
    let obstacle = Obstacle { position: ball(0), radius: RADIUS, max_force: 60.0, look_ahead: 0.3, ..default() };
    let setup = Setup::new(state, vec![Boids { range: 0.2, ..default() }.into(), obstacle.into()], 0.01);
    pollster::block_on(async {
        let found = gpu::best().await?;
        let mut simulation = Simulation::new(&found.device, &found.queue, &setup)?;
        let before = inside(&mut simulation, ball(0)).await?;
        let pipelines = simulation.backend().pipelines();
        for frame in 0..=FRAMES {
            simulation.set("obstacle", "position", ball(frame))?;
            simulation.step(4)?;
        }
        let after = inside(&mut simulation, ball(FRAMES)).await?;
        assert_eq!(simulation.backend().pipelines(), pipelines, "something was compiled");
        assert!(after < before, "the flock makes no way: {before} birds before, {after} after");
        println!("{before} birds were where the ball came from, {after} are where it is");
        Ok(())
    })
}
