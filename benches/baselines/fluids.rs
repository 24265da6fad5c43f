//! A weakly compressible fluid over sizes, beside plain Rust: whole steps, and the sweep of pressure alone.

use std::time::Duration;

use glam::DVec3;
use motes::forces;
use motes::kernel::{Backend, Plan};
use motes::neighbors::Cells;
use motes::settings::{Settings, Value};
use motes::shapes::random::Random;
use motes::sph::{Form, Friction, Medium, Smoothing};
use motes::{Bounds, Error, POSITION, Setup, Side, Simulation, State, gpu, integrators};
use serde_json::json;

use crate::water::Water;
use crate::words::{duration, large};
use crate::{Args, Failure};
use crate::{median, time};

/// A tenth of what sound lets through.
const DT: f64 = 0.002;
const SOUND: f64 = 10.0;
const ALPHA: f64 = 0.1;
/// The name of each case, its support in spacings and its kernel: 33 and 113 neighbours.
const CASES: [(&str, f64, &str); 2] = [("33", 2.0, "cubic"), ("113", 3.0, "wendland")];

struct Row {
    count: u32,
    device: Vec<f64>,
    plain: Vec<f64>,
    /// Of the sweep that adds pressure, alone.
    sweep: Vec<f64>,
    candidates: f64,
    neighbors: f64,
    /// How far positions of the device and the baseline are apart after the last turn they both did, at most.
    apart: f64,
}

/// Measures the cases over sizes.
pub fn bench(args: &Args, found: &gpu::Found) -> Result<serde_json::Value, Failure> {
    let mut cases = serde_json::Map::new();
    for (name, support, kernel) in CASES {
        if !args.json {
            println!("\nfluid: density by summation, {kernel}, support of {support} spacings, jittered; whole steps");
            println!(
                "{:>9}  {:>12}  {:>14}  {:>12}  {:>14}  {:>16}  {:>16}  {:>7}",
                "particles",
                "step",
                "particles/s",
                "one sweep",
                "pairs/s in it",
                "plain Rust, step",
                "near, candidates",
                "ratio"
            );
        }
        let measure = |count, last: Option<&Row>| measure(args, found, count, (support, kernel), last);
        let rows = crate::sizes(args, 2.0, measure, |row| median(&row.device))?;
        cases.insert(name.to_owned(), rows.iter().map(Row::json).collect());
    }
    Ok(json!({ "fluids": cases }))
}

/// A jittered lattice in a periodic cube of unit spacing, as many as fit best.
fn setup(count: u32, support: f64, kernel: &'static str) -> Result<(Setup, Medium), Failure> {
    let number = f64::from(count).cbrt().round().max(3.0 * support);
    let mut random = Random::new(42);
    let mut particles = State::default();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small whole number")]
    let line = || (0..number as u32).map(f64::from);
    for z in line() {
        for y in line() {
            for x in line() {
                let jitter = DVec3::new(random.uniform(), random.uniform(), random.uniform()) * 0.4 - 0.2;
                let place = DVec3::new(x, y, z) + 0.5 + jitter;
                particles.push(place.as_vec3().as_dvec3(), DVec3::ZERO, 1.0, 0.0);
            }
        }
    }
    let entry = forces::entry("fluid").ok_or_else(|| Error::Scene("there is no fluid".to_owned()))?;
    let settings = Settings::defaults(entry.keys)
        .with("density", Value::Number(1.0))
        .with("spacing", Value::Number(1.0))
        .with("support", Value::Number(support))
        .with("kernel", Value::Text(kernel.into()))
        .with("sound_speed", Value::Number(SOUND))
        .with("alpha", Value::Number(ALPHA));
    let setup = Setup {
        state: particles,
        forces: vec![(entry.build)(&settings)],
        integrator: Box::new(integrators::SymplecticEuler),
        dt: DT,
        bounds: Bounds::new(DVec3::ZERO, DVec3::splat(number), Side::Periodic),
        solver: motes::Solver::default(),
    };
    let medium = Medium {
        density: 1.0,
        spacing: 1.0,
        support,
        smoothing: Smoothing::named(kernel),
        sound: SOUND,
        exponent: 7,
        negative: false,
        dimensions: 3,
    };
    Ok((setup, medium))
}

fn measure(
    args: &Args,
    found: &gpu::Found,
    count: u32,
    (support, kernel): (f64, &'static str),
    last: Option<&Row>,
) -> Result<Row, Failure> {
    let (setup, medium) = setup(count, support, kernel)?;
    let count = setup.check()?;
    let friction = Friction { alpha: ALPHA, viscosity: 0.0, form: Form::Central, wall: 1.0 };
    let mut simulation = Simulation::new(&found.device, &found.queue, &setup)?;
    let positions: Vec<_> = setup.state.position().iter().map(|x| x.as_vec3().to_array()).collect();
    let mut water = Water::new(positions, setup.bounds.high.x, &medium, friction);
    let plain = last.is_none_or(|row| 2.0 * median(&row.plain) <= args.longest && !row.plain.is_empty());
    let apart = if plain { apart(&mut simulation, &mut water)? } else { f64::NAN };
    #[expect(clippy::cast_possible_truncation, reason = "the baseline is in single precision")]
    let mut baseline = |turns| {
        (0..turns).for_each(|_| water.step(DT as f32));
        std::hint::black_box(water.positions());
    };
    let (device, plain) = crate::in_turns(args, &mut simulation, plain.then_some(&mut baseline))?;
    let sweep = sweep(args, &mut simulation, &setup)?;
    let cells = Cells::new(setup.state.position(), setup.bounds, medium.range())?;
    let mut neighbors = 0_u64;
    let sample = (0..count as usize).step_by((count as usize / 1000).max(1));
    let asked = sample.clone().count();
    sample.for_each(|i| cells.around(i, |_| neighbors += 1));
    let neighbors = neighbors as f64 / asked as f64;
    Ok(Row { count, device, plain, sweep, candidates: cells.candidates(), neighbors, apart })
}

/// Three steps of both: a slip of the bench would show.
fn apart(simulation: &mut Simulation<motes::Gpu>, water: &mut Water) -> Result<f64, Failure> {
    simulation.step(3)?;
    #[expect(clippy::cast_possible_truncation, reason = "the baseline is in single precision")]
    (0..3).for_each(|_| water.step(DT as f32));
    let there = pollster::block_on(simulation.read(POSITION))?;
    let far = there.iter().zip(water.positions()).map(|(a, b)| {
        let r = a.truncate() - glam::Vec3::from_array(*b);
        f64::from(r.abs().max_element().min(1.0))
    });
    Ok(far.fold(0.0, f64::max))
}

/// Seconds of the sweep of pressure over the grid as the last step left it.
fn sweep(args: &Args, simulation: &mut Simulation<motes::Gpu>, setup: &Setup) -> Result<Vec<f64>, Failure> {
    let gpu = simulation.backend();
    let problem = setup.problem(gpu.machine())?;
    let mut plan = Plan::default();
    let mut laws = setup.forces.iter().flat_map(|force| force.laws());
    let pressure = laws.find(|law| law.name == "fluid pressure").expect("a fluid has pressure");
    plan.add(pressure.kernel(&problem)?);
    let program = gpu.compile(&plan)?;
    let mut run = |turns| time(turns, || gpu.run(&program, turns).and_then(|()| gpu.wait()));
    let turns = crate::repeats(run(1)?.min(run(1)?));
    (0..args.repeat.max(1)).map(|_| run(turns)).collect()
}

impl Row {
    fn ratio(&self) -> f64 {
        median(&self.device.iter().zip(&self.plain).map(|(d, p)| p / d).collect::<Vec<_>>())
    }
    fn json(&self) -> serde_json::Value {
        let (step, sweep, count) = (median(&self.device), median(&self.sweep), f64::from(self.count));
        json!({ "particles": self.count, "neighbors": self.neighbors, "candidates": self.candidates,
            "seconds_per_step": self.device, "plain_seconds_per_step": self.plain, "ratio": self.ratio(),
            "particle_steps_per_second": count / step, "seconds_per_sweep": self.sweep,
            "pairs_per_second_in_sweep": count * self.neighbors / sweep, "positions_differ": self.apart })
    }
}

impl std::fmt::Display for Row {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let text = |times: &[f64]| duration(Duration::from_secs_f64(median(times)));
        let count = f64::from(self.count);
        write!(
            f,
            "{:>9}  {:>12}  {:>14}  {:>12}  {:>14}",
            self.count,
            text(&self.device),
            large(count / median(&self.device)),
            text(&self.sweep),
            large(count * self.neighbors / median(&self.sweep))
        )?;
        let plain = if self.plain.is_empty() { "-".to_owned() } else { text(&self.plain) };
        write!(f, "  {plain:>16}  {:>7.1}, {:>7.1}", self.neighbors, self.candidates)?;
        if !self.plain.is_empty() {
            write!(f, "  {:>7.2}", self.ratio())?;
        }
        Ok(())
    }
}
