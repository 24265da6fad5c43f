//! Positions are read in each frame, and no frame waits for them: a request is looked at some frames later.
//!
//! `cargo run --release --example read_back`

use std::collections::VecDeque;
use std::error::Error;

use motes::typed::{Gravity, default, plummer};
use motes::{POSITION, Readback, Setup, Simulation, gpu};

const FRAMES: u32 = 40;

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let state = plummer(4000).build()?;
    let setup = Setup::new(state, vec![Gravity { softening: 0.05, ..default() }.into()], 0.01);
    let found = pollster::block_on(gpu::best())?;
    let mut simulation = Simulation::new(&found.device, &found.queue, &setup)?;
    let mut under_way: VecDeque<(u32, Readback<glam::Vec4>)> = VecDeque::new();
    let (mut seen, mut latest) = (Vec::new(), 0.0);
    for frame in 0..FRAMES {
        simulation.step(1)?;
        under_way.push_back((frame, simulation.request(POSITION)?));
        // Whatever has come by now; what has not may come in a later frame.
        while let Some((asked, readback)) = under_way.front_mut() {
            let Some(answer) = readback.look() else { break };
            let positions = answer?;
            latest = positions.iter().map(|x| x.truncate().length()).sum::<f32>() / positions.len() as f32;
            seen.push((*asked, frame));
            under_way.pop_front();
        }
        // Here the frame is drawn.
    }
    // At the end there is time: awaiting sleeps until the device is done.
    for (asked, readback) in under_way {
        let positions = pollster::block_on(readback)?;
        latest = positions.iter().map(|x| x.truncate().length()).sum::<f32>() / positions.len() as f32;
        seen.push((asked, FRAMES));
    }
    assert!(seen.iter().map(|(asked, _)| *asked).eq(0..FRAMES), "each frame's positions come once, in their order");
    let late = seen.iter().map(|(asked, came)| came - asked).max().unwrap_or(0);
    println!("{FRAMES} frames: positions came {late} frames late at most; the mean radius is {latest:.3}");
    Ok(())
}
