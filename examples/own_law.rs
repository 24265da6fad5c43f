//! A law of one's own, in WGSL, with a parameter and a table that change between frames.
//!
//! `cargo run --release --example own_law`

use std::error::Error;

use glam::DVec3;
use motes::typed::{RandomBox, random_box};
use motes::{Custom, Over, Setup, Simulation, VELOCITY, gpu};

/// A wind over the ground: its strength is a parameter, and a profile over height is a table.
const LAW: &str = "struct Params { strength: f32, rate: f32 }
@group(3) @binding(0) var<uniform> params: Params;
@group(3) @binding(1) var<storage, read> profile: array<f32>;

fn force(me: Particle) -> vec4f {
    let place = clamp(me.position.y + 0.5, 0.0, 0.999) * f32(arrayLength(&profile));
    let air = vec3f(params.strength * profile[u32(place)], 0.0, 0.0);
    return vec4f(params.rate * (air - velocity[me.index].xyz), 0.0);
}
";

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let state = RandomBox { size: DVec3::ONE, ..random_box(1000) }.build()?;
    let wind = Custom {
        params: vec![("strength".to_owned(), 1.0.into()), ("rate".to_owned(), 5.0.into())],
        tables: vec![("profile".into(), [0.0_f32, 0.5, 1.0, 1.0].map(f32::to_bits).to_vec().into())],
        ..Custom::new("wind over ground", "wind.wgsl", LAW, Over::Each)
    };
    let setup = Setup::new(state, vec![Box::new(wind)], 0.02);
    pollster::block_on(async {
        let found = gpu::best().await?;
        let mut simulation = Simulation::new(&found.device, &found.queue, &setup)?;
        let mut means: Vec<f32> = Vec::new();
        for frame in 0..30 {
            // It calms down, and blows near the ground at last.
            simulation.set("wind over ground", "strength", 1.0 - f64::from(frame) / 30.0)?;
            if frame == 20 {
                simulation.set("wind over ground", "profile", &[1.0_f32, 0.0, 0.0, 0.0][..])?;
            }
            simulation.step(5)?;
            if frame % 10 == 9 {
                let velocities = simulation.read(VELOCITY).await?;
                means.push(velocities.iter().map(|v| v.x).sum::<f32>() / velocities.len() as f32);
            }
        }
        assert!(means[0] > means[1] && means[1] > means[2], "{means:?}");
        println!("mean velocities after 10, 20 and 30 frames: {means:.3?}");
        // A slip of the pen is an error that names what was meant.
        println!("{}", simulation.set("wind over ground", "strenght", 1.0).expect_err("no such parameter"));
        Ok(())
    })
}
