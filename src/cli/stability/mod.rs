//! `motes stability`: a harmonic oscillator and an exponential decay by every integrator.

mod picture;
mod theory;

use glam::DVec3;
use motes::integrators::{Entry, INTEGRATORS};
use motes::kernel::Backend;
use motes::stability::{Oscillator, largest_step, oscillator, spectral_radius};
use motes::{Cpu, Error, Gpu, POSITION, Simulation, VELOCITY};

use serde_json::{Value, json};

use super::args::StabilityArgs;
use super::engine::Engine;
use super::failure::Failure;

/// The number of steps in which an unstable mode grows tenfold.
const LONG: f64 = 1e6;
/// Stability limits below this, in units of 1 / ω, count as 0.
const NONE: f64 = 0.05;

/// The solutions of the two equations by an integrator.
struct Course {
    name: &'static str,
    /// E / E₀ of x″ = −ω² x after each step.
    energy: Vec<f64>,
    /// |u / u₀| of u′ = −a u.
    size: Vec<f64>,
    /// The factor of the energy, and of |u|, in a step.
    growth: [f64; 2],
    /// The largest hω and ha.
    limits: [f64; 2],
}

/// Integrates both equations by every integrator, prints a table, and draws a picture.
pub async fn stability(args: &StabilityArgs) -> Result<(), Failure> {
    let engine = Engine::choose(&args.device).await?;
    let mut courses = Vec::new();
    for entry in INTEGRATORS {
        let course = match &engine {
            Engine::Gpu(found) => Box::pin(course(entry, args, || Gpu::new(&found.device, &found.queue, 1))).await?,
            Engine::Cpu(_) => course(entry, args, || Cpu::new(1)).await?,
        };
        courses.push(course);
    }
    picture::draw(&args.out, &courses, args)?;
    if args.json {
        let rows: Vec<Value> = courses
            .iter()
            .map(|course| {
                let [energy, size] = course.growth;
                let [swings, decays] = course.limits;
                json!({ "integrator": course.name, "energy_growth": energy, "energy_theory": theory::energy(course.name, args.omega_step),
                    "omega_limit": swings, "decay_growth": size, "decay_theory": theory::decay(course.name, args.decay_step),
                    "decay_limit": decays })
            })
            .collect();
        out!(
            "{:#}",
            json!({ "device": engine.describe(), "omega_step": args.omega_step, "decay_step": args.decay_step, "steps": args.steps,
                "picture": args.out, "rows": rows })
        );
        return Ok(());
    }
    out!("on {}", engine.describe());
    out!(
        "x″ = −ω² x at hω = {}: growth of the energy per step; u′ = −a u at ha = {}: of |u|\n",
        args.omega_step,
        args.decay_step
    );
    out!(
        "{:<24}{:>12}{:>12}{:>12}  {:>12}{:>12}{:>12}",
        "",
        "energy",
        "by theory",
        "hω up to",
        "|u|",
        "by theory",
        "ha up to"
    );
    for course in &courses {
        let theory = [theory::energy(course.name, args.omega_step), theory::decay(course.name, args.decay_step)];
        let theory = theory.map(|x| x.map_or_else(|| "—".to_owned(), number));
        let [energy, size] = course.growth.map(number);
        let [swings, decays] = course.limits.map(limit);
        out!("{:<24}{energy:>12}{:>12}{swings:>12}  {size:>12}{:>12}{decays:>12}", course.name, theory[0], theory[1]);
    }
    out!("\n{} shows {} steps", args.out.display(), args.steps);
    Ok(())
}

async fn course<B: Backend>(
    entry: &Entry,
    args: &StabilityArgs,
    backend: impl Fn() -> Result<B, Error>,
) -> Result<Course, Failure> {
    let (y, z) = (args.omega_step, args.decay_step);
    let swing = oscillator(entry.by_default(), 1.0, 0.0, y);
    let energy = run(Simulation::on(backend()?, &swing)?, args.steps, |x, v| x.length_squared() + v.length_squared());
    let mut decay = oscillator(entry.by_default(), 0.0, 1.0, z);
    decay.state.velocity_mut().copy_from_slice(&[DVec3::X]);
    let size = run(Simulation::on(backend()?, &decay)?, args.steps, |_, v| v.length());
    let swings = Oscillator::on(backend()?, entry.by_default(), 1.0, 0.0)?.growth(y).await?;
    let mut step = Oscillator::on(backend()?, entry.by_default(), 0.0, 1.0)?.step(z).await?;
    // The decay does not depend on the position.
    step.x_axis = DVec3::ZERO;
    step.y_axis.x = 0.0;
    step.z_axis.x = 0.0;
    let limits = [
        largest_step(entry.by_default(), 1.0, 0.0, LONG).await?,
        largest_step(entry.by_default(), 0.0, 1.0, LONG).await?,
    ];
    Ok(Course {
        name: entry.name,
        energy: energy.await?,
        size: size.await?,
        growth: [swings * swings, spectral_radius(step)],
        limits,
    })
}

/// A quantity of a run, relative to its initial value.
async fn run<B: Backend>(
    mut simulation: Simulation<B>,
    steps: u32,
    what: impl Fn(DVec3, DVec3) -> f64,
) -> Result<Vec<f64>, Error> {
    let mut list = Vec::new();
    for step in 0..=steps {
        if step > 0 {
            simulation.step(1)?;
        }
        let (x, v) = (simulation.read(POSITION).await?, simulation.read(VELOCITY).await?);
        let first = |values: &[glam::Vec4]| values.first().map_or(DVec3::NAN, |v| v.truncate().as_dvec3());
        list.push(what(first(&x), first(&v)));
    }
    let start = list[0];
    Ok(list.into_iter().map(|x| x / start).collect())
}

/// A number with at most seven digits.
fn number(x: f64) -> String {
    if x != 0.0 && !(1e-3..1e5).contains(&x) { format!("{x:.3e}") } else { format!("{x:.6}") }
}

fn limit(x: f64) -> String {
    match x {
        x if x.is_infinite() => "any".to_owned(),
        x if x < NONE => "none".to_owned(),
        x => format!("{x:.4}"),
    }
}
