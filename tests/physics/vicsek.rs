//! Vicsek's model (PRL 75, 1226, 1995) on the device: exact limits, and a table of order parameters.

use std::f64::consts::{PI, TAU};

use crate::support::states::{force, integrator, word};
use crate::support::{Random, Shared};
use glam::DVec3;
use motes::settings::Value;
use motes::{Bounds, Setup, Side, Simulation, State, VELOCITY};

/// A run: how many in which box, how far they see, with what noise.
struct Run {
    count: usize,
    side: f64,
    range: f64,
    eta: f64,
    kind: &'static str,
    integrator: &'static str,
    speed: f64,
    over: &'static str,
}

/// Of the paper: ρ = 4, r = 1, v₀ = 0.03.
const PAPER: Run = Run {
    count: 100,
    side: 5.0,
    range: 1.0,
    eta: 2.0,
    kind: "angular",
    integrator: "forward_euler",
    speed: 0.03,
    over: "within",
};

impl Run {
    fn simulation(&self, shared: &Shared) -> Simulation<motes::Gpu> {
        let mut random = Random::new(5);
        let mut particles = State::default();
        for _ in 0..self.count {
            let mut unit = || 0.5 + 0.5 * random.next();
            let (x, y, angle) = (self.side * unit(), self.side * unit(), TAU * unit());
            particles.push(DVec3::new(x, y, 0.0), self.speed * DVec3::new(angle.cos(), angle.sin(), 0.0), 1.0, 0.0);
        }
        let number = Value::Number;
        let settings = [
            ("range", number(self.range)),
            ("speed", number(self.speed)),
            ("noise", number(self.eta)),
            ("noise_kind", word(self.kind)),
            ("over", word(self.over)),
        ];
        let bounds = Bounds::new(DVec3::ZERO, DVec3::new(self.side, self.side, 0.0), Side::Periodic);
        let forces = vec![force("vicsek", &settings)];
        let setup = Setup {
            state: particles,
            forces,
            integrator: integrator(self.integrator),
            dt: 1.0,
            bounds,
            solver: motes::Solver::default(),
        };
        Simulation::new(&shared.found.device, &shared.found.queue, &setup).expect("a simulation")
    }
    /// The order parameter |Σ v| / N v₀, after a beginning, every few steps.
    fn orders(&self, shared: &Shared, beginning: u32, every: u32, samples: u32) -> Vec<f64> {
        let mut simulation = self.simulation(shared);
        simulation.step(beginning).expect("steps");
        (0..samples)
            .map(|_| {
                simulation.step(every).expect("steps");
                self.order(&mut simulation)
            })
            .collect()
    }
    fn order(&self, simulation: &mut Simulation<motes::Gpu>) -> f64 {
        let velocities = pollster::block_on(simulation.read(VELOCITY)).expect("velocities");
        let sum: DVec3 = velocities.iter().map(|v| v.as_dvec4().truncate()).sum();
        sum.length() / (self.count as f64 * self.speed)
    }
}

/// Mean, and its standard error from blocks that are long against what is remembered.
fn mean(values: &[f64], blocks: usize) -> (f64, f64) {
    let of = |v: &[f64]| v.iter().sum::<f64>() / v.len() as f64;
    let means: Vec<f64> = values.chunks_exact(values.len() / blocks).map(of).collect();
    let mean = of(&means);
    let variance = means.iter().map(|m| (m - mean).powi(2)).sum::<f64>() / (means.len() - 1) as f64;
    (mean, (variance / means.len() as f64).sqrt())
}

/// All see each other: they get one heading, and only their noise differs, so that samples are independent and
/// ⟨φ²⟩ = 1/N + (1 − 1/N) (sin(η/2) / (η/2))², exactly.
#[test]
fn all_to_all_is_exact() {
    let shared = crate::support::device();
    for (eta, over) in [(1.0, "within"), (2.5, "near"), (4.0, "list"), (5.5, "near")] {
        let run = Run { count: 40, side: 1.0, eta, over, ..PAPER };
        let squares: Vec<f64> = run.orders(&shared, 1, 1, 600).iter().map(|phi| phi * phi).collect();
        let n = 40.0;
        let want = 1.0 / n + (1.0 - 1.0 / n) * ((eta / 2.0).sin() / (eta / 2.0)).powi(2);
        let (got, error) = mean(&squares, 30);
        assert!((got - want).abs() < 4.0 * error, "η = {eta}: ⟨φ²⟩ = {got} ± {error}, not {want}");
        assert!(error < 0.02, "η = {eta}: an error of {error} says nothing");
    }
}

#[test]
fn without_noise_all_go_one_way_and_with_all_of_it_none() {
    let shared = crate::support::device();
    let run = Run { side: 1.0, eta: 0.0, ..PAPER };
    // One step; 100 headings of f32 and their sum.
    let phi = run.orders(&shared, 0, 1, 1)[0];
    assert!((phi - 1.0).abs() < 1e-5, "φ = {phi}");
    // Headings at random whatever is seen: φ of a random walk of N steps, √(π / 4 N) but for O(1/N) of it.
    let random = Run { eta: TAU, ..PAPER };
    let (got, error) = mean(&random.orders(&shared, 1, 1, 600), 30);
    let want = (PI / (4.0 * 100.0)).sqrt();
    assert!((got - want).abs() < 4.0 * error && error < 0.005, "⟨φ⟩ = {got} ± {error}, not {want}");
}

/// An independent program in f64, 3e5 steps and more, with standard errors: angular noise, places by the old heading.
const TABLE: [(usize, f64, f64, f64, f64); 6] = [
    (40, 3.1, 1.5, 0.9057, 0.0001),
    (40, 3.1, 2.5, 0.7500, 0.0001),
    (40, 3.1, 4.0, 0.4266, 0.0003),
    (100, 5.0, 2.0, 0.8208, 0.0005),
    (100, 5.0, 3.0, 0.6212, 0.0006),
    (100, 5.0, 4.0, 0.3624, 0.0014),
];

#[test]
#[ignore = "minutes on a software adapter: `tests/run --test physics --test commands -- --include-ignored` runs it"]
fn order_is_that_of_the_table() {
    let shared = crate::support::device();
    for (place, (count, side, eta, want, known)) in TABLE.into_iter().enumerate() {
        let over = if place % 2 == 0 { "within" } else { "near" };
        let run = Run { count, side, eta, over, ..PAPER };
        // Headings remember some hundred steps at η = 4; density, which matters little, spreads over L / 2π by relative
        // steps of η v₀ / √12 in some thousand at η = 1.5, the smallest here. Blocks are of 960 steps.
        let (got, error) = mean(&run.orders(&shared, 4000, 8, 1200), 10);
        println!("N = {count}, η = {eta}: {got:.4} ± {error:.4}, and the table has {want}");
        let allowed = 4.0 * error.hypot(known);
        assert!((got - want).abs() < allowed, "N = {count}, η = {eta}: φ = {got} ± {error}, not {want} ± {known}");
        assert!(error < 0.02, "N = {count}, η = {eta}: an error of {error} says nothing");
    }
}

/// The other order of the two updates, and the other noise, are other models.
#[test]
fn other_rules_have_other_orders() {
    let shared = crate::support::device();
    let orders = |run: &Run| mean(&run.orders(&shared, 500, 5, 600), 15);
    let fast = |integrator| Run { speed: 0.3, eta: 4.0, integrator, ..PAPER };
    let (old, new) = (orders(&fast("forward_euler")), orders(&fast("symplectic_euler")));
    assert!((old.0 - new.0).abs() > 4.0 * old.1.hypot(new.1), "old heading {old:?}, new heading {new:?}");
    let noise = |kind| Run { count: 40, side: 3.1, eta: 0.6, kind, ..PAPER };
    let (angular, vectorial) = (orders(&noise("angular")), orders(&noise("vectorial")));
    assert!((angular.0 - vectorial.0).abs() > 4.0 * angular.1.hypot(vectorial.1), "{angular:?} and {vectorial:?}");
}

/// Speeds are made anew in every step, so that nothing adds up.
#[test]
fn speeds_stay() {
    let shared = crate::support::device();
    let run = Run { count: 40, side: 3.1, ..PAPER };
    let mut simulation = run.simulation(&shared);
    for _ in 0..3 {
        simulation.step(700).expect("steps");
        for v in pollster::block_on(simulation.read(VELOCITY)).expect("velocities") {
            let speed = f64::from(v.truncate().length());
            // A unit vector, a product, (v' − v) / dt and its sum: 8 roundings of 6e-8.
            assert!((speed / run.speed - 1.0).abs() < 5e-7 && v.z == 0.0, "{speed}");
        }
    }
}
