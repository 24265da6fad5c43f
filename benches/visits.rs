//! Which visit finds neighbours the fastest: the cell list of each step, or a list that is kept, with several skins.
//!
//! `cargo bench --bench visits -- 32000` takes so many particles; whole steps in turns. Where the system tells it, times are those of
//! the processors, all threads of the driver together, so that other work on the machine counts little; ratios are medians over turns of
//! one visit's time by that of the cell list in the same turn.
#![allow(missing_docs, reason = "a program")]

use std::time::Instant;

use glam::DVec3;
use motes::forces::{self, Component, Law, Over, Problem};
use motes::gpu::{self, Gpu};
use motes::kernel::Source;
use motes::neighbors::{Cells, LIST_STATE};
use motes::settings::{Settings, Value};
use motes::shapes::random::Random;
use motes::{Bounds, Setup, Side, Simulation, State, integrators};

/// Skins, as parts of the range.
const SKINS: [f64; 3] = [0.06, 0.15, 0.3];
/// Seconds of one turn, about, and turns.
const SPAN: f64 = 0.6;
const TURNS: usize = 5;

/// A law of one of the files beside this one.
#[derive(Clone)]
struct Own(&'static str, &'static str, Over);

impl Component for Own {
    fn laws(&self) -> Vec<Law> {
        // The reference is no part of this.
        vec![Law::between(self.0, self.2, Source::ours("benches", self.1), Vec::new(), |_, _, _| glam::DVec4::ZERO)]
    }
}

struct System {
    name: &'static str,
    range: f64,
    dt: f64,
    /// Steps before it is measured: a liquid has melted then.
    warm: u32,
    state: State,
    bounds: Bounds,
    force: Box<dyn Fn(Over) -> Box<dyn Component>>,
}

impl System {
    fn setup(&self, over: Over) -> Setup {
        Setup {
            state: self.state.clone(),
            forces: vec![(self.force)(over)],
            integrator: Box::new(integrators::SymplecticEuler),
            dt: self.dt,
            bounds: self.bounds,
            solver: motes::Solver::default(),
        }
    }
}

/// A jittered lattice at one particle per unit of volume, or scattered; with speeds up to a half of `speed` along each axis.
fn particles(count: u32, spacing: f64, jitter: f64, speed: f64) -> (State, Bounds) {
    let mut random = Random::new(42);
    let mut vector = || DVec3::new(random.uniform(), random.uniform(), random.uniform()) - 0.5;
    let side = f64::from(count).cbrt().ceil();
    let mut state = State::default();
    for i in 0..count {
        let i = f64::from(i);
        let cell = DVec3::new(i % side, (i / side).floor() % side, (i / side / side).floor());
        let x = spacing * (cell + 0.5 + jitter * vector());
        state.push(x.as_vec3().as_dvec3(), (speed * vector()).as_vec3().as_dvec3(), 1.0, 0.0);
    }
    (state, Bounds::new(DVec3::ZERO, DVec3::splat(spacing * side), Side::Periodic))
}

fn systems(count: u32) -> Vec<System> {
    let own = |name, text| -> Box<dyn Fn(Over) -> Box<dyn Component>> {
        Box::new(move |over| Box::new(Own(name, text, over)))
    };
    let circles = own("circles", include_str!("circles.wgsl"));
    let density = own("density", include_str!("density.wgsl"));
    let lennard_jones = own("lennard_jones", include_str!("lennard_jones.wgsl"));
    // The range within which so many are, at one particle per unit of volume.
    let range = |neighbors: f64| (neighbors * 0.75 / std::f64::consts::PI).cbrt();
    let boids = |over: Over| -> Box<dyn Component> {
        let entry = forces::entry("boids").expect("boids");
        let settings = Settings::defaults(entry.keys).with("range", Value::Number(over.range().unwrap_or(1.0)));
        let settings = match over {
            Over::List { skin, .. } => {
                settings.with("over", Value::Text("list".into())).with("skin", Value::Number(skin.unwrap_or(0.0)))
            }
            _ => settings,
        };
        (entry.build)(&settings)
    };
    // Weakly compressible, with a speed of sound of some ten times the fastest particles.
    let water = |more: &'static [(&'static str, &'static str)]| -> Box<dyn Fn(Over) -> Box<dyn Component>> {
        Box::new(move |over| {
            let entry = forces::entry("fluid").expect("fluids");
            let numbers = [("density", 1.0), ("spacing", 1.0), ("sound_speed", 10.0), ("alpha", 0.1)];
            // The range is the support in spacings of 1.
            let support = [("support", over.range().unwrap_or(2.0))];
            let fill = |settings: Settings, (key, value): (&'static str, f64)| settings.with(key, Value::Number(value));
            let settings = numbers.into_iter().chain(support).fold(Settings::defaults(entry.keys), fill);
            let settings = more.iter().fold(settings, |all, (key, word)| all.with(key, Value::Text((*word).into())));
            let settings = match over {
                Over::List { skin, .. } => {
                    settings.with("over", Value::Text("list".into())).with("skin", Value::Number(skin.unwrap_or(0.0)))
                }
                _ => settings,
            };
            (entry.build)(&settings)
        })
    };
    let summed: &[_] = &[];
    let carried: &[_] = &[("density_by", "continuity")];
    let system = |name, range, dt, warm, (state, bounds), force| System { name, range, dt, warm, state, bounds, force };
    let birds =
        |name, neighbors| system(name, range(neighbors), 0.01, 100, particles(count, 1.0, 4.0, 2.0), Box::new(boids));
    let sparse = |name, neighbors| {
        let law = own("density", include_str!("density.wgsl"));
        system(name, range(neighbors), 0.02, 100, particles(count, 1.0, 0.2, 1.0), law)
    };
    vec![
        birds("boids 7", 7.0),
        birds("boids 14", 14.0),
        birds("boids 33", 33.0),
        system("circles 33", 2.0, 0.01, 100, particles(count, 1.0, 4.0, 0.0), circles),
        sparse("density 7", 7.0),
        sparse("density 14", 14.0),
        system("density 33", 2.0, 0.02, 100, particles(count, 1.0, 0.2, 1.0), density),
        system("water 33", 2.0, 0.02, 100, particles(count, 1.0, 0.2, 1.0), water(summed)),
        system("water 33, density carried", 2.0, 0.02, 100, particles(count, 1.0, 0.2, 1.0), water(carried)),
        system("water 113", 3.0, 0.02, 100, particles(count, 1.0, 0.2, 1.0), water(summed)),
        // ρ = 0.8442 and T = 0.72 when half of 1.44 has gone into melting.
        system("Lennard-Jones 55", 2.5, 0.005, 300, particles(count, 1.058, 0.02, 4.2), lennard_jones),
    ]
}

fn builds(simulation: &mut Simulation<Gpu>) -> u32 {
    if simulation.backend().buffer(LIST_STATE).is_none() {
        return 0;
    }
    let bytes = pollster::block_on(simulation.backend().bytes(LIST_STATE, 0, 16)).expect("a state");
    bytemuck::pod_collect_to_vec::<u8, u32>(&bytes)[1]
}

/// Seconds of all processors that this process has taken, where the system tells it (`man proc_pid_stat`: hundredths, user and system).
fn processors() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/self/stat").ok()?;
    let words: Vec<&str> = text.rsplit(')').next()?.split_whitespace().collect();
    let ticks = |place: usize| words.get(place)?.parse::<f64>().ok();
    Some((ticks(11)? + ticks(12)?) / 100.0)
}

fn step(simulation: &mut Simulation<Gpu>, steps: u32) -> f64 {
    let (start, taken) = (Instant::now(), processors());
    simulation.step(steps).and_then(|()| simulation.backend().wait()).expect("steps");
    let took = taken.zip(processors()).map_or(start.elapsed().as_secs_f64(), |(from, to)| to - from);
    took / f64::from(steps)
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small whole number")]
fn main() {
    let number = std::env::args().skip(1).find_map(|word| word.parse().ok());
    let count: u32 = number.unwrap_or(32_000);
    let wanted: Vec<String> =
        std::env::args().skip(1).filter(|w| w.parse::<u32>().is_err() && !w.starts_with('-')).collect();
    let found = pollster::block_on(async {
        let adapter = gpu::choose(gpu::adapters(&gpu::instance()).await, &gpu::Choice::Best)?;
        gpu::open(adapter).await
    });
    let found = found.expect("an adapter");
    println!("{}, {count} particles, medians of {TURNS}", found.describe());
    println!("milliseconds of {}", if processors().is_some() { "all processors together" } else { "wall-clock time" });
    for system in
        systems(count).iter().filter(|s| wanted.is_empty() || wanted.iter().any(|w| s.name.contains(w.as_str())))
    {
        let range = system.range;
        let mut visits = vec![("near".to_owned(), Over::Near { range, of: None })];
        let skins = SKINS.map(|skin| (format!("list, skin {skin}"), Some(skin * range)));
        for (name, skin) in skins.into_iter().chain([("list".to_owned(), None)]) {
            visits.push((name, Over::List { range, skin, slots: 0 }));
        }
        let mut simulations: Vec<_> = visits
            .iter()
            .map(|(_, over)| {
                let mut simulation =
                    Simulation::new(&found.device, &found.queue, &system.setup(*over)).expect("a simulation");
                step(&mut simulation, system.warm);
                pollster::block_on(simulation.check()).expect("no alarm");
                let start = Instant::now();
                step(&mut simulation, 8);
                let took = start.elapsed().as_secs_f64() / 8.0;
                (simulation, ((SPAN / took) as u32).clamp(8, 10_000))
            })
            .collect();
        let before: Vec<_> = simulations.iter_mut().map(|(s, _)| (builds(s), s.steps())).collect();
        let mut times = vec![Vec::new(); visits.len()];
        for _ in 0..TURNS {
            for (place, (simulation, steps)) in simulations.iter_mut().enumerate() {
                times[place].push(step(simulation, *steps));
            }
        }
        let state = pollster::block_on(simulations[0].0.snapshot()).expect("a state");
        let cells = Cells::new(state.position(), system.bounds, range).expect("cells");
        let mean = (0..state.len()).map(|i| {
            let mut near = 0;
            cells.around(i, |_| near += 1);
            f64::from(near)
        });
        let mean = mean.sum::<f64>() / f64::from(count);
        println!("\n{} (measured: {mean:.1})", system.name);
        let median = |all: &[f64]| {
            let mut all = all.to_vec();
            all.sort_by(f64::total_cmp);
            all[all.len() / 2]
        };
        let near = times[0].clone();
        for (place, (name, over)) in visits.iter().enumerate() {
            let took = median(&times[place]);
            let ratios: Vec<f64> = times[place].iter().zip(&near).map(|(its, near)| its / near).collect();
            let (simulation, _) = &mut simulations[place];
            let done = simulation.steps() - before[place].1;
            let built = builds(simulation) - before[place].0;
            let every = if built > 0 {
                format!("{:.1} steps to a build", done as f64 / f64::from(built))
            } else {
                String::new()
            };
            let problem = system.setup(*over).problem(gpu_machine(simulation)).expect("a problem");
            let room =
                problem.list.map_or(String::new(), |list| format!("skin {:.3}, room for {}", list.skin, list.capacity));
            println!("{name:>16}: {:8.3} ms  {:5.2} of near  {every}  {room}", 1e3 * took, median(&ratios));
            let _: &Problem = &problem;
        }
    }
}

fn gpu_machine(simulation: &mut Simulation<Gpu>) -> motes::kernel::Machine {
    use motes::kernel::Backend;
    simulation.backend().machine()
}
