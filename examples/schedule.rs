//! A game's schedule: systems run in stages, and one resource that all of them borrow in turn is the simulation. It goes to whichever
//! thread a stage runs in, as a resource of Bevy does.
//!
//! `cargo run --release --example schedule`

use std::collections::BTreeMap;
use std::error::Error;

use glam::{DVec3, Vec4};
use motes::typed::{Attractor, Plummer, plummer};
use motes::{Gpu, POSITION, Readback, Setup, Simulation, gpu};

/// What systems share.
struct World {
    simulation: Simulation<Gpu>,
    frame: u32,
    cursor: DVec3,
    under_way: Option<Readback<Vec4>>,
    center: Option<Vec4>,
}

#[derive(PartialEq, Eq, PartialOrd, Ord, Clone, Copy)]
enum Stage {
    Input,
    Update,
    Extract,
}

type System = fn(&mut World) -> Result<(), motes::Error>;

/// Leads the cursor round, and the attractor to it.
fn follow(world: &mut World) -> Result<(), motes::Error> {
    let angle = 0.1 * f64::from(world.frame);
    world.cursor = DVec3::new(angle.cos(), angle.sin(), 0.0);
    world.simulation.set("attractor", "position", world.cursor)
}

fn step(world: &mut World) -> Result<(), motes::Error> {
    world.frame += 1;
    world.simulation.step(2)
}

/// Takes the mean place of all particles of some frame before, and asks for that of this one.
fn extract(world: &mut World) -> Result<(), motes::Error> {
    if let Some(answer) = world.under_way.as_mut().and_then(Readback::look) {
        let positions = answer?;
        world.center = Some(positions.iter().sum::<Vec4>() / positions.len() as f32);
        world.under_way = None;
    }
    if world.under_way.is_none() {
        world.under_way = Some(world.simulation.request(POSITION)?);
    }
    Ok(())
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let found = pollster::block_on(gpu::best())?;
    let state = Plummer { scale: 0.1, ..plummer(3000) }.build()?;
    let setup = Setup::new(state, vec![Attractor::default().into()], 0.01);
    let simulation = Simulation::new(&found.device, &found.queue, &setup)?;
    let mut world = World { simulation, frame: 0, cursor: DVec3::ZERO, under_way: None, center: None };
    let mut schedule: BTreeMap<Stage, Vec<System>> = BTreeMap::new();
    schedule.entry(Stage::Extract).or_default().push(extract);
    schedule.entry(Stage::Input).or_default().push(follow);
    schedule.entry(Stage::Update).or_default().push(step);
    for _ in 0..60 {
        for system in schedule.values().flatten() {
            // Another thread for each, as an executor may have it.
            std::thread::scope(|scope| scope.spawn(|| system(&mut world)).join()).map_err(|_| "a system failed")??;
        }
    }
    let center = world.center.ok_or("nothing was read")?;
    println!("{} frames, the cursor at {:.2}, particles about {:.2}", world.frame, world.cursor, center.truncate());
    Ok(())
}
