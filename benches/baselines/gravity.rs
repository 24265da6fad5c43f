//! All pairs: gravity over sizes, and the integrators.

use motes::kernel::Backend;
use motes::settings::{Settings, Value};
use motes::{Bounds, Error, Setup, Simulation, State, forces, gpu, integrators, lockstep, shapes};
use serde_json::json;

use crate::bodies::Bodies;
use crate::words::{duration, large};
use crate::{Args, Failure};
use crate::{median, time};

const SOFTENING: f64 = 0.02;
/// Bodies of the comparison of integrators.
const INTEGRATED: u32 = 4096;

struct Row {
    count: u32,
    /// Seconds of a whole step, each measurement.
    device: Vec<f64>,
    /// Seconds of the plain loop, each measurement.
    plain: Vec<f64>,
}

/// Measures all-pairs gravity over sizes, and the integrators.
pub async fn bench(args: &Args, found: &gpu::Found) -> Result<serde_json::Value, Failure> {
    if !args.json {
        println!("\nall pairs, gravity with potential, leapfrog, whole steps");
        println!("{:>9}  {:>12}  {:>16}  {:>16}  {:>7}", "bodies", "step", "device", "plain Rust", "ratio");
    }
    let rows = crate::sizes(args, 4.0, |count, last| measure(args, found, count, last), |row| median(&row.device))?;
    let integrators = integrators(args, found)?;
    let accuracy = accuracy(found).await?;
    let sizes: Vec<_> = rows.iter().map(Row::json).collect();
    let steps: Vec<_> = integrators.iter().map(|(name, evaluations, time)| json!({ "integrator": name, "evaluations": evaluations, "seconds_per_step": time })).collect();
    Ok(json!({ "softening": SOFTENING, "pairs": sizes,
        "integrators": { "bodies": INTEGRATED, "steps": steps },
        "relative_force_error": { "bodies": INTEGRATED, "median": accuracy[0], "p99": accuracy[1], "max": accuracy[2] } }))
}

fn measure(args: &Args, found: &gpu::Found, count: u32, last: Option<&Row>) -> Result<Row, Failure> {
    let setup = setup(count, "leapfrog")?;
    let mut simulation = Simulation::new(&found.device, &found.queue, &setup)?;
    let bodies: Vec<[f32; 4]> =
        setup.state.position().iter().zip(setup.state.mass()).map(|(x, m)| x.extend(*m).as_vec4().to_array()).collect();
    let bodies = Bodies::new(&bodies);
    let plain = last.is_none_or(|row| 4.0 * median(&row.plain) <= args.longest && !row.plain.is_empty());
    let mut baseline = |turns| (0..turns).for_each(|_| drop(std::hint::black_box(bodies.evaluate(SOFTENING_F32))));
    let (device, plain) = crate::in_turns(args, &mut simulation, plain.then_some(&mut baseline))?;
    Ok(Row { count, device, plain })
}

const SOFTENING_F32: f32 = 0.02;

fn integrators(args: &Args, found: &gpu::Found) -> Result<Vec<(&'static str, usize, f64)>, Failure> {
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
        println!("\nintegrators, {INTEGRATED} bodies");
        println!("{:>18}  {:>11}  {:>12}  {:>22}", "", "evaluations", "step", "per evaluation, to\u{a0}leapfrog");
        for (name, evaluations, time) in &rows {
            println!(
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
    let plummer = shapes::shape("plummer").ok_or_else(|| absent("plummer"))?;
    let particles: State =
        (plummer.build)(&Settings::defaults(plummer.keys).with("count", Value::Number(f64::from(count))))?;
    let integrator = integrators::entry(integrator).ok_or_else(|| absent(integrator))?;
    Ok(Setup {
        state: particles,
        forces: vec![(gravity.build)(&settings)],
        integrator: integrator.by_default(),
        dt: 1e-3,
        bounds: Bounds::default(),
        solver: motes::Solver::default(),
    })
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
        let step = duration(std::time::Duration::from_secs_f64(median(&self.device)));
        write!(f, "{:>9}  {step:>12}  {:>14}/s", self.count, large(self.rate(&self.device)))?;
        if !self.plain.is_empty() {
            write!(f, "  {:>14}/s  {:>7.2}", large(self.rate(&self.plain)), self.ratio())?;
        }
        Ok(())
    }
}
