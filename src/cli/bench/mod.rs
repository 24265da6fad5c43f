//! `motes bench`: the speed of steps of built-in scenes. `benches/baselines` compares steps with plain Rust.

use std::time::{Duration, Instant};

use motes::scene::{Options, Scene, Source};
use motes::{Error, Gpu, Simulation, gpu};
use serde_json::json;

use super::args::{BenchArgs, Topic};
use super::engine;
use super::failure::Failure;
use super::words::{duration, large};

/// One measurement takes about this long, unless a step is longer \[s\].
const SPAN: f64 = 0.3;

impl Topic {
    const ALL: [Self; 5] = [Self::Gravity, Self::Tree, Self::Neighbors, Self::Springs, Self::Fluids];

    /// Its name, its scene, and what is changed in that.
    fn scene(self) -> (&'static str, &'static str, &'static [&'static str]) {
        match self {
            Self::Gravity => ("gravity", "plummer", &["particles.0.count=16384", "force.0.over=pairs"]),
            Self::Tree => ("tree", "plummer", &["force.0.over=tree"]),
            Self::Neighbors => ("neighbors", "flock", &[]),
            Self::Springs => ("springs", "flag", &[]),
            Self::Fluids => ("fluids", "dam_break", &[]),
        }
    }
}

/// Measures what was asked for.
pub async fn bench(args: &BenchArgs) -> Result<(), Failure> {
    let found = engine::open(gpu::adapters(&gpu::instance()).await, args.adapter.as_deref()).await?;
    if !args.json {
        out!("{}\n", found.describe());
        out!("{:>10}  {:>12}  {:>9}  {:>12}  {:>16}", "", "scene", "particles", "step", "particles × steps");
    }
    let mut rows = Vec::new();
    for topic in Topic::ALL.into_iter().filter(|topic| args.topic.is_none_or(|wanted| wanted == *topic)) {
        let (name, word, changes) = topic.scene();
        let changes: Vec<String> = changes.iter().map(|change| (*change).to_owned()).collect();
        let mut scene = Scene::load(&Source::find(word)?, &changes, &Options::default())?;
        let setup = scene.setup();
        let mut simulation = Simulation::new(&found.device, &found.queue, &setup)?;
        let times = times(&mut simulation, args.repeat.max(1))?;
        let mut sorted = times.clone();
        sorted.sort_by(f64::total_cmp);
        let (step, count) = (sorted[sorted.len() / 2], setup.state.len());
        let rate = count as f64 / step;
        if !args.json {
            let time = duration(Duration::from_secs_f64(step));
            out!("{name:>10}  {word:>12}  {count:>9}  {time:>12}  {:>14}/s", large(rate));
        }
        rows.push(json!({ "topic": name, "scene": word, "changes": changes, "particles": count,
            "seconds_per_step": times, "particle_steps_per_second": rate }));
    }
    if args.json {
        let version = env!("CARGO_PKG_VERSION");
        let value = json!({ "device": found.describe(), "version": version, "repeat": args.repeat, "topics": rows });
        out!("{value:#}");
    }
    Ok(())
}

/// Seconds of a step, so many times; the first steps, in which a device compiles, do not count.
fn times(simulation: &mut Simulation<Gpu>, repeat: usize) -> Result<Vec<f64>, Error> {
    let mut take = |steps: u32| -> Result<f64, Error> {
        let start = Instant::now();
        simulation.step(steps)?;
        simulation.backend().wait()?;
        Ok(start.elapsed().as_secs_f64() / f64::from(steps))
    };
    take(1)?;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small whole number")]
    let steps = (SPAN / take(1)?).clamp(1.0, 10_000.0) as u32;
    (0..repeat).map(|_| take(steps)).collect()
}
