//! Sheets of springs over sizes, beside plain Rust.

use std::time::Duration;

use glam::{DVec3, Vec4};
use motes::integrators::{Integrator, Step};
use motes::settings::{Settings, Value};
use motes::{Bounds, Error, POSITION, Setup, Simulation, Solver, forces, gpu, integrators, shapes};
use serde_json::json;

use crate::median;
use crate::sheet::Sheet;
use crate::words::{duration, large};
use crate::{Args, Failure};

/// That of NVIDIA Warp's benchmark of cloth: 16 steps in a sixtieth of a second.
const DT: f64 = 1.0 / 960.0;
const GRAVITY: f64 = -9.81;

struct Row {
    count: u32,
    springs: usize,
    device: Vec<f64>,
    plain: Vec<f64>,
    /// Seconds of an iteration of conjugate gradients.
    iteration: f64,
    apart: f64,
}

/// Measures sheets over sizes.
pub fn bench(args: &Args, found: &gpu::Found) -> Result<serde_json::Value, Failure> {
    if !args.json {
        println!("\nsprings: a square sheet, about 6 springs to a particle, whole steps of symplectic Euler");
        println!(
            "{:>9}  {:>9}  {:>12}  {:>12}  {:>12}  {:>20}  {:>12}  {:>7}",
            "particles", "springs", "step", "springs/s", "CG iteration", "plain Rust, 1 thread", "springs/s", "ratio"
        );
    }
    let rows = crate::sizes(
        args,
        2.0,
        |count, last| pollster::block_on(measure(args, found, count, last)),
        |r: &Row| median(&r.device),
    )?;
    let small = joined(args, found)?;
    Ok(json!({ "springs": rows.iter().map(Row::json).collect::<Vec<_>>(), "small": small }))
}

/// The symplectic Euler method with a dispatch for every kernel.
#[derive(Clone)]
struct Apart;

impl Integrator for Apart {
    fn order(&self) -> u32 {
        1
    }
    fn step(&self, s: &mut Step) {
        s.apart();
        s.evaluate();
        s.kick(1.0);
        s.drift(1.0);
    }
}

/// A small sheet, 16 steps to a frame, which launches bound: what it is worth to join kernels.
fn joined(args: &Args, found: &gpu::Found) -> Result<serde_json::Value, Failure> {
    const STEPS: u32 = 16;
    let setup = setup(1024)?;
    let apart = Setup { integrator: Box::new(Apart), ..self::setup(1024)? };
    let mut joined = Simulation::new(&found.device, &found.queue, &setup)?;
    let mut apart = Simulation::new(&found.device, &found.queue, &apart)?;
    let plans = [joined.plan(), apart.plan()].map(|plan| plan.split(" | ").count());
    let (mut with, mut without) = (Vec::new(), Vec::new());
    for turn in 0..=5 * args.repeat.max(1) {
        let frame = |simulation: &mut Simulation<motes::Gpu>| {
            crate::time(1, || simulation.step(STEPS).and_then(|()| simulation.backend().wait()))
        };
        let (a, b) = (frame(&mut joined)?, frame(&mut apart)?);
        if turn > 0 {
            with.push(a);
            without.push(b);
        }
    }
    let gain = median(&without.iter().zip(&with).map(|(b, a)| b / a).collect::<Vec<_>>());
    if !args.json {
        let text = |times: &[f64]| duration(Duration::from_secs_f64(median(times)));
        println!(
            "\n32 by 32, a frame of {STEPS} steps: {} with {} kernels to a step, {} with {} apart: {gain:.2} times faster",
            text(&with),
            plans[0],
            text(&without),
            plans[1]
        );
    }
    Ok(json!({ "particles": 1024, "steps": STEPS, "seconds": with, "kernels": plans[0], "apart_seconds": without,
        "apart_kernels": plans[1], "gain": gain }))
}

/// A square sheet of about so many particles: k 1000, damping 10, mass 0.1, as in Warp's benchmark.
fn setup(count: u32) -> Result<Setup, Failure> {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small whole number")]
    let side = f64::from(f64::from(count).sqrt().round().max(2.0) as u32);
    let cloth = shapes::shape("cloth").ok_or_else(|| Error::Scene("there is no cloth".to_owned()))?;
    let number = Value::Number;
    let settings = Settings::defaults(cloth.keys)
        .with("columns", number(side))
        .with("rows", number(side))
        .with("spacing", number(0.1))
        .with("mass", number(0.1))
        .with("stretch", number(1000.0))
        .with("shear", number(1000.0))
        .with("bend", number(1000.0))
        .with("damping", number(10.0))
        .with("jitter", number(0.05));
    let build = |name: &str, settings: &[(&'static str, Value)]| {
        let entry = forces::entry(name).ok_or_else(|| Error::Scene(format!("there is no {name}")))?;
        let all = settings.iter().fold(Settings::defaults(entry.keys), |s, (key, value)| s.with(key, value.clone()));
        Ok::<_, Failure>((entry.build)(&all))
    };
    let weight = [("acceleration", Value::Vector(DVec3::Z * GRAVITY))];
    Ok(Setup {
        state: (cloth.build)(&settings)?,
        forces: vec![build("uniform", &weight)?, build("spring", &[])?],
        integrator: Box::new(integrators::SymplecticEuler),
        dt: DT,
        bounds: Bounds::default(),
        solver: motes::Solver::default(),
    })
}

async fn measure(args: &Args, found: &gpu::Found, count: u32, last: Option<&Row>) -> Result<Row, Failure> {
    let setup = setup(count)?;
    let count = setup.check()?;
    let mut simulation = Simulation::new(&found.device, &found.queue, &setup)?;
    let mut sheet = Sheet::new(&setup.state);
    #[expect(clippy::cast_possible_truncation, reason = "the baseline is in single precision")]
    let mut step = |turns| (0..turns).for_each(|_| sheet.step(DT as f32, GRAVITY as f32));
    // That they agree is for the tests; here a slip of the bench would show.
    simulation.step(20)?;
    step(20);
    let there: Vec<Vec4> = simulation.read(POSITION).await?;
    let plain = last.is_none_or(|row| 2.0 * median(&row.plain) <= args.longest && !row.plain.is_empty());
    let (device, plain) = crate::in_turns(args, &mut simulation, if plain { Some(&mut step) } else { None })?;
    let mut again = Sheet::new(&setup.state);
    #[expect(clippy::cast_possible_truncation, reason = "the baseline is in single precision")]
    (0..20).for_each(|_| again.step(DT as f32, GRAVITY as f32));
    let apart = there.iter().zip(again.positions()).map(|(a, b)| (a.truncate() - Vec4::from(*b).truncate()).length());
    let apart = f64::from(apart.fold(0.0, f32::max));
    let (springs, iteration) = (setup.state.links.springs.len(), iteration(args, found, setup)?);
    Ok(Row { count, springs, device, plain, iteration, apart })
}

/// Seconds of an iteration of conjugate gradients: the difference of steps with many and with few, of which none converges.
fn iteration(args: &Args, found: &gpu::Found, setup: Setup) -> Result<f64, Failure> {
    const FEW: u32 = 4;
    const MANY: u32 = 24;
    // Too stiff to converge in so few.
    let mut setup = Setup { integrator: Box::new(integrators::LinearBackwardEuler), dt: 1.0, ..setup };
    let mut with = |iterations| {
        setup.solver = Solver { tolerance: 1e-6, iterations, ..Solver::default() };
        Simulation::new(&found.device, &found.queue, &setup)
    };
    let (mut few, mut many) = (with(FEW)?, with(MANY)?);
    let mut differences = Vec::new();
    for turn in 0..=args.repeat.max(1) {
        let step = |simulation: &mut Simulation<motes::Gpu>| {
            crate::time(1, || simulation.step(1).and_then(|()| simulation.backend().wait()))
        };
        let (a, b) = (step(&mut few)?, step(&mut many)?);
        if turn > 0 {
            differences.push((b - a) / f64::from(MANY - FEW));
        }
    }
    // Where it is next to nothing, noise may be more.
    Ok(median(&differences).max(0.0))
}

#[expect(clippy::cast_precision_loss, reason = "a count")]
impl Row {
    fn ratio(&self) -> f64 {
        median(&self.device.iter().zip(&self.plain).map(|(d, p)| p / d).collect::<Vec<_>>())
    }
    fn json(&self) -> serde_json::Value {
        let rate = |times: &[f64]| self.springs as f64 / median(times);
        json!({ "particles": self.count, "springs": self.springs, "seconds_per_step": self.device,
            "plain_seconds_per_step": self.plain, "springs_per_second": rate(&self.device),
            "plain_springs_per_second": rate(&self.plain), "ratio": self.ratio(), "seconds_per_iteration": self.iteration, "positions_differ": self.apart })
    }
}

#[expect(clippy::cast_precision_loss, reason = "a count")]
impl std::fmt::Display for Row {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let text = |times: &[f64]| duration(Duration::from_secs_f64(median(times)));
        let rate = |times: &[f64]| large(self.springs as f64 / median(times));
        write!(f, "{:>9}  {:>9}  {:>12}  {:>12}", self.count, self.springs, text(&self.device), rate(&self.device))?;
        write!(f, "  {:>12}", text(&[self.iteration]))?;
        if self.plain.is_empty() {
            return write!(f, "  {:>20}", "-");
        }
        write!(f, "  {:>20}  {:>12}  {:>7.2}", text(&self.plain), rate(&self.plain), self.ratio())
    }
}
