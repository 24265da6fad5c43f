//! Gravity where space expands, in comoving coordinates: against linear theory, against Zel'dovich's pancake, and by the energy equation.

use std::f64::consts::PI;
use std::sync::Arc;

use glam::DVec3;
use motes::cosmology::{Cosmology, scale_factor};
use motes::forces::Component;
use motes::measure::{Cell, Moment};
use motes::settings::Value;
use motes::{Bounds, POSITION, Setup, Side, Simulation, State, VELOCITY};

use crate::support::machines::gpu;
use crate::support::states::{accelerations_in, force, integrator, word};
use crate::support::{self, Shared};

const G: f64 = 0.8;
const HUBBLE: f64 = 1.7;

/// A universe: the densities of matter and of the cosmological constant, and the redshift of the start.
#[derive(Clone, Copy, Debug)]
struct Universe(f64, f64, f64);

impl Universe {
    fn of(self) -> Cosmology {
        Cosmology::new(HUBBLE, self.0, self.1).expect("a universe")
    }
    fn gravity(self, over: &'static str, accuracy: f64, softening: f64) -> Vec<Box<dyn Component>> {
        let settings = [
            ("g", Value::Number(G)),
            ("softening", Value::Number(softening)),
            ("over", word(over)),
            ("images", word("ewald")),
            ("accuracy", Value::Number(accuracy)),
            ("hubble", Value::Number(HUBBLE)),
            ("omega_matter", Value::Number(self.0)),
            ("omega_lambda", Value::Number(self.1)),
            ("redshift", Value::Number(self.2)),
        ];
        vec![force("gravity", &settings)]
    }
    /// The factor by which a small wave of some sheets in a lattice grows, which is steeper than that of linear theory by the share `more`: from the
    /// equation of motion in physical time, in ln a, by Runge and Kutta: x″ + (2 + d ln H / d ln a) x′ = 3/2 Ω_m(a) (1 + more) x.
    fn growth(self, to: f64, more: f64) -> f64 {
        let universe = self.of();
        let (from, to) = (scale_factor(self.2).ln(), scale_factor(to).ln());
        let slope = |s: f64, [x, v]: [f64; 2]| {
            let a = s.exp();
            let matter = universe.matter_at(a);
            let curvature = universe.curvature() / (a * universe.rate(a) / HUBBLE).powi(2);
            // d ln H / d ln a
            let slower = -1.5 * matter - curvature;
            [v, 1.5 * matter * (1.0 + more) * x - (2.0 + slower) * v]
        };
        let steps = 4000;
        let h = (to - from) / f64::from(steps);
        let mut y = [1.0, universe.growth_rate(from.exp())];
        for n in 0..steps {
            let s = from + h * f64::from(n);
            let add = |k: [f64; 2], by: f64| [y[0] + by * k[0], y[1] + by * k[1]];
            let k1 = slope(s, y);
            let k2 = slope(s + 0.5 * h, add(k1, 0.5 * h));
            let k3 = slope(s + 0.5 * h, add(k2, 0.5 * h));
            let k4 = slope(s + h, add(k3, h));
            y = [0, 1].map(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
        }
        y[0]
    }
}

fn cube(side: f64) -> Bounds {
    let low = DVec3::new(-0.25, 0.5, 1.0) * side;
    Bounds::new(low, low + DVec3::splat(side), Side::Periodic)
}

/// A lattice of the matter of a universe, displaced along x by ψ(q), in units of the side, with the velocities of the growing mode.
fn displaced(universe: Universe, side: f64, number: u32, by: impl Fn(f64) -> f64) -> State {
    let (mut state, n) = (State::default(), f64::from(number));
    let (cosmology, a) = (universe.of(), scale_factor(universe.2));
    let mass = cosmology.mean_density(G) * (side / n).powi(3);
    let rate = a * a * cosmology.rate(a) * cosmology.growth_rate(a);
    for x in 0..number {
        for y in 0..number {
            for z in 0..number {
                let q = (DVec3::new(f64::from(x), f64::from(y), f64::from(z)) + 0.5) / n;
                let moved = by(q.x) * side * DVec3::X;
                state.push(cube(side).low + side * q + moved, rate * moved, mass, 0.0);
            }
        }
    }
    state
}

/// How much more the sheets of a lattice pull than those of linear theory: see `a_plane_wave_grows_as_jeans_says`.
fn sheets(number: u32) -> f64 {
    let next = [1.0, 2.0_f64.sqrt()].map(|q| q * 4.0 * PI * (-2.0 * PI * q).exp()).iter().sum::<f64>();
    next * (2.0 - 2.0 * (2.0 * PI / f64::from(number)).cos())
}

/// The places after so many steps to a redshift.
fn moved(
    shared: &Shared,
    universe: Universe,
    (state, bounds): (State, Bounds),
    end: f64,
    steps: u32,
) -> [Vec<DVec3>; 2] {
    let time = universe.of().time(scale_factor(universe.2), scale_factor(end));
    let setup = Setup {
        state,
        forces: universe.gravity("pairs", 1.5e-4, 0.0),
        integrator: integrator("leapfrog"),
        dt: time / f64::from(steps),
        bounds,
        solver: motes::Solver::default(),
    };
    let mut simulation = Simulation::on(gpu(shared, setup.state.len()), &setup).expect("a simulation");
    simulation.step(steps).expect("steps");
    [POSITION, VELOCITY].map(|field| {
        let values = pollster::block_on(simulation.read(field)).expect("values");
        values.iter().map(|v| v.truncate().as_dvec3()).collect()
    })
}

/// A small plane wave in matter alone, with curvature, and with a cosmological constant, to redshift 0.5.
#[test]
fn small_waves_grow_as_in_linear_theory() {
    let shared = support::device();
    let (number, side, small) = (8, 2.0, 2e-3);
    for universe in
        [Universe(1.0, 0.0, 9.0), Universe(0.3, 0.7, 9.0), Universe(0.3, 0.0, 9.0), Universe(0.25, 0.85, 4.0)]
    {
        let wave = displaced(universe, side, number, |q| small * (2.0 * PI * q).sin());
        let still = displaced(universe, side, number, |_| 0.0);
        let [places, _] = moved(&shared, universe, (wave, cube(side)), 0.5, 200);
        let (mut overlap, mut norm) = (0.0, 0.0);
        for (place, q) in places.iter().zip(still.position()) {
            let shape = (2.0 * PI * (q.x - cube(side).low.x) / side).sin();
            overlap += (place.x - q.x) * shape;
            norm += side * small * shape * shape;
        }
        let (found, expected) = (overlap / norm, universe.growth(0.5, sheets(number)));
        // Steps of leapfrog: of a rate ω with ω dt = d ln a of up to 0.04, (ω dt)² / 24 of the growth of 3 to 7 times; places, of which 2e-3 of
        // the side is resolved in single precision to 6e-5.
        assert!((found / expected - 1.0).abs() < 4e-4, "{universe:?}: it grows by {found}, not {expected}");
        assert!((expected / universe.growth(0.5, 0.0) - 1.0).abs() > 4e-3, "the sheets of the lattice count");
    }
}

/// A plane wave until its sheets cross (Zel'dovich 1970): x = q + D(a) ψ(q) is exact. The centre is where sheets are closer than the points in them, which
/// pull like points, so that the more there are the better.
#[test]
fn a_pancake_is_that_of_zeldovich() {
    let shared = support::device();
    for universe in [Universe(1.0, 0.0, 19.0), Universe(0.3, 0.7, 19.0)] {
        let errors = [8_u32, 16].map(|number| {
            let cosmology = universe.of();
            // Sheets cross at redshift 1; the run ends at 1.5.
            let (crossing, end) = (cosmology.growth(scale_factor(1.0)), scale_factor(1.5));
            let wave = |a: f64| move |q: f64| -cosmology.growth(a) / crossing * (2.0 * PI * q).sin() / (2.0 * PI);
            let state = displaced(universe, 1.0, number, wave(scale_factor(universe.2)));
            let expected = displaced(universe, 1.0, number, wave(end));
            let [places, _] = moved(&shared, universe, (state, cube(1.0)), 1.5, 120);
            let off = |(place, there): (&DVec3, &DVec3)| cube(1.0).shortest(*place - *there).length_squared();
            let square: f64 = places.iter().zip(expected.position()).map(off).sum::<f64>() / places.len() as f64;
            // The amplitude is D / D× / 2π.
            square.sqrt() * 2.0 * PI * crossing / cosmology.growth(end)
        });
        assert!(errors[1] < 0.013, "{universe:?}: {errors:?} of the amplitude");
        assert!(errors[1] < 0.3 * errors[0], "{universe:?}: {errors:?}: it does not converge");
    }
}

/// All images of a cloud at different times, over pairs and over a tree, by the references: those of a space at rest times a. And the potential energy of
/// particles that do not move, by a device, where (LEFT − t) / LEFT is rounded, of which a is some power.
#[test]
fn gravity_grows_with_the_scale_factor() {
    let universe = Universe(0.3, 0.7, 9.0);
    let bounds = cube(2.0);
    let cloud = crate::ewald::scattered(60, &bounds, 3);
    for over in ["pairs", "tree"] {
        let still = crate::ewald::softened(G, 1e-6, 0.05, over);
        let expected = accelerations_in(&bounds, &still, &cloud, 0.0);
        for redshift in [9.0, 3.0, 0.5, -0.5] {
            let a = scale_factor(redshift);
            let time = universe.of().time(0.1, a);
            let found = accelerations_in(&bounds, &universe.gravity(over, 1e-6, 0.05), &cloud, time);
            for (found, expected) in found.iter().zip(&expected) {
                let off = (*found - *expected * a).length();
                assert!(off < 3e-7 * (expected.length() * a), "{over}, z = {redshift}: {found} {expected}");
            }
        }
    }
    let shared = support::device();
    for (over, redshift) in [("pairs", 9.0), ("tree", 9.0), ("pairs", 99.0)] {
        let (universe, steps) = (Universe(0.3, 0.7, redshift), 10_u32);
        let mut held = cloud.clone();
        held.velocity_mut().iter_mut().for_each(|v| *v = DVec3::ZERO);
        held.held = (0..60).map(|id| motes::motion::Held { id, by: motes::motion::Hold::Fixed }).collect();
        let setup = Setup {
            state: held,
            forces: universe.gravity(over, 1.5e-4, 0.05),
            integrator: integrator("leapfrog"),
            dt: universe.of().time(scale_factor(redshift), 1.0) / f64::from(steps),
            bounds,
            solver: motes::Solver::default(),
        };
        let mut simulation = Simulation::on(gpu(&shared, 60), &setup).expect("a simulation");
        let (mut first, expansion) = (None, setup.forces[0].properties().expands.expect("it expands").expansion);
        for step in 0..=steps {
            let state = pollster::block_on(simulation.snapshot()).expect("a state");
            let energy: f64 = state.energies().expect("energies").iter().sum();
            let a = expansion.scale_factor(state.time);
            let share = energy / a / *first.get_or_insert(energy / a);
            assert!((share - 1.0).abs() < 1e-5, "{over}, from {redshift}, step {step}, a = {a}: {share}");
            if step < steps {
                simulation.step(1).expect("a step");
            }
        }
    }
}

/// The long waves of displacements from a lattice of so many points along a side: along each of the 13 shortest wave vectors, cosine and sine.
fn long_waves(places: &[DVec3], bounds: &Bounds, number: usize) -> Vec<f64> {
    let side = bounds.period().x;
    let mut waves = Vec::new();
    for k in 0..27 {
        let k = DVec3::new(f64::from(k % 3), f64::from(k / 3 % 3), f64::from(k / 9)) - 1.0;
        // Of a wave and its opposite one.
        if k.dot(DVec3::new(1.0, 3.0, 9.0)) <= 0.0 {
            continue;
        }
        let (mut cosine, mut sine) = (0.0, 0.0);
        for (n, place) in places.iter().enumerate() {
            let q = (DVec3::from_array([n % number, n / number % number, n / (number * number)].map(|n| n as f64))
                + 0.5)
                / number as f64;
            let along = bounds.shortest(*place - bounds.low - q * side).dot(k.normalize());
            let phase = 2.0 * PI * k.dot(q);
            cosine += along * phase.cos();
            sine += along * phase.sin();
        }
        waves.extend([cosine, sine]);
    }
    waves
}

/// The matter of a universe at redshift 24 becomes that of redshift 4: its long waves do, which a lattice hardly pulls more than matter that is everywhere.
#[test]
fn matter_of_one_redshift_becomes_that_of_another() {
    let shared = support::device();
    let (number, side, end) = (16, 160.0, 4.0);
    let universe = Universe(0.3, 0.7, 24.0);
    for seed in [1.0, 2.0] {
        let shape = motes::shapes::shape("cosmological").expect("a shape");
        let bounds = Bounds::new(DVec3::splat(-0.5 * side), DVec3::splat(0.5 * side), Side::Periodic);
        let at = |redshift: f64, order: &'static str| {
            let values = [
                ("count_per_side", Value::Number(16.0)),
                ("side", Value::Number(side)),
                ("megaparsec", Value::Number(1.0)),
                ("g", Value::Number(G)),
                ("hubble", Value::Number(HUBBLE)),
                ("redshift", Value::Number(redshift)),
                ("seed", Value::Number(seed)),
                ("order", word(order)),
            ];
            let mut settings = motes::settings::Settings::defaults(shape.keys);
            settings.0.extend(values);
            (shape.build)(&settings).expect("matter")
        };
        let [places, speeds] = moved(&shared, universe, (at(universe.2, "second"), bounds), end, 60);
        // Velocities, as displacements of a lattice.
        let still = at(1e9, "first");
        let shift = |speeds: &[DVec3]| -> Vec<DVec3> {
            still.position().iter().zip(speeds).map(|(q, v)| *q + *v * 1e-2).collect()
        };
        let far = |found: &[DVec3], expected: &[DVec3]| {
            let [found, expected] = [found, expected].map(|places| long_waves(places, &bounds, number));
            let off: f64 = found.iter().zip(&expected).map(|(a, b)| (a - b).powi(2)).sum();
            (off / expected.iter().map(|b| b * b).sum::<f64>()).sqrt()
        };
        let [second, first] = [at(end, "second"), at(end, "first")]
            .map(|expected| [far(&places, expected.position()), far(&shift(&speeds), &shift(expected.velocity()))]);
        assert!(second[0] < 0.02 && second[1] < 0.02, "seed {seed}: {second:?}");
        assert!(
            first[0] > 1.1 * second[0] && first[1] > 1.1 * second[1],
            "seed {seed}: {first:?} to first order, {second:?} to second"
        );
    }
}

/// K + W − ∫ W d ln a of collapsing matter stays as it is (Layzer 1963; Irvine 1961), also where a run goes on from a row of its table.
#[test]
fn the_cosmic_energy_is_constant() {
    let universe = Universe(0.3, 0.7, 24.0);
    let side = 40.0;
    let bounds = Bounds::new(DVec3::ZERO, DVec3::splat(side), Side::Periodic);
    for seed in [1.0, 2.0] {
        let shape = motes::shapes::shape("cosmological").expect("a shape");
        let mut settings = motes::settings::Settings::defaults(shape.keys);
        let values = [
            ("count_per_side", 8.0),
            ("side", side),
            ("megaparsec", 1.0),
            ("g", G),
            ("hubble", HUBBLE),
            ("redshift", 24.0),
            ("seed", seed),
        ];
        settings.0.extend(values.map(|(key, x)| (key, Value::Number(x))));
        settings.0.insert("center", Value::Vector(DVec3::splat(0.5 * side)));
        let (steps, per) = (400_u32, 2_u32);
        let time = universe.of().time(scale_factor(24.0), 1.0);
        let setup = Setup {
            state: (shape.build)(&settings).expect("matter"),
            forces: universe.gravity("pairs", 1.5e-4, 0.5),
            integrator: integrator("leapfrog"),
            dt: time / f64::from(steps),
            bounds,
            solver: motes::Solver::default(),
        };
        let shared = support::device();
        let mut simulation = Simulation::on(gpu(&shared, setup.state.len()), &setup).expect("a simulation");
        let measure = motes::measure::measure("expansion").expect("a measure");
        let begin = || (measure.begin)(&setup, &motes::settings::Settings::default()).expect("a series");
        let (mut series, mut other) = (begin(), None);
        let mut rows: Vec<Vec<f64>> = Vec::new();
        for n in 0..=steps / per {
            if n > 0 {
                simulation.step(per).expect("steps");
            }
            let state = Arc::new(pollster::block_on(simulation.snapshot()).expect("a state"));
            let moment = Moment { state: &state, density: &[], clock: None, links: None, virial: None };
            let row = numbers(&series.take(&moment).expect("a row")[0]);
            if n == 150 {
                let words: Vec<String> = [state.time].iter().chain(&row).map(|x| format!("{x:?}")).collect();
                let words: Vec<&str> = words.iter().map(String::as_str).collect();
                let mut again = begin();
                again.recall(300, &words);
                other = Some(again);
            } else if let Some(other) = &mut other {
                let went_on = numbers(&other.take(&moment).expect("a row")[0]);
                assert_eq!(went_on, row);
            }
            rows.push(row);
        }
        let (first, last) = (&rows[0], rows.last().expect("a row"));
        assert!((last[0] - 1.0).abs() < 1e-5 && (last[3] - 1.0).abs() < 1e-5, "{last:?}");
        let most = rows.iter().map(|row| (row[7] - first[7]).abs() / last[5].abs()).fold(0.0, f64::max);
        // It is a small difference of these.
        assert!(last[4] > 3.0 * first[7].abs() && -last[5] > 3.0 * first[7].abs(), "nothing collapses: {last:?}");
        // Rows are up to 0.08 of ln a apart, of which trapezoids err by some 1e-3 in an e-fold of W; steps, by less.
        assert!(most < 2e-3, "seed {seed}: {most} of the potential energy");
    }
}

fn numbers(row: &[Cell]) -> Vec<f64> {
    row.iter().map(|cell| if let Cell::Number(x) = cell { *x } else { f64::NAN }).collect()
}
