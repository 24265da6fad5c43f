//! `motes bench`

use std::time::Instant;

use motes::kernel::Backend;
use motes::settings::{Settings, Value};
use motes::{Bounds, Error, Particles, Setup, Simulation, forces, gpu, integrators, lockstep, particles};
use serde_json::json;

use super::args::BenchArgs;
use super::baseline::Bodies;
use super::engine;
use super::failure::Failure;
use super::progress::large;

const SOFTENING: f64 = 0.02;
/// Bodies of the comparison of integrators.
const INTEGRATED: u32 = 4096;
/// One measurement takes about this long, unless a step is longer \[s\].
const SPAN: f64 = 0.15;

struct Row {
    count: u32,
    /// Seconds of a whole step, each measurement.
    device: Vec<f64>,
    /// Seconds of the plain loop, each measurement.
    plain: Vec<f64>,
}

/// Measures all-pairs gravity over sizes, and the integrators.
pub async fn bench(args: &BenchArgs) -> Result<(), Failure> {
    let found = engine::open(gpu::adapters(&gpu::instance()).await, args.adapter.as_deref()).await?;
    if !args.json {
        out!(
            "{}\ncommit {}, {} cores, {} repeats, medians\n",
            found.describe(),
            commit(),
            rayon::current_num_threads(),
            args.repeat
        );
        out!("all pairs, gravity with potential, leapfrog, whole steps");
        out!("{:>9}  {:>12}  {:>16}  {:>16}  {:>7}", "bodies", "step", "device", "plain Rust", "ratio");
    }
    let rows = sizes(args, &found)?;
    let integrators = integrators(args, &found)?;
    let accuracy = accuracy(&found).await?;
    if args.json {
        let sizes: Vec<_> = rows.iter().map(Row::json).collect();
        let steps: Vec<_> = integrators.iter().map(|(name, evaluations, time)| json!({ "integrator": name, "evaluations": evaluations, "seconds_per_step": time })).collect();
        let value = json!({ "device": found.describe(), "commit": commit(), "version": env!("CARGO_PKG_VERSION"),
            "cores": rayon::current_num_threads(), "repeat": args.repeat, "softening": SOFTENING, "pairs": sizes,
            "integrators": { "bodies": INTEGRATED, "steps": steps },
            "relative_force_error": { "bodies": INTEGRATED, "median": accuracy[0], "p99": accuracy[1], "max": accuracy[2] } });
        out!("{value:#}");
    }
    Ok(())
}

fn sizes(args: &BenchArgs, found: &gpu::Found) -> Result<Vec<Row>, Failure> {
    let mut rows: Vec<Row> = Vec::new();
    let mut count = args.from.max(1);
    while count <= args.to {
        let expected = rows.last().map_or(0.0, |row| 4.0 * median(&row.device));
        if expected > args.longest {
            if !args.json {
                out!("{count:>9}  left out: a step is expected to take {expected:.0} s (--longest)");
            }
            break;
        }
        let row = measure(args, found, count, rows.last())?;
        if !args.json {
            out!("{row}");
        }
        rows.push(row);
        count = count.saturating_mul(2);
    }
    Ok(rows)
}

fn measure(args: &BenchArgs, found: &gpu::Found, count: u32, last: Option<&Row>) -> Result<Row, Failure> {
    let setup = setup(count, "leapfrog")?;
    let mut simulation = Simulation::new(&found.device, &found.queue, &setup)?;
    let bodies: Vec<[f32; 4]> = setup
        .particles
        .position
        .iter()
        .zip(&setup.particles.mass)
        .map(|(x, m)| x.extend(*m).as_vec4().to_array())
        .collect();
    let bodies = Bodies::new(&bodies);
    // Both are warm before they count, and take turns, so that what else the machine does falls on both.
    let mut turns = [1, 1];
    let mut row = Row { count, device: Vec::new(), plain: Vec::new() };
    let plain = last.is_none_or(|row| 4.0 * median(&row.plain) <= args.longest && !row.plain.is_empty());
    for turn in 0..=args.repeat.max(1) {
        let device = time(turns[0], || simulation.step(turns[0]).and_then(|()| simulation.backend().wait()))?;
        let loops = if plain {
            time(turns[1], || {
                (0..turns[1]).for_each(|_| drop(std::hint::black_box(bodies.evaluate(SOFTENING_F32))));
                Ok(())
            })?
        } else {
            f64::NAN
        };
        if turn == 0 {
            let second = time(1, || simulation.step(1).and_then(|()| simulation.backend().wait()))?;
            turns = [second.min(device), loops].map(repeats);
        } else {
            row.device.push(device);
            if plain {
                row.plain.push(loops);
            }
        }
    }
    Ok(row)
}

const SOFTENING_F32: f32 = 0.02;

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small whole number")]
fn repeats(seconds: f64) -> u32 {
    if seconds.is_finite() { (SPAN / seconds).clamp(1.0, 10_000.0) as u32 } else { 1 }
}

/// Seconds of one turn.
fn time(turns: u32, call: impl FnOnce() -> Result<(), Error>) -> Result<f64, Failure> {
    let start = Instant::now();
    call()?;
    Ok(start.elapsed().as_secs_f64() / f64::from(turns))
}

fn integrators(args: &BenchArgs, found: &gpu::Found) -> Result<Vec<(&'static str, usize, f64)>, Failure> {
    let mut simulations = Vec::new();
    for entry in integrators::INTEGRATORS {
        let setup = setup(INTEGRATED, entry.name)?;
        let simulation = Simulation::new(&found.device, &found.queue, &setup)?;
        let evaluations = simulation.plan().matches("gravity").count();
        simulations.push((entry.name, evaluations, simulation, Vec::new()));
    }
    for turn in 0..=args.repeat.max(1) {
        for (_, _, simulation, times) in &mut simulations {
            let steps = if turn == 0 { 1 } else { 3 };
            let took = time(steps, || simulation.step(steps).and_then(|()| simulation.backend().wait()))?;
            if turn > 0 {
                times.push(took);
            }
        }
    }
    let rows: Vec<_> =
        simulations.iter().map(|(name, evaluations, _, times)| (*name, *evaluations, median(times))).collect();
    if !args.json {
        let one = rows.iter().find(|r| r.0 == "leapfrog").map_or(1.0, |r| r.2);
        out!("\nintegrators, {INTEGRATED} bodies");
        out!("{:>18}  {:>11}  {:>12}  {:>22}", "", "evaluations", "step", "per evaluation, to\u{a0}leapfrog");
        for (name, evaluations, time) in &rows {
            out!(
                "{name:>18}  {evaluations:>11}  {:>9.2} ms  {:>22.2}",
                time * 1e3,
                time / one / (*evaluations).max(1) as f64
            );
        }
    }
    Ok(rows)
}

/// The relative error of forces against f64: median, 99th percentile, maximum.
async fn accuracy(found: &gpu::Found) -> Result<[f64; 3], Failure> {
    let setup = setup(INTEGRATED, "leapfrog")?;
    let mut simulation = Simulation::new(&found.device, &found.queue, &setup)?;
    let plans = setup.plans(simulation.backend().machine())?;
    let verdicts = lockstep::compare(simulation.backend(), &plans.step, INTEGRATED).await?;
    Ok(verdicts.iter().find(|v| v.kernel == "gravity").map_or([f64::NAN; 3], |v| v.relative))
}

fn setup(count: u32, integrator: &str) -> Result<Setup, Error> {
    let absent = |what: &str| Error::Scene(format!("there is no {what}"));
    let gravity = forces::entry("gravity").ok_or_else(|| absent("gravity"))?;
    let settings = Settings::defaults(gravity.keys).with("softening", Value::Number(SOFTENING));
    let plummer = particles::shape("plummer").ok_or_else(|| absent("plummer"))?;
    let particles: Particles =
        (plummer.build)(&Settings::defaults(plummer.keys).with("count", Value::Number(f64::from(count))))?;
    let integrator = integrators::entry(integrator).ok_or_else(|| absent(integrator))?;
    Ok(Setup {
        particles,
        forces: vec![(gravity.build)(&settings)],
        integrator: (integrator.build)(),
        dt: 1e-3,
        bounds: Bounds::default(),
    })
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied().unwrap_or(f64::NAN)
}

/// The commit, as the environment or git has it.
fn commit() -> String {
    let asked = std::env::var("MOTES_COMMIT").ok();
    let git = || {
        let output = std::process::Command::new("git").args(["rev-parse", "--short=12", "HEAD"]).output().ok()?;
        output.status.success().then(|| String::from_utf8_lossy(&output.stdout).trim().to_owned())
    };
    asked.or_else(git).unwrap_or_else(|| "unknown".to_owned())
}

impl Row {
    fn rate(&self, times: &[f64]) -> f64 {
        f64::from(self.count) * f64::from(self.count) / median(times)
    }
    /// The median of the ratios of neighbours in time.
    fn ratio(&self) -> f64 {
        median(&self.device.iter().zip(&self.plain).map(|(d, p)| p / d).collect::<Vec<_>>())
    }
    fn json(&self) -> serde_json::Value {
        json!({ "bodies": self.count, "seconds_per_step": self.device, "plain_seconds": self.plain,
            "interactions_per_second": self.rate(&self.device), "plain_interactions_per_second": self.rate(&self.plain),
            "ratio": self.ratio() })
    }
}

impl std::fmt::Display for Row {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let step = super::progress::duration(std::time::Duration::from_secs_f64(median(&self.device)));
        write!(f, "{:>9}  {step:>12}  {:>14}/s", self.count, large(self.rate(&self.device)))?;
        if !self.plain.is_empty() {
            write!(f, "  {:>14}/s  {:>7.2}", large(self.rate(&self.plain)), self.ratio())?;
        }
        Ok(())
    }
}
