//! Gravity through a tree over sizes, beside all pairs: time, what the build takes of it, and how far forces are off.

use std::time::Duration;

use glam::Vec4;
use motes::kernel::{Backend, Plan, Problem};
use motes::settings::{Settings, Value};
use motes::tree::{Opening, Tree};
use motes::{ACCELERATION, Bounds, Error, Gpu, POSITION, Setup, Simulation, forces, gpu, integrators, shapes};
use serde_json::json;

use crate::effort::{Effort, effort};
use crate::words::{duration, large};
use crate::{Args, Failure};
use crate::{direct, median, repeats, scaling, time};

const SOFTENING: f64 = 0.02;

/// Bodies that are measured.
struct Set {
    name: &'static str,
    shape: &'static str,
    values: &'static [(&'static str, f64)],
}

const SETS: [Set; 3] = [
    Set { name: "plummer", shape: "plummer", values: &[] },
    Set { name: "cusp", shape: "hernquist", values: &[] },
    Set { name: "disk", shape: "disk", values: &[("halo_mass", 0.0), ("disk_height", 0.05)] },
];

/// How the tree is opened, and what it knows of far groups.
struct Variant {
    name: &'static str,
    theta: f64,
    alpha: f64,
    multipoles: &'static str,
}

const VARIANTS: [Variant; 4] = [
    Variant { name: "θ 0.7", theta: 0.7, alpha: 0.0, multipoles: "quadrupole" },
    Variant { name: "θ 0.5", theta: 0.5, alpha: 0.0, multipoles: "quadrupole" },
    Variant { name: "θ 0.5 monopole", theta: 0.5, alpha: 0.0, multipoles: "monopole" },
    Variant { name: "α 0.005", theta: 0.5, alpha: 0.005, multipoles: "quadrupole" },
];

/// What one variant does with so many bodies.
struct Walk {
    /// Seconds of a whole step, each measurement.
    seconds: Vec<f64>,
    /// Seconds of building the tree alone, each measurement.
    build: Vec<f64>,
    /// Of its forces: median, 99th percentile, maximum.
    error: [f64; 3],
    /// What targets meet.
    effort: Effort,
}

/// One set at one size.
struct Row {
    count: u32,
    walks: Vec<Walk>,
    /// Seconds of a whole step of all pairs, each measurement.
    pairs: Vec<f64>,
}

/// Measures the tree over sets and sizes.
pub fn bench(args: &Args, found: &gpu::Found) -> Result<serde_json::Value, Failure> {
    let mut sets = Vec::new();
    for set in &SETS {
        if !args.json {
            println!("\ntree, gravity with potential, {}, leapfrog, whole steps", set.name);
            println!(
                "{:>9}  {:>14}  {:>12}  {:>14}  {:>6}  {:>28}  {:>7}  {:>12}  {:>7}",
                "bodies",
                "",
                "step",
                "bodies/s",
                "build",
                "force error, median 99 % max",
                "ratio",
                "met (mean)",
                "largest"
            );
        }
        let measure = |count, last: Option<&Row>| pollster::block_on(measure(args, found, set, count, last));
        let rows = crate::sizes(args, 2.3, measure, Row::slowest)?;
        if !args.json {
            for (n, variant) in VARIANTS.iter().enumerate() {
                println!("{:>25}  {}", variant.name, verdict(&rows, n));
            }
        }
        sets.push(json(set, &rows));
    }
    Ok(json!({ "softening": SOFTENING, "tree": sets }))
}

/// A simulation that is measured in turn with others.
struct Runner {
    simulation: Simulation<Gpu>,
    turns: u32,
    seconds: Vec<f64>,
}

impl Runner {
    fn new(found: &gpu::Found, setup: &Setup) -> Result<Self, Failure> {
        let simulation = Simulation::new(&found.device, &found.queue, setup)?;
        Ok(Self { simulation, turns: 1, seconds: Vec::new() })
    }
    fn run(&mut self) -> Result<f64, Failure> {
        let (turns, simulation) = (self.turns, &mut self.simulation);
        time(turns, || simulation.step(turns).and_then(|()| simulation.backend().wait()))
    }
}

async fn measure(args: &Args, found: &gpu::Found, set: &Set, count: u32, last: Option<&Row>) -> Result<Row, Failure> {
    let mut runners = Vec::new();
    let mut setup = setup(set, count)?;
    for variant in &VARIANTS {
        setup.forces = vec![gravity("tree", variant)?];
        runners.push(Runner::new(found, &setup)?);
    }
    setup.forces = vec![gravity("pairs", &VARIANTS[0])?];
    let expected = match last {
        Some(row) if row.pairs.is_empty() => f64::INFINITY,
        Some(row) => 4.0 * median(&row.pairs),
        None => probe(found, set, count)?,
    };
    if expected <= args.longest {
        runners.push(Runner::new(found, &setup)?);
    }
    // All take turns, so that what else the machine does falls on each. The first turn warms, the second tells how long.
    for runner in &mut runners {
        runner.run()?;
        runner.turns = repeats(runner.run()?);
    }
    for _ in 0..args.repeat.max(1) {
        for runner in &mut runners {
            let seconds = runner.run()?;
            runner.seconds.push(seconds);
        }
    }
    let mut walks = Vec::new();
    for (variant, runner) in VARIANTS.iter().zip(&mut runners) {
        let build = build(args, variant, &setup, &mut runner.simulation)?;
        let bodies: Vec<Vec4> = runner.simulation.read(POSITION).await?;
        let accelerations: Vec<Vec4> = runner.simulation.read(ACCELERATION).await?;
        let error = direct::errors(&bodies, &accelerations, SOFTENING);
        let problem = problem(&setup, &mut runner.simulation)?;
        let effort = effort(variant.opening(), &problem, &mut runner.simulation).await?;
        walks.push(Walk { seconds: std::mem::take(&mut runner.seconds), build, error, effort });
    }
    let pairs = runners.get_mut(VARIANTS.len()).map(|runner| std::mem::take(&mut runner.seconds));
    Ok(Row { count, walks, pairs: pairs.unwrap_or_default() })
}

/// About how many seconds a step of all pairs takes: by what few take, where there are many.
fn probe(found: &gpu::Found, set: &Set, count: u32) -> Result<f64, Failure> {
    const FEW: u32 = 8192;
    if count <= FEW {
        return Ok(0.0);
    }
    let few = Setup { forces: vec![gravity("pairs", &VARIANTS[0])?], ..setup(set, FEW)? };
    let mut runner = Runner::new(found, &few)?;
    runner.run()?;
    Ok(runner.run()? * (f64::from(count) / f64::from(FEW)).powi(2))
}

impl Variant {
    fn opening(&self) -> Opening {
        let theta = self.theta;
        match self.alpha {
            alpha if alpha > 0.0 => Opening::Relative { alpha, g: 1.0, theta },
            _ => Opening::Geometric { theta },
        }
    }
}

fn problem(setup: &Setup, simulation: &mut Simulation<Gpu>) -> Result<Problem, Error> {
    Ok(Problem::new(setup.check()?, simulation.backend().machine()).at(setup.state.position(), setup.bounds))
}

/// Seconds of building the tree, without the walk.
fn build(args: &Args, variant: &Variant, setup: &Setup, simulation: &mut Simulation<Gpu>) -> Result<Vec<f64>, Failure> {
    let problem = problem(setup, simulation)?;
    let mut plan = Plan::default();
    Tree::new(variant.opening(), 0.0, &problem).kernels(&problem)?.into_iter().for_each(|kernel| plan.add(kernel));
    let backend = simulation.backend();
    let program = backend.compile(&plan)?;
    let mut run = |turns| time(turns, || backend.run(&program, turns).and_then(|()| backend.wait()));
    run(1)?;
    let turns = repeats(run(1)?);
    (0..args.repeat.max(1)).map(|_| run(turns)).collect()
}

fn absent(what: &str) -> Error {
    Error::Scene(format!("there is no {what}"))
}

fn gravity(over: &'static str, variant: &Variant) -> Result<Box<dyn forces::Component>, Error> {
    let entry = forces::entry("gravity").ok_or_else(|| absent("gravity"))?;
    let settings = Settings::defaults(entry.keys)
        .with("softening", Value::Number(SOFTENING))
        .with("over", Value::Text(over.into()))
        .with("theta", Value::Number(variant.theta))
        .with("alpha", Value::Number(variant.alpha))
        .with("multipoles", Value::Text(variant.multipoles.into()));
    Ok((entry.build)(&settings))
}

/// Without forces as yet.
fn setup(set: &Set, count: u32) -> Result<Setup, Error> {
    let shape = shapes::shape(set.shape).ok_or_else(|| absent(set.shape))?;
    let start = Settings::defaults(shape.keys).with("count", Value::Number(f64::from(count)));
    let settings = set.values.iter().fold(start, |all, (key, x)| all.with(key, Value::Number(*x)));
    Ok(Setup {
        state: (shape.build)(&settings)?,
        forces: Vec::new(),
        integrator: Box::new(integrators::Leapfrog),
        dt: 1e-3,
        bounds: Bounds::default(),
        solver: motes::Solver::default(),
    })
}

impl Row {
    /// Seconds of a step of the slowest variant.
    fn slowest(&self) -> f64 {
        self.walks.iter().map(|walk| median(&walk.seconds)).fold(0.0, f64::max)
    }
    /// How many times as long as a variant all pairs take: the median over neighbours in time.
    fn ratio(&self, variant: usize) -> f64 {
        median(&self.pairs.iter().zip(&self.walks[variant].seconds).map(|(p, t)| p / t).collect::<Vec<_>>())
    }
}

/// From how many bodies on a variant is faster than all pairs, where that is among these sizes.
fn crossing(rows: &[Row], variant: usize) -> Option<f64> {
    let measured = rows.iter().filter(|row| !row.pairs.is_empty());
    scaling::crossing(&measured.map(|row| (f64::from(row.count), row.ratio(variant))).collect::<Vec<_>>())
}

/// The power of the number of bodies with which a step of a variant grows at the end.
fn growth(rows: &[Row], variant: usize) -> Option<f64> {
    let seconds = |row: &Row| (f64::from(row.count), median(&row.walks[variant].seconds));
    scaling::growth(&rows.iter().map(seconds).collect::<Vec<_>>())
}

fn verdict(rows: &[Row], variant: usize) -> String {
    let crossing = match crossing(rows, variant) {
        Some(count) => format!("faster than all pairs from {} bodies on", large(count)),
        None => "no crossing with all pairs among these sizes".to_owned(),
    };
    let growth = growth(rows, variant).map(|p| format!("; a step grows as N^{p:.2} at the end"));
    crossing + &growth.unwrap_or_default()
}

fn json(set: &Set, rows: &[Row]) -> serde_json::Value {
    let variants = VARIANTS.iter().enumerate().map(|(n, variant)| {
        let sizes: Vec<_> = rows.iter().map(|row| size(row, n)).collect();
        json!({ "name": variant.name, "theta": variant.theta, "alpha": variant.alpha, "multipoles": variant.multipoles,
            "crossing": crossing(rows, n), "growth": growth(rows, n), "sizes": sizes })
    });
    let pairs = rows.iter().filter(|row| !row.pairs.is_empty());
    let pairs: Vec<_> = pairs.map(|row| json!({ "bodies": row.count, "seconds_per_step": row.pairs })).collect();
    json!({ "set": set.name, "shape": set.shape, "variants": variants.collect::<Vec<_>>(), "pairs": pairs })
}

fn size(row: &Row, variant: usize) -> serde_json::Value {
    let Walk { seconds, build, error: [middle, p99, max], effort } = &row.walks[variant];
    json!({ "bodies": row.count, "seconds_per_step": seconds, "seconds_per_build": build,
        "bodies_per_second": f64::from(row.count) / median(seconds), "ratio": row.ratio(variant),
        "met_per_target": { "mean": effort.mean, "largest": effort.largest, "largest_by_mean": effort.ratio() },
        "relative_force_error": { "median": middle, "p99": p99, "max": max } })
}

impl std::fmt::Display for Row {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let text = |times: &[f64]| duration(Duration::from_secs_f64(median(times)));
        let rate = |times: &[f64]| large(f64::from(self.count) / median(times));
        write!(f, "{:>9}  {:>14}", self.count, "all pairs")?;
        if self.pairs.is_empty() {
            write!(f, "  {:>12}", "-")?;
        } else {
            write!(f, "  {:>12}  {:>14}", text(&self.pairs), rate(&self.pairs))?;
        }
        for (n, (variant, walk)) in VARIANTS.iter().zip(&self.walks).enumerate() {
            let share = 100.0 * median(&walk.build) / median(&walk.seconds);
            let [middle, p99, max] = walk.error;
            write!(f, "\n{:>25}  {:>12}  {:>14}", variant.name, text(&walk.seconds), rate(&walk.seconds))?;
            write!(f, "  {share:>4.0} %  {middle:>10.1e} {p99:>8.1e} {max:>8.1e}")?;
            if self.pairs.is_empty() {
                write!(f, "  {:>7}", "")?;
            } else {
                write!(f, "  {:>7.2}", self.ratio(n))?;
            }
            write!(f, "  {:>12.0}  {:>6.2}x", walk.effort.mean, walk.effort.ratio())?;
        }
        Ok(())
    }
}
