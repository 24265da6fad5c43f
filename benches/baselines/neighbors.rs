//! Searches for neighbours: circles and boids over sizes, beside plain Rust, and beside the search by force.

use std::time::Duration;

use glam::{DVec3, Vec4};
use motes::forces::{self, Component, Law, Over};
use motes::kernel::Source;
use motes::measure::Flock;
use motes::neighbors::Cells;
use motes::settings::{Settings, Value};
use motes::shapes::random::Random;
use motes::{Bounds, Error, POSITION, Setup, Side, Simulation, State, gpu, integrators};
use serde_json::json;

use crate::agents::{Agents, RADIUS};
use crate::words::{duration, large};
use crate::{Args, Failure};
use crate::{median, time};

const DT: f64 = 0.01;
/// Agents of the comparison with the search by force.
const FORCED: u32 = 100_000;

/// FLAME GPU's benchmark of neighbours, one agent per unit of volume.
#[derive(Clone)]
struct Circles(Over);

impl Component for Circles {
    fn laws(&self) -> Vec<Law> {
        let source = Source::ours("benches/circles.wgsl", include_str!("../circles.wgsl"));
        vec![Law::between("circles", self.0, source, Vec::new(), |_, _, r| {
            let separation = r.length();
            let k = (-std::f64::consts::PI * separation).sin() * 0.05;
            (k / separation.max(1e-12) * r).extend(0.0)
        })]
    }
}

struct Row {
    count: u32,
    device: Vec<f64>,
    plain: Vec<f64>,
    /// Others in the cells around an agent, and others within range, on average.
    candidates: f64,
    neighbors: f64,
}

/// Measures searches over sizes.
pub async fn bench(args: &Args, found: &gpu::Found) -> Result<serde_json::Value, Failure> {
    let header = |what: &str| {
        if !args.json {
            println!("\n{what}, whole steps");
            println!(
                "{:>9}  {:>12}  {:>14}  {:>14}  {:>16}  {:>16}  {:>7}",
                "agents", "step", "agents/s", "candidates/s", "plain Rust, step", "near, candidates", "ratio"
            );
        }
    };
    header("circles: radius 2, one agent per unit of volume");
    let circles = crate::sizes(
        args,
        2.0,
        |count, last| measure(args, found, &circles(count), last, true),
        |r| median(&r.device),
    )?;
    header("boids: about 7 neighbours");
    let boids = crate::sizes(
        args,
        2.0,
        |count, last| measure(args, found, &boids(count)?, last, false),
        |r| median(&r.device),
    )?;
    let forced = forced(args, found).await?;
    Ok(json!({ "circles": circles.iter().map(Row::json).collect::<Vec<_>>(),
        "boids": boids.iter().map(Row::json).collect::<Vec<_>>(), "by_force": forced }))
}

fn scattered(count: u32, side: f64, speed: f64) -> State {
    let mut random = Random::new(42);
    let mut particles = State::default();
    for _ in 0..count {
        let mut vector = || DVec3::new(random.uniform(), random.uniform(), random.uniform());
        let (x, v) = (vector() * side, (vector() - 0.5) * speed);
        particles.push(x.as_vec3().as_dvec3(), v.as_vec3().as_dvec3(), 1.0, 0.0);
    }
    particles
}

fn setup(particles: State, force: Box<dyn Component>, bounds: Bounds) -> Setup {
    Setup {
        state: particles,
        forces: vec![force],
        integrator: Box::new(integrators::SymplecticEuler),
        dt: DT,
        bounds,
        solver: motes::Solver::default(),
    }
}

fn circles(count: u32) -> (Setup, f64) {
    let side = f64::from(count).cbrt();
    let bounds = Bounds::new(DVec3::ZERO, DVec3::splat(side), Side::Reflecting);
    let over = Over::Near { range: f64::from(RADIUS), of: None };
    (setup(scattered(count, side, 0.0), Box::new(Circles(over)), bounds), f64::from(RADIUS))
}

/// 7 neighbours: 4/3 π range³ agents in one unit of volume.
fn boids(count: u32) -> Result<(Setup, f64), Failure> {
    let entry = forces::entry("boids").ok_or_else(|| Error::Scene("there are no boids".to_owned()))?;
    let range = (7.0 * 0.75 / std::f64::consts::PI).cbrt();
    let settings = Settings::defaults(entry.keys).with("range", Value::Number(range));
    let side = f64::from(count).cbrt();
    let bounds = Bounds::new(DVec3::ZERO, DVec3::splat(side), Side::Periodic);
    Ok((setup(scattered(count, side, 2.0), (entry.build)(&settings), bounds), range))
}

fn measure(
    args: &Args,
    found: &gpu::Found,
    (setup, range): &(Setup, f64),
    last: Option<&Row>,
    plain: bool,
) -> Result<Row, Failure> {
    let count = setup.check()?;
    let mut simulation = Simulation::new(&found.device, &found.queue, setup)?;
    let side = setup.bounds.high.x;
    let positions = setup.state.position().iter().map(|x| x.as_vec3().to_array()).collect();
    #[expect(clippy::cast_possible_truncation, reason = "the baseline is in single precision")]
    let mut agents = Agents::new(positions, side as f32);
    let plain = plain && last.is_none_or(|row| 2.0 * median(&row.plain) <= args.longest && !row.plain.is_empty());
    let (candidates, neighbors) = numbers(setup, *range)?;
    #[expect(clippy::cast_possible_truncation, reason = "the baseline is in single precision")]
    let mut baseline = |turns| {
        (0..turns).for_each(|_| agents.step(DT as f32));
        std::hint::black_box(agents.positions());
    };
    let (device, plain) = crate::in_turns(args, &mut simulation, plain.then_some(&mut baseline))?;
    Ok(Row { count, device, plain, candidates, neighbors })
}

/// Candidates and neighbours of an agent, on average.
fn numbers(setup: &Setup, range: f64) -> Result<(f64, f64), Failure> {
    let cells = Cells::new(setup.state.position(), setup.bounds, range)?;
    Ok((cells.candidates(), Flock::of(&setup.state, setup.bounds, Some(range), None)?.neighbors))
}

/// The search by force, at one size: how much longer it takes, and how much longer it should by what both look at.
async fn forced(args: &Args, found: &gpu::Found) -> Result<serde_json::Value, Failure> {
    let count = FORCED.clamp(args.from, args.to.max(args.from));
    let (mut setup, range) = circles(count);
    let (candidates, _) = numbers(&setup, range)?;
    let mut near = Simulation::new(&found.device, &found.queue, &setup)?;
    setup.forces = vec![Box::new(Circles(Over::Within { range }))];
    let mut force = Simulation::new(&found.device, &found.queue, &setup)?;
    let (mut times, mut by_force) = (Vec::new(), Vec::new());
    for turn in 0..=args.repeat.clamp(1, 3) {
        let one = |simulation: &mut Simulation<motes::Gpu>| {
            time(1, || simulation.step(1).and_then(|()| simulation.backend().wait()))
        };
        let (a, b) = (one(&mut near)?, one(&mut force)?);
        if turn > 0 {
            times.push(a);
            by_force.push(b);
        }
    }
    // That they agree is for the tests; here a slip of the bench would show.
    let (a, b): (Vec<Vec4>, Vec<Vec4>) = (near.read(POSITION).await?, force.read(POSITION).await?);
    let apart = a.iter().zip(&b).map(|(a, b)| f64::from((*a - *b).length())).fold(0.0, f64::max);
    let (predicted, measured) = (f64::from(count) / candidates, median(&by_force) / median(&times));
    if !args.json {
        let text = |times: &[f64]| duration(Duration::from_secs_f64(median(times)));
        println!(
            "\n{count} agents by force: {}, through the grid {}: {measured:.0} times faster; by what both look at, {predicted:.0} times\n\
             (positions after {} steps differ by {apart:.1e} at most)",
            text(&by_force),
            text(&times),
            near.steps()
        );
    }
    Ok(json!({ "agents": count, "seconds_per_step": by_force, "near_seconds_per_step": times,
        "ratio": measured, "predicted_ratio": predicted, "positions_differ": apart }))
}

impl Row {
    fn ratio(&self) -> f64 {
        median(&self.device.iter().zip(&self.plain).map(|(d, p)| p / d).collect::<Vec<_>>())
    }
    fn json(&self) -> serde_json::Value {
        let step = median(&self.device);
        json!({ "agents": self.count, "seconds_per_step": self.device, "plain_seconds_per_step": self.plain,
            "candidates": self.candidates, "neighbors": self.neighbors,
            "candidates_per_second": self.candidates * f64::from(self.count) / step,
            "agents_per_second": f64::from(self.count) / step, "ratio": self.ratio() })
    }
}

impl std::fmt::Display for Row {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let text = |times: &[f64]| duration(Duration::from_secs_f64(median(times)));
        let rate = f64::from(self.count) / median(&self.device);
        write!(
            f,
            "{:>9}  {:>12}  {:>14}  {:>14}",
            self.count,
            text(&self.device),
            large(rate),
            large(rate * self.candidates)
        )?;
        let plain = if self.plain.is_empty() { "-".to_owned() } else { text(&self.plain) };
        write!(f, "  {plain:>16}  {:>7.1}, {:>7.1}", self.neighbors, self.candidates)?;
        if !self.plain.is_empty() {
            write!(f, "  {:>7.2}", self.ratio())?;
        }
        Ok(())
    }
}
