//! Charges of all images: against Madelung's constants, against sums split otherwise, and by what a periodic box must do.

use std::f64::consts::PI;

use glam::{DMat3, DVec3};
use motes::component::Stage;
use motes::forces::Component;
use motes::integrators::Step;
use motes::kernel::{Array, Backend, Machine, Plan};
use motes::links::Link;
use motes::lockstep::compare;
use motes::settings::Value;
use motes::{Bounds, Setup, Side, Simulation, State};
use pollster::block_on;

use super::{periodic, setup};
use crate::ewald::exact::erfc;
use crate::matter::{agrees, on_cpu};
use crate::support::Random;
use crate::support::machines::gpu;
use crate::support::states::{force, one, word};

const CONSTANT: f64 = 1.5;

fn coulomb(range: f64, accuracy: f64, exclude: f64) -> Box<dyn Component> {
    let numbers = [("range", range), ("coulomb", CONSTANT), ("accuracy", accuracy), ("exclude", exclude)];
    let numbers = numbers.map(|(key, x)| (key, Value::Number(x)));
    let over = if exclude > 0.0 { "list" } else { "near" };
    force("coulomb", &[&numbers[..], &[("images", word("ewald")), ("over", word(over))]].concat())
}

/// Charges at positions.
fn charged(all: impl Iterator<Item = (DVec3, f64)>) -> State {
    let mut state: Option<State> = None;
    let mut charges = Vec::new();
    for (x, charge) in all {
        match &mut state {
            Some(state) => state.push(x, DVec3::ZERO, 1.0, 0.0),
            None => state = Some(one(x, DVec3::ZERO)),
        }
        charges.push(charge);
    }
    let mut state = state.expect("charges");
    state.declare(&coulomb(1.0, 1e-4, 0.0).columns()[0]).expect("a column");
    state.set("charge", Array::Float(charges)).expect("charges");
    state
}

/// A box of three sides, away from the origin.
fn oblong() -> Bounds {
    let low = DVec3::new(-1.5, 2.25, 0.5);
    periodic(low, low + DVec3::new(6.0, 7.5, 9.0))
}

/// So many charges anywhere, three to a molecule, of masses from 0.5 to 1.5; with a net charge, or not.
fn scattered(count: usize, bounds: &Bounds, net: f64, seed: u64) -> State {
    let mut random = Random::new(seed);
    let mut middle = DVec3::ZERO;
    let mut place = |i: usize| {
        let x = if i.is_multiple_of(3) {
            bounds.low + 0.5 * (random.vector() + 1.0) * (bounds.high - bounds.low)
        } else {
            middle + 0.7 * random.vector()
        };
        if i.is_multiple_of(3) {
            middle = x;
        }
        ((x * 1024.0).round() / 1024.0, [-0.8, 0.4, 0.4][i % 3] + net / count as f64)
    };
    let mut state = charged((0..count).map(&mut place));
    let masses = (0..count).map(|i| 0.5 + (i % 5) as f64 / 4.0);
    state.mass_mut().iter_mut().zip(masses).for_each(|(mass, m)| *mass = m);
    let bond = |ends| Link { ends, rest: 0.7, stiffness: 10.0, damping: 0.0, rope: false };
    let first = (0..u32::try_from(count).expect("few") / 3).map(|n| 3 * n);
    state.links.springs = first.flat_map(|n| [bond([n, n + 1]), bond([n, n + 2])]).collect();
    state
}

/// Energy, forces and −∂E / ∂ε by the usual split, erfc(α r) / r and waves by exp(−κ² / 4 α²), to 1e-13; `exclude`: pairs of a molecule up to so many
/// bonds apart have nothing with one another but their further images (Ewald 1921; Nosé & Klein 1983).
fn by_hand(state: &State, bounds: &Bounds, exclude: usize) -> (f64, Vec<DVec3>, DMat3) {
    let (x, q) = (state.position(), state.scalar("charge").expect("charges"));
    let (side, count) = (bounds.high - bounds.low, state.len());
    let (volume, alpha) = (side.element_product(), 5.6 / side.min_element());
    let (mut energy, mut forces, mut virial) = (0.0, vec![DVec3::ZERO; count], DMat3::ZERO);
    let outer = |a: DVec3, b: DVec3| DMat3::from_cols(a * b.x, a * b.y, a * b.z);
    let grid = |most: [i32; 3]| {
        let along = move |axis: usize| (-most[axis]..=most[axis]).map(f64::from);
        along(0).flat_map(move |x| along(1).flat_map(move |y| along(2).map(move |z| DVec3::new(x, y, z))))
    };
    for i in 0..count {
        for j in 0..count {
            let nearest = bounds.shortest(x[j] - x[i]);
            for n in grid([1; 3]) {
                let r = nearest + n * side;
                if i == j && n == DVec3::ZERO {
                    continue;
                }
                // The first of a molecule is bonded to both others.
                let bonds = if i.min(j) % 3 == 0 { 1 } else { 2 };
                let excluded = n == DVec3::ZERO && i / 3 == j / 3 && bonds <= exclude;
                let (d, charges) = (r.length(), CONSTANT * q[i] * q[j]);
                let part = erfc(alpha * d) - if excluded { 1.0 } else { 0.0 };
                let slope = -(part / d + 2.0 * alpha / PI.sqrt() * (-(alpha * d).powi(2)).exp()) / d;
                energy += 0.5 * charges * part / d;
                forces[i] += charges * slope / d * r;
                virial -= 0.5 * charges * slope / d * outer(r, r);
            }
        }
    }
    let most = (side * alpha * 11.5 / (2.0 * PI)).to_array().map(|x| x as i32);
    for n in grid(most).filter(|n| *n != DVec3::ZERO) {
        let k = 2.0 * PI * n / side;
        let square = k.length_squared();
        let amount = 4.0 * PI * CONSTANT / (volume * square) * (-square / (4.0 * alpha * alpha)).exp();
        let wave: Vec<_> = x.iter().map(|x| k.dot(*x).sin_cos()).collect();
        let sum = wave.iter().zip(q).fold([0.0, 0.0], |[re, im], ((s, c), q)| [re + q * c, im + q * s]);
        let here = 0.5 * amount * (sum[0] * sum[0] + sum[1] * sum[1]);
        energy += here;
        virial += here * (DMat3::IDENTITY - (2.0 / square + 0.5 / (alpha * alpha)) * outer(k, k));
        for ((force, (s, c)), q) in forces.iter_mut().zip(&wave).zip(q) {
            *force += amount * q * (s * sum[0] - c * sum[1]) * k;
        }
    }
    let own: f64 = q.iter().map(|q| q * q).sum();
    let net: f64 = q.iter().sum();
    let background = -PI * CONSTANT * net * net / (2.0 * alpha * alpha * volume);
    energy += background - CONSTANT * alpha / PI.sqrt() * own;
    virial += background * DMat3::IDENTITY;
    (energy, forces, virial)
}

/// Energy, forces and virial of a state.
fn of<B: Backend>(mut simulation: Simulation<B>) -> (f64, Vec<DVec3>, [f64; 6]) {
    simulation.step(0).expect("a start");
    let state = block_on(simulation.snapshot()).expect("a state");
    let pull = block_on(simulation.read(motes::ACCELERATION)).expect("accelerations");
    let forces = pull.iter().zip(state.mass()).map(|(a, m)| *m * a.truncate().as_dvec3()).collect();
    (state.energies().expect("energies").iter().sum(), forces, block_on(simulation.virial()).expect("a virial"))
}

fn on_device(setup: &Setup) -> Simulation<motes::Gpu> {
    let device = gpu(&crate::support::device(), setup.state.len());
    Simulation::on(device, setup).expect("a simulation")
}

/// Madelung's constants by nearest neighbours of rock salt, caesium chloride and zinc blende (Crandall & Buhler, J. Phys. A 20, 5497, 1987).
#[test]
fn crystals_have_their_madelung_constants() {
    let face = [[0.0, 0.0, 0.0], [0.5, 0.5, 0.0], [0.5, 0.0, 0.5], [0.0, 0.5, 0.5]].map(DVec3::from);
    let crystals = [
        (&face[..], DVec3::X * 0.5, 0.5, 1.747_564_594_633_18),
        (&face[..1], DVec3::splat(0.5), 0.75f64.sqrt(), 1.762_674_773_070_99),
        (&face[..], DVec3::splat(0.25), 0.25 * 3.0f64.sqrt(), 1.638_055_053_388_79),
    ];
    for (basis, shift, nearest, madelung) in crystals {
        let edge = 2.0;
        let cells = [2, 3, 2];
        let bounds = periodic(DVec3::ZERO, edge * DVec3::from(cells.map(f64::from)));
        let places = (0..12).map(|n| DVec3::new(f64::from(n % 2), f64::from(n / 2 % 3), f64::from(n / 6)));
        let ions = places.flat_map(|cell| basis.iter().map(move |b| edge * (cell + *b)));
        let state = charged(ions.flat_map(|x| [(x, 0.75), (x + edge * shift, -0.75)]));
        let want = -madelung * CONSTANT * 0.75 * 0.75 / (edge * nearest);
        // Per pair of ions. Waves left out of so regular a lattice may all add up: rms of a pair times the number in a cube of side 2 R.
        for (range, accuracy, most) in [(2.0, 1e-9, 1e-8), (1.3, 1e-9, 1e-8), (2.0, 1e-4, 2e-4)] {
            let setup = setup(state.clone(), vec![coulomb(range, accuracy, 0.0)], bounds, 1e-3);
            let per_pair = |energy: f64| 2.0 * energy / setup.state.len() as f64;
            let (energy, forces, _) = of(on_cpu(&setup));
            assert!(
                (per_pair(energy) / want - 1.0).abs() < most,
                "{range}, {accuracy}: {} is not {want}",
                per_pair(energy)
            );
            // By symmetry.
            assert!(forces.iter().all(|f| f.length() < 1e-6), "forces in a crystal");
            let (energy, ..) = of(on_device(&setup));
            // Up to 7000 waves, each of which rounds a sum of three times that by 6e-8.
            assert!(
                (per_pair(energy) / want - 1.0).abs() < most + 1.5e-5,
                "{range}, {accuracy}, device: {}",
                per_pair(energy)
            );
        }
    }
}

/// Energies, forces and virials of 120 charges in a box of three sides, neutral or not, with and without pairs of bonds, for several ranges.
#[test]
fn another_split_has_the_same_sums() {
    let bounds = oblong();
    for (seed, net, exclude, range) in [(1, 0.0, 0, 3.0), (2, 0.0, 2, 2.2), (3, 1.5, 1, 2.75), (4, -0.5, 2, 0.8)] {
        let state = scattered(120, &bounds, net, seed);
        let (energy, forces, virial) = by_hand(&state, &bounds, exclude);
        let size = (forces.iter().map(|f| f.length_squared()).sum::<f64>() / 120.0).sqrt();
        let accuracy = if range < 1.0 { 1e-6 } else { 1e-9 };
        let setup = setup(state, vec![coulomb(range, accuracy, exclude as f64)], bounds, 1e-3);
        // Waves left out, of some 120 charges in units of k / R²; positions and parameters are single precision.
        let waves = CONSTANT * accuracy / (range * range) * 120.0;
        for (name, got, rounding) in [("host", of(on_cpu(&setup)), 2e-6), ("device", of(on_device(&setup)), 3e-5)] {
            let of = format!("seed {seed}, exclude = {exclude}, R = {range}, {name}");
            assert!(
                (got.0 - energy).abs() < waves + rounding * energy.abs().max(size),
                "{of}: {} is not {energy}",
                got.0
            );
            for (i, (f, want)) in got.1.iter().zip(&forces).enumerate() {
                assert!(
                    (*f - *want).length() < waves + rounding * size.max(want.length()),
                    "{of}, {i}: {f} is not {want}"
                );
            }
            let whole = virial.col(0).length() + virial.col(1).length() + virial.col(2).length();
            let parts =
                [virial.col(0).x, virial.col(1).y, virial.col(2).z, virial.col(1).z, virial.col(0).z, virial.col(0).y];
            for (part, want) in got.2.iter().zip(parts) {
                assert!(
                    (part - want).abs() < 9.0 * waves + 3.0 * rounding * whole,
                    "{of}: {part} is not {want} of {:?}",
                    got.2
                );
            }
            // Sums over waves push nothing as a whole.
            let sum: DVec3 = got.1.iter().sum();
            assert!(sum.length() < 1e-5 * size * 120.0f64.sqrt(), "{of}: {sum}");
        }
    }
}

/// The trace of the virial is the energy: all lengths of a box in a conductor may be multiplied by one number.
#[test]
fn the_virial_has_the_energy_as_its_trace() {
    let bounds = oblong();
    for seed in [5, 6] {
        let state = scattered(90, &bounds, 0.0, seed);
        let (energy, _, w) = of(on_cpu(&setup(state, vec![coulomb(2.5, 1e-7, 0.0)], bounds, 1e-3)));
        assert!(((w[0] + w[1] + w[2]) / energy - 1.0).abs() < 1e-5, "{w:?} of {energy}");
    }
}

/// The error of the force of a unit charge on another, anywhere in a cube of side 2 R, is what was asked for, or a little less.
#[test]
fn waves_end_where_the_accuracy_says() {
    let range = 1.5;
    let bounds = periodic(DVec3::ZERO, DVec3::splat(2.0 * range));
    for accuracy in [1e-2, 1e-4, 1e-6] {
        let mut random = Random::new(11);
        let mut sum = 0.0;
        let tries = 40;
        for _ in 0..tries {
            let x = range * (1.0 + random.vector());
            let state = charged([(DVec3::splat(0.125), 1.0), (x, 1.0)].into_iter());
            let (_, exact, _) = by_hand(&state, &bounds, 0);
            let setup = setup(state, vec![coulomb(range, accuracy, 0.0)], bounds, 1e-3);
            let mut cpu = on_cpu(&setup);
            cpu.step(0).expect("a start");
            let pull = block_on(cpu.read(motes::ACCELERATION)).expect("accelerations");
            sum += (pull[1].truncate().as_dvec3() - exact[1]).length_squared();
        }
        let error = (sum / f64::from(tries)).sqrt() * range * range / CONSTANT;
        // Single precision rounds accelerations by 6e-8 of a few k / R².
        assert!(error < accuracy + 1e-6 && error > 0.1 * accuracy - 1e-6, "{accuracy}: {error}");
    }
}

/// Every kernel of a step and of the virial agrees with its reference, in one dispatch and in several, and with a particle that has no mass.
#[test]
fn kernels_agree_with_their_references() {
    let bounds = oblong();
    for (count, meetings, exclude) in [(99, 1 << 30, 2.0), (300, 40_000, 0.0), (3, 1 << 30, 1.0)] {
        let mut state = scattered(count, &bounds, 0.3, 8);
        if exclude == 0.0 {
            state.links.springs.clear();
            state.mass_mut()[1] = 0.0;
        }
        let mut device = gpu(&crate::support::device(), count);
        let machine = Machine { meetings, ..device.machine() };
        device.pretend(machine);
        let setup = setup(state, vec![coulomb(2.0, 1e-5, exclude)], bounds, 1e-3);
        let mut simulation = Simulation::on(device, &setup).expect("a simulation");
        simulation.step(1).expect("a step");
        let problem = setup.problem(machine).expect("a problem");
        let mut step = Step::new(&setup.forces, problem.clone());
        step.evaluate();
        let mut plans = vec![step.finished().expect("a plan")];
        let images = plans[0].kernels.iter().find(|kernel| kernel.name.starts_with("coulomb images")).expect("images");
        assert!((images.passes.len() > 1) == (meetings < 1 << 30), "{} dispatches", images.passes.len());
        let mut virial = Plan::of([motes::visit::clear_virial(&problem).expect("a kernel")]);
        setup.forces[0].stage(Stage::Virial { earlier: 0 }, &mut virial, &problem).expect("a plan");
        plans.push(virial);
        for plan in plans {
            let number = u32::try_from(count).expect("few");
            let verdicts = block_on(compare(simulation.backend(), &plan, number)).expect("verdicts");
            for v in verdicts.iter().filter(|v| !v.kernel.contains("list")) {
                assert!(v.sound() && (v.good() || exclude > 0.0), "{count}: {v:?}");
            }
            assert!(verdicts.iter().any(|v| v.changed));
        }
    }
}

/// Molten salt keeps its energy and its momentum: two seeds, 216 ions with a soft core.
#[test]
fn ions_keep_their_energy() {
    for seed in [1, 2] {
        let bounds = periodic(DVec3::ZERO, DVec3::splat(9.0));
        let mut random = Random::new(seed);
        let places = (0..216).map(|n| {
            (DVec3::new(f64::from(n % 6), f64::from(n / 6 % 6), f64::from(n / 36)), (n % 6 + n / 6 % 6 + n / 36) % 2)
        });
        let mut state = charged(
            places.map(|(cell, odd)| (1.5 * (cell + 0.5) + 0.1 * random.vector(), if odd == 0 { 1.0 } else { -1.0 })),
        );
        state.velocity_mut().iter_mut().for_each(|v| *v = 0.3 * random.vector());
        let core = force("wca", &[("sigma", Value::Number(1.2))]);
        let setup = setup(state, vec![core, coulomb(3.0, 1e-5, 0.0)], bounds, 2e-3);
        let mut device = on_device(&setup);
        let mut total = |steps| {
            device.step(steps).expect("steps");
            let state = block_on(device.snapshot()).expect("a state");
            let kinetic: f64 = state.velocity().iter().map(|v| 0.5 * v.length_squared()).sum();
            let momentum: DVec3 = state.velocity().iter().sum();
            (kinetic + state.energies().expect("energies").iter().sum::<f64>(), kinetic, momentum)
        };
        let (first, _, before) = total(0);
        let (last, kinetic, after) = total(300);
        // Leapfrog at ω dt = 0.02 swings by (ω dt)² / 8 of what is in motion, and energies of 190 are rounded by 1e-7.
        assert!((last - first).abs() < 2e-4 * kinetic, "{seed}: {first} → {last}, {kinetic}");
        assert!((after - before).length() < 1e-3, "{seed}: {before} → {after}");
    }
}

/// Two at one place that a bond leaves out, as a core and its shell begin: an energy, and no force.
#[test]
fn excluded_charges_may_be_at_one_place() {
    let bounds = oblong();
    let mut state = charged([(DVec3::new(1.0, 4.0, 3.0), 1.0), (DVec3::new(1.0, 4.0, 3.0), -0.5)].into_iter());
    state.links.springs = vec![Link { ends: [0, 1], rest: 0.1, stiffness: 1.0, damping: 0.0, rope: false }];
    let setup = setup(state, vec![coulomb(2.0, 1e-5, 1.0)], bounds, 1e-3);
    let ((host, pulls, _), (device, ..)) = (of(on_cpu(&setup)), of(on_device(&setup)));
    assert!(
        host.is_finite() && (host - device).abs() < 1e-5 && pulls.iter().all(|f| f.length() < 1e-5),
        "{host} {device} {pulls:?}"
    );
}

/// 120 ions with a soft core on a lattice in that box, which a barostat stretches or compresses.
fn pressed(pressure: f64, seed: u64, over: &'static str) -> (State, impl Fn(State) -> Setup) {
    let bounds = oblong();
    let mut random = Random::new(seed);
    let places = (0..120).map(|n| [n % 4, n / 4 % 5, n / 20]);
    let mut state = charged(places.map(|cell| {
        let x = bounds.low + 1.5 * (DVec3::from_array(cell.map(f64::from)) + 0.5) + 0.1 * random.vector();
        (x.as_vec3().as_dvec3(), if cell.iter().sum::<i32>() % 2 == 0 { 1.0 } else { -1.0 })
    }));
    state.velocity_mut().iter_mut().for_each(|v| *v = random.vector().as_vec3().as_dvec3());
    let made = move |state| {
        let numbers =
            [("range", 2.0), ("coulomb", CONSTANT), ("accuracy", 1e-4)].map(|(key, x)| (key, Value::Number(x)));
        let charges = force("coulomb", &[&numbers[..], &[("images", word("ewald")), ("over", word(over))]].concat());
        let core = force("wca", &[("sigma", Value::Number(1.2)), ("over", word("list"))]);
        let rates = [("pressure", pressure), ("time", 0.1), ("compressibility", 0.1), ("every", 5.0)];
        let box_ = force("berendsen_pressure", &rates.map(|(key, x)| (key, Value::Number(x))));
        setup(state, vec![core, charges, box_], bounds, 2e-3)
    };
    (state, made)
}

/// A box that grows beyond the waves that it had has more of them: its forces, energy and virial are those of a box that had this size from
/// the start. Its bits are those of a run that is checked after each step, and of one that goes on from its own state.
#[test]
fn a_box_that_grows_has_waves_enough() {
    for seed in [1, 2] {
        let (state, made) = pressed(-1.5, seed, "list");
        let run = |state: State, steps: &[u32]| {
            let mut simulation = on_device(&made(state));
            for some in steps {
                simulation.step(*some).expect("steps");
                block_on(simulation.check()).expect("no alarm");
            }
            simulation
        };
        let mut whole = run(state.clone(), &[300]);
        let end = block_on(whole.snapshot()).expect("a state");
        let bounds = end.boxed(&oblong());
        let grown = bounds.period().x / oblong().period().x;
        println!("{grown} of the side, {} generations", whole.generation());
        assert!(grown > 1.15 && grown < 1.5 && whole.generation() > 0, "{grown}, {} generations", whole.generation());
        let often = block_on(run(state.clone(), &[1; 300]).snapshot()).expect("a state");
        assert!(end == often, "checks change the run");
        let part = block_on(run(state, &[187]).snapshot()).expect("a state");
        let mut rest = on_device(&made(part));
        assert!(rest.goes_on());
        rest.step(113).expect("steps");
        assert!(end == block_on(rest.snapshot()).expect("a state"), "a state does not hold all of it");
        let mut forces = made(end.clone()).forces;
        forces.pop();
        let mut still = charged(end.position().iter().enumerate().map(|(i, x)| {
            let charges = end.scalar("charge").expect("charges");
            (*x, charges[i])
        }));
        still.velocity_mut().copy_from_slice(end.velocity());
        let (here, there) = (of(whole), of(on_device(&setup(still, forces, bounds, 2e-3))));
        // Phases of some ten turns, of sides that are rounded on a device or on the host.
        let largest = there.1.iter().map(|f| f.length()).fold(0.0, f64::max);
        let worst = here.1.iter().zip(&there.1).map(|(a, b)| (*a - *b).length()).fold(0.0, f64::max);
        assert!(worst < 3e-5 * largest, "{worst} of {largest}");
        assert!((here.0 - there.0).abs() < 3e-5 * there.0.abs(), "{} {}", here.0, there.0);
        let worst = here.2.iter().zip(&there.2).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(worst < 3e-5 * there.0.abs(), "{:?} {:?}", here.2, there.2);
    }
}

/// Each kernel beside a barostat agrees with its reference, in a box that grows and in one that shrinks.
#[test]
fn kernels_agree_in_a_box_that_changes() {
    for pressure in [-1.5, 4.0] {
        let (state, made) = pressed(pressure, 3, "list");
        agrees(&made(state), 12, 20.0, &["box", "berendsen_pressure"]);
    }
}

/// Where steps cannot be repeated, and where a box that may grow would have too many waves.
#[test]
fn boxes_that_cannot_grow_are_refused() {
    let (state, made) = pressed(0.0, 1, "within");
    let says = |setup: &Setup, what: &str| {
        let error = Simulation::on(gpu(&crate::support::device(), 120), setup).err().expect("refused").to_string();
        assert!(error.contains(what), "{error}");
    };
    says(&made(state), "`coulomb` needs more waves in a larger one: choose over = \"list\"");
    let (state, made) = pressed(0.0, 1, "list");
    let mut setup = made(state);
    let range = 0.6;
    let numbers = [("range", range), ("accuracy", 1e-4)].map(|(key, x)| (key, Value::Number(x)));
    setup.forces[1] = force("coulomb", &[&numbers[..], &[("images", word("ewald")), ("over", word("list"))]].concat());
    says(&setup, "which a barostat changes, and there may be 32768: raise range to");
    // Without a barostat it is one.
    setup.forces.pop();
    Simulation::on(gpu(&crate::support::device(), 120), &setup).expect("a simulation");
}

#[test]
fn what_cannot_be_summed_is_refused() {
    let bounds = oblong();
    let says = |law: Box<dyn Component>, bounds: &Bounds, what: &str| {
        let error = law.check(bounds).expect_err("refused").to_string();
        assert!(error.contains(what), "{error}");
    };
    says(coulomb(3.1, 1e-4, 0.0), &bounds, "the shortest side is 6: the law between two must end at half of it, 3");
    says(coulomb(2.0, 1e-11, 0.0), &bounds, "accuracy = 1e-11");
    says(coulomb(2.0, 0.2, 0.0), &bounds, "to 0.1");
    says(coulomb(0.05, 1e-4, 0.0), &bounds, "raise range to");
    says(coulomb(2.0, 1e-4, 0.0), &Bounds::default(), "periodic on all sides");
    let slab = Bounds { sides: [Side::Periodic, Side::Periodic, Side::Reflecting], ..bounds };
    says(coulomb(2.0, 1e-4, 0.0), &slab, "periodic on all sides");
    let water = [("range", Value::Number(2.0)), ("images", word("ewald")), ("permittivity", Value::Number(78.5))];
    says(force("coulomb", &water), &bounds, "permittivity = 78.5 beside images = \"ewald\"");
    // Counted, where the estimate, 63 936, is below the limit.
    let long = periodic(DVec3::ZERO, DVec3::new(4275.36, 2.0, 2.0));
    says(coulomb(1.0, 0.02, 0.0), &long, "raise accuracy, or choose a box that is less oblong");
    // Corners are rounded.
    let corner = periodic(DVec3::splat(0.3), DVec3::splat(0.3 + 0.6));
    assert!(coulomb(0.3, 1e-3, 0.0).check(&corner).is_ok());
    // The way out is one.
    let error = coulomb(0.05, 1e-4, 0.0).check(&bounds).expect_err("refused").to_string();
    let range = error.split("raise range to ").nth(1).and_then(|rest| rest.split(' ').next()).expect("a range");
    assert!(coulomb(range.parse().expect("a number"), 1e-4, 0.0).check(&bounds).is_ok(), "{error}");
}
