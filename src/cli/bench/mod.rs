//! `motes bench`: the speed of steps of built-in scenes. `benches/baselines` compares steps with plain Rust.

mod case;
mod kernels;
mod results;
mod spirv;

use std::time::{Duration, Instant};

use glam::Vec4;
use motes::gpu::{self, Found};
use motes::kernel::{POSITION, VELOCITY};
use motes::{Error, Gpu, Simulation};
use serde_json::{Value, json};

use super::args::{BenchArgs, Topic};
use super::engine;
use super::failure::Failure;
use super::words::{duration, large};
use case::Case;
use results::Results;

/// The maximum duration of a measurement, unless a step is longer \[s\].
const SPAN: f64 = 0.3;
/// The number of steps after which the particles are put back, so that the scene as it is given is measured on a fast device too: a particle of
/// `flock` has 10 neighbours at the start, and 150 after 2000 steps.
const MOST: u32 = 200;
/// Numbers of iterations of a solve: the time of an iteration is the difference between steps with many and with few.
const ITERATIONS: [u32; 2] = [4, 24];

/// The topics that are measured by default.
const ALL: [Topic; 7] =
    [Topic::Gravity, Topic::Tree, Topic::Neighbors, Topic::Springs, Topic::Fluids, Topic::Solve, Topic::Stream];

/// Measures the requested topics.
pub async fn bench(args: &BenchArgs) -> Result<(), Failure> {
    let found = engine::open(gpu::adapters(&gpu::instance()).await, args.adapter.as_deref()).await?;
    let mut results = Results::new(args, &found);
    if !args.json {
        out!("{}\n", found.describe());
    }
    if args.topic == Some(Topic::Kernels) {
        results.add(kernels::kernels(args, &found).await?)?;
    } else if let Some(scene) = &args.scene {
        let text = format!("`{scene}` is for `motes bench kernels {scene}`; the other topics have scenes of their own");
        return Err(Error::Scene(text).into());
    } else {
        if !args.json {
            out!("{:>14}  {:>16}  {:>9}  {:>12}  {:>16}", "", "scene", "particles", "step", "particles × steps");
        }
        for topic in ALL.into_iter().filter(|topic| args.topic.is_none_or(|its| its == *topic || its == Topic::All)) {
            measure(args, &found, topic, &mut results).await?;
        }
    }
    if args.json {
        out!("{}", results.text());
    }
    Ok(())
}

/// All sizes of a topic.
async fn measure(args: &BenchArgs, found: &Found, topic: Topic, results: &mut Results) -> Result<(), Failure> {
    let (begun, mut last) = (Instant::now(), 0.0);
    for case in case::cases(topic, args.to) {
        let (start, name) = (Instant::now(), case.topic);
        if let Some(seconds) =
            args.seconds.filter(|most| last > 0.0 && begun.elapsed().as_secs_f64() + 4.0 * last > *most)
        {
            if !args.json {
                out!(
                    "{name:>14}  {:>16}  {:>9}  left out: it would end later than --seconds {seconds}",
                    case.scene,
                    case.count
                );
            }
            results
                .add(json!({ "topic": name, "scene": case.scene, "particles": case.count, "left_out": "--seconds" }))?;
            continue;
        }
        match row(args, found, &case).await {
            // A size that does not fit ends this topic.
            Err(Failure::Error(error @ (Error::Limit(_) | Error::OutOfMemory(_)))) if args.to.is_some() => {
                if !args.json {
                    out!("{name:>14}  {:>16}  {:>9}  left out: {error}", case.scene, case.count);
                }
                results.add(json!({ "topic": name, "scene": case.scene, "particles": case.count, "left_out": error.to_string() }))?;
            }
            row => results.add(row?)?,
        }
        last = start.elapsed().as_secs_f64();
    }
    Ok(())
}

/// One measurement.
async fn row(args: &BenchArgs, found: &Found, case: &Case) -> Result<Value, Failure> {
    let repeat = args.repeat.max(1);
    let (name, word) = (case.topic, case.scene);
    if name == "solve" {
        return solve(args, found, case).await;
    }
    let setup = case.setup(&[])?;
    let count = setup.state.len();
    let mut simulation = Simulation::new(&found.device, &found.queue, &setup)?;
    drop(setup);
    // Of all topics only flocks and fluids change their speed with time.
    let changes = matches!(name, "neighbors" | "fluids" | "incompressible");
    let mut rerun = if changes { Rerun::of(&mut simulation).await? } else { Rerun::default() };
    let times = times(&mut simulation, &mut rerun, repeat)?;
    // The times of a failed run are not reported.
    simulation.check().await?;
    let step = median(&times);
    let rate = count as f64 / step;
    if !args.json {
        let time = duration(Duration::from_secs_f64(step));
        out!("{name:>14}  {word:>16}  {count:>9}  {time:>12}  {:>14}/s", large(rate));
    }
    Ok(json!({ "topic": name, "scene": word, "changes": case.changes, "particles": count,
        "seconds_per_step": times, "particle_steps_per_second": rate }))
}

/// The time of an iteration of conjugate gradients, by steps in which no solve converges.
async fn solve(args: &BenchArgs, found: &Found, case: &Case) -> Result<Value, Failure> {
    let mut simulations = Vec::new();
    let mut count = 0;
    for iterations in ITERATIONS {
        let setup = case.setup(&[format!("solver.iterations={iterations}")])?;
        count = setup.state.len();
        simulations.push(Simulation::new(&found.device, &found.queue, &setup)?);
    }
    let mut times = Vec::new();
    // A device that idles between steps lowers its clock: several steps are submitted in a row.
    let mut steps = 1;
    for turn in 0..=args.repeat.max(1) {
        let mut seconds = Vec::new();
        for (simulation, iterations) in simulations.iter_mut().zip(ITERATIONS) {
            simulation.step(1)?;
            simulation.backend().wait()?;
            let start = Instant::now();
            simulation.step(steps)?;
            simulation.backend().wait()?;
            seconds.push(start.elapsed().as_secs_f64() / f64::from(steps));
            let converged = simulation.solves().await?.map_or(0, |solves| solves.solves - solves.failures);
            if converged > 0 {
                let text = format!(
                    "{converged} solves of {} took fewer than {iterations} iterations: their time says nothing",
                    case.scene
                );
                return Err(Error::Scene(text).into());
            }
        }
        if turn == 0 {
            steps = steps_for(seconds[1]);
        } else {
            times.push((seconds[1] - seconds[0]) / f64::from(ITERATIONS[1] - ITERATIONS[0]));
        }
    }
    let iteration = median(&times);
    if !args.json {
        let time = duration(Duration::from_secs_f64(iteration.max(0.0)));
        out!("{:>14}  {:>16}  {count:>9}  {time:>12}  an iteration", case.topic, case.scene);
    }
    Ok(json!({ "topic": case.topic, "scene": case.scene, "changes": case.changes, "particles": count,
        "seconds_per_iteration": times }))
}

/// The median.
fn median(all: &[f64]) -> f64 {
    let mut sorted = all.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(f64::NAN)
}

/// Positions and velocities at the start of a scene, for repeated measurements; all other state is kept.
#[derive(Default)]
struct Rerun {
    position: Vec<Vec4>,
    velocity: Vec<Vec4>,
    taken: u32,
}

impl Rerun {
    async fn of(simulation: &mut Simulation<Gpu>) -> Result<Self, Error> {
        Ok(Self { position: simulation.read(POSITION).await?, velocity: simulation.read(VELOCITY).await?, taken: 0 })
    }
    /// Puts the particles back to the start, unless this number of further steps is within [`MOST`].
    fn prepare(&mut self, simulation: &mut Simulation<Gpu>, steps: u32) -> Result<(), Error> {
        self.taken += steps;
        if self.taken > MOST && !self.position.is_empty() {
            self.taken = steps + 1;
            simulation.write(POSITION, &self.position)?;
            simulation.write(VELOCITY, &self.velocity)?;
            simulation.step(1)?;
        }
        simulation.backend().wait()
    }
}

/// The number of steps of this duration \[s\] in a measurement, before the particles are put back.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small whole number")]
fn steps_for(step: f64) -> u32 {
    (SPAN / step).clamp(1.0, f64::from(MOST - 1)) as u32
}

/// Repeated measurements of the seconds of a step; the first steps, in which a device compiles, do not count.
fn times(simulation: &mut Simulation<Gpu>, rerun: &mut Rerun, repeat: usize) -> Result<Vec<f64>, Error> {
    let mut take = |steps: u32| -> Result<f64, Error> {
        rerun.prepare(simulation, steps)?;
        let start = Instant::now();
        simulation.step(steps)?;
        simulation.backend().wait()?;
        Ok(start.elapsed().as_secs_f64() / f64::from(steps))
    };
    take(1)?;
    let steps = steps_for(take(1)?);
    (0..repeat).map(|_| take(steps)).collect()
}
