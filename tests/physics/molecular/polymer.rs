//! Bonds of polymers, and the pressure of molecules.

use glam::{DMat3, DVec3};
use motes::forces::Component;
use motes::kernel::Backend;
use motes::links::{Dihedral, Joint, Link, Links};
use motes::settings::{Settings, Value};
use motes::{Bounds, Setup, Simulation, State};
use pollster::block_on;

use super::{periodic, setup};
use crate::matter::{on_cpu, spread};
use crate::support::Random;
use crate::support::states::{accelerations, force, one, word};

/// Chains of beads on a lattice at a density of 0.85.
fn chains(size: f64, beads: f64, seed: f64, temperature: f64) -> (State, Bounds) {
    let shape = motes::shapes::shape("chains").expect("a shape");
    let spacing = (1.0 / 0.85_f64).cbrt();
    let values = [("beads", beads), ("spacing", spacing), ("seed", seed), ("temperature", temperature)];
    let settings = Settings::defaults(shape.keys).with("size", Value::Vector(DVec3::splat(size)));
    let settings = values.into_iter().fold(settings, |all, (key, x)| all.with(key, x.into()));
    let half = DVec3::splat(0.5 * size * spacing);
    ((shape.build)(&settings).expect("chains"), periodic(-half, half))
}

fn fene() -> Box<dyn Component> {
    force("fene", &[])
}

fn bead_spring(over: &'static str) -> Vec<Box<dyn Component>> {
    vec![force("wca", &[("over", word(over)), ("skin", Value::Number(if over == "list" { 0.4 } else { 0.0 }))]), fene()]
}

fn bond(ends: [u32; 2], stiffness: f64) -> Link {
    Link { ends, rest: 0.0, stiffness, damping: 0.0, rope: false }
}

/// At 0.97 σ, by hand: 1 − (0.97 / 1.5)² = 0.5818222; U = −33.75 ln 0.5818222 = 18.2787, F = 30 · 0.97 / 0.5818222 = 50.0153.
#[test]
fn a_bond_has_the_energy_and_the_force_of_kremer_and_grest() {
    let mut two = one(DVec3::ZERO, DVec3::ZERO);
    two.push(DVec3::new(0.0, 0.97, 0.0), DVec3::ZERO, 2.0, 0.0);
    two.links.springs.push(bond([0, 1], 30.0));
    let a = accelerations(&[fene()], &two, 0.0);
    assert!((a[0].y - 50.0153).abs() < 1e-4 && (a[1].y + 25.00765).abs() < 1e-4, "{a:?}");
    // Each has its half.
    let energy = a[0].w + 2.0 * a[1].w;
    assert!((energy - 18.2787).abs() < 1e-4, "{energy}");
}

/// A chain of which one bond is too long, and one with ends that fly apart in steps that are far too long.
#[test]
fn a_bond_that_is_too_long_ends_the_run_and_is_named() {
    let start = |lengths: [f64; 4], speed: f64| {
        let (mut state, mut x) = (one(DVec3::ZERO, DVec3::ZERO), 0.0);
        for (id, length) in (1..).zip(lengths) {
            x += length;
            state.push(DVec3::new(x, 0.0, 0.0), DVec3::X * if id > 2 { speed } else { 0.0 }, 1.0, 0.0);
            state.links.springs.push(bond([id - 1, id], 30.0));
        }
        state
    };
    let bounds = periodic(DVec3::splat(-6.0), DVec3::splat(6.0));
    let good = setup(start([0.97, 0.97, 1.4999, 0.97], 0.0), vec![fene()], bounds, 1e-4);
    let long = setup(start([0.97, 0.97, 1.6, 0.97], 0.0), vec![fene()], bounds, 1e-4);
    let fast = setup(start([0.97, 0.97, 0.97, 0.97], 40.0), vec![fene()], bounds, 1e-2);
    // A link without stiffness is no bond, and one that another law pulls may be long.
    let mut slack = long.clone();
    (slack.state.links.springs[2].stiffness, slack.state.links.springs[2].damping) = (0.0, 0.1);
    let run = |setup: &Setup, device: bool| -> Result<(), motes::Error> {
        if device {
            let shared = crate::support::device();
            let mut simulation = Simulation::on(crate::support::machines::gpu(&shared, 5), setup)?;
            simulation.step(8)?;
            return block_on(simulation.check());
        }
        let mut simulation = on_cpu(setup);
        simulation.step(8)?;
        block_on(simulation.check())
    };
    for device in [false, true] {
        assert!(run(&good, device).is_ok() && run(&slack, device).is_ok(), "{device}");
        for (setup, first) in [(&long, 0..1), (&fast, 1..8)] {
            let error = run(setup, device).expect_err("a bond that is too long");
            assert!(
                matches!(error, motes::Error::Overlong { particle: 2, step, .. } if first.contains(&step)),
                "{error:?}"
            );
            let text = error.to_string();
            assert!(text.contains("the bond of particles 2 and 3 reached its maximum length 1.5"), "{text}");
            assert!(text.contains("smaller dt") && error.exit_code() == 6, "{text}");
        }
    }
    let said = motes::diagnose::advice(&long, None).expect("remarks").into_iter().map(|remark| remark.text.clone());
    let said: Vec<String> = said.filter(|text| text.contains("bond")).collect();
    assert!(
        said.len() == 1 && said[0].contains("the bond of particles 2 and 3 is 1.6000 long at the start"),
        "{said:?}"
    );
}

/// Molecules of four with bonds, springs and joints, at places that single precision holds.
fn molecules(count: usize, spacing: f64) -> State {
    let mut state = spread(count, spacing);
    state.position_mut().iter_mut().for_each(|x| *x = (*x * 1024.0).round() / 1024.0);
    let mut random = Random::new(7);
    let mut links = Links::default();
    for first in (0..u32::try_from(count).expect("few") - 3).step_by(4) {
        for i in first..first + 3 {
            let stiffness = f64::from((20.0 + 9.0 * random.next()) as f32);
            links.springs.push(Link { rest: 0.75, ..bond([i, i + 1], stiffness) });
        }
        links.joints.extend([first, first + 1].map(|i| Joint { ids: [i, i + 1, i + 2], stiffness: 3.5, rest: 0.75 }));
        let phase = f64::from(first % 7) - 3.0;
        links.dihedrals.push(Dihedral { ids: [0, 1, 2, 3].map(|n| first + n), stiffness: 2.0, multiplicity: 2, phase });
    }
    // Neighbours along x but for the ends of rows.
    let apart = |ids: &[u32]| {
        ids.windows(2).all(|ids| state.position()[ids[0] as usize].distance(state.position()[ids[1] as usize]) < 2.0)
    };
    links.springs.retain(|link| apart(&link.ends));
    links.joints.retain(|joint| apart(&joint.ids));
    links.dihedrals.retain(|dihedral| apart(&dihedral.ids));
    assert!(links.springs.len() > count / 2 && links.joints.len() > count / 4 && links.dihedrals.len() > count / 10);
    state.links = links;
    state
}

fn every() -> Vec<Box<dyn Component>> {
    let fene = force("fene", &[("max_length", Value::Number(2.25))]);
    vec![
        force("wca", &[("over", word("within"))]),
        fene,
        force("spring", &[]),
        force("joint", &[]),
        force("dihedral", &[]),
    ]
}

fn virial(state: &State, bounds: Bounds, laws: Vec<Box<dyn Component>>) -> [f64; 6] {
    block_on(on_cpu(&setup(state.clone(), laws, bounds, 1e-3)).virial()).expect("a virial")
}

/// W = −dU/dε along each axis, as for pairs in `pressure.rs`. U″ of `wca` jumps by 57 at its end, for the pairs within h r of it, some 7 of 500 particles:
/// 57 · 1.26 h · 7 / 2 = 0.25 of some 1e3.
#[test]
fn the_virial_of_molecules_is_the_slope_of_their_energy() {
    let side = DVec3::splat(8.5);
    let mut state = molecules(512, 1.0625);
    state.position_mut().iter_mut().for_each(|x| *x = x.rem_euclid(side));
    let energy = |strain: DVec3| -> f64 {
        let mut state = state.clone();
        state.position_mut().iter_mut().for_each(|x| *x *= DVec3::ONE + strain);
        let setup = setup(state, every(), periodic(DVec3::ZERO, side * (DVec3::ONE + strain)), 1e-3);
        block_on(on_cpu(&setup).snapshot()).expect("a state").energies().expect("energies").iter().sum()
    };
    let got = virial(&state, periodic(DVec3::ZERO, side), every());
    for (axis, along) in [DVec3::X, DVec3::Y, DVec3::Z].into_iter().enumerate() {
        let h = 1.0 / 1024.0;
        let across = |n: f64| energy(-n * h * along) - energy(n * h * along);
        let want = (8.0 * across(1.0) - across(2.0)) / (12.0 * h);
        println!("{axis}: {} {want}", got[axis]);
        assert!((got[axis] - want).abs() < 0.5 && want.abs() > 50.0, "{axis}: {} is not {want}", got[axis]);
    }
    // Of each law alone: none of them is lost in the others. A joint has no scale, so that its trace is 0.
    for (law, traceless) in every().into_iter().zip([false, false, false, true]) {
        let name = law.laws()[0].name.clone();
        let own = virial(&state, periodic(DVec3::ZERO, side), vec![law]);
        let trace = own[..3].iter().sum::<f64>();
        assert!(own.iter().all(|w| w.abs() > 0.1), "{name}: {own:?}");
        assert_eq!(trace.abs() < 1e-9 * own[0].abs().max(1.0), traceless, "{name}: {own:?}");
    }
}

/// Molecules that are turned as a whole have a virial that is turned: R W Rᵀ, so that shears are as right as what is along the axes.
#[test]
fn the_virial_of_molecules_turns_with_them() {
    let state = molecules(64, 1.1);
    let tensor = |w: [f64; 6]| DMat3::from_cols_array(&[w[0], w[5], w[4], w[5], w[1], w[3], w[4], w[3], w[2]]);
    let rotation = DMat3::from_axis_angle(DVec3::new(0.48, -0.6, 0.64), 0.9);
    let mut turned = state.clone();
    turned.position_mut().iter_mut().for_each(|x| *x = rotation * *x);
    for law in 0..4 {
        let of = |state: &State| tensor(virial(state, Bounds::default(), vec![every().swap_remove(law)]));
        let (here, there) = (of(&state), of(&turned));
        let want = rotation * here * rotation.transpose();
        let off = (there - want).to_cols_array().iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let size = here.to_cols_array().iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        // Positions of single precision: 6e-8 of 5, over a bond of 1, of which steep parts are 100 times as steep as they are large.
        assert!(off < 1e-4 * size && size > 0.1, "{law}: {there} is not {want}");
    }
}

/// On the device, by both of the tables of links: to some roundings of sums that cancel.
#[test]
fn the_virial_of_molecules_is_the_same_on_the_device() {
    let bounds = periodic(DVec3::ZERO, DVec3::splat(8.5));
    let mut state = molecules(512, 1.0625);
    state.position_mut().iter_mut().for_each(|x| *x = x.rem_euclid(DVec3::splat(8.5)));
    let mut alike = state.clone();
    alike.links.springs.iter_mut().for_each(|link| (link.stiffness, link.damping) = (25.0, 0.25));
    for state in [state, alike] {
        let setup = setup(state, every(), bounds, 1e-3);
        let shared = crate::support::device();
        let mut gpu = Simulation::on(crate::support::machines::gpu(&shared, 512), &setup).expect("a simulation");
        let (got, want) =
            (block_on(gpu.virial()).expect("a virial"), block_on(on_cpu(&setup).virial()).expect("a virial"));
        let size = want.iter().map(|w| w.abs()).fold(0.0, f64::max);
        let off = got.iter().zip(want).map(|(got, want)| (got - want).abs()).fold(0.0, f64::max);
        assert!(off < 3e-6 * size, "{got:?} is not {want:?}");
    }
}

/// Molecules that do not act on each other are an ideal gas of molecules, whatever their bonds: P V = N k T. Bond vectors of `fene` are drawn
/// from r² (1 − r² / R²)^(K R² / 2 k T), velocities from Maxwell's distribution, directions are free, and joints have no part in the pressure.
/// For n molecules of 4: 3 P V has the mean 3 · 4 n − 3 · 3 n = 3 n, and the variance 2 · 3 · 4 n + 3 n · V, where V = 6.8 is that of r F of a bond
/// (6 for a harmonic one), so that the standard error is √(24 + 20) n^½ / 3.
#[test]
fn molecules_that_do_not_interact_are_an_ideal_gas() {
    const MOLECULES: u32 = 1500;
    for seed in [1, 2, 3] {
        let mut random = Random::new(seed);
        let mut uniform = || 0.5 * (random.next() + 1.0);
        let mut state = State::default();
        let (longest, stiffness, heat) = (1.5_f64, 30.0, 1.0);
        for molecule in 0..MOLECULES {
            let mut x = DVec3::new(uniform(), uniform(), uniform()) * 40.0;
            for bead in 0..4 {
                if bead > 0 {
                    let power = stiffness * longest * longest / (2.0 * heat);
                    let part = |r: f64| r * r * (1.0 - r * r / longest / longest).powf(power);
                    // The largest is at r² = R² / (1 + power).
                    let most = part(longest / (1.0 + power).sqrt());
                    let length = loop {
                        let r = longest * uniform();
                        if uniform() * most < part(r) {
                            break r;
                        }
                    };
                    let (z, angle) = (2.0 * uniform() - 1.0, std::f64::consts::TAU * uniform());
                    let ring = (1.0 - z * z).sqrt();
                    x += length * DVec3::new(ring * angle.cos(), ring * angle.sin(), z);
                }
                let mut normal =
                    || (-2.0 * uniform().max(1e-300).ln()).sqrt() * (std::f64::consts::TAU * uniform()).cos();
                state.push(x, DVec3::new(normal(), normal(), normal()), 1.0, 0.0);
                let id = 4 * molecule + bead;
                if bead > 0 {
                    state.links.springs.push(bond([id - 1, id], stiffness));
                }
                if bead > 1 {
                    state.links.joints.push(Joint { ids: [id - 2, id - 1, id], stiffness: 2.0, rest: 0.0 });
                }
            }
        }
        let bounds = periodic(DVec3::ZERO, DVec3::splat(40.0));
        let twice: f64 = state.velocity().iter().map(|v| v.length_squared()).sum();
        let trace: f64 = virial(&state, bounds, vec![fene(), force("joint", &[])])[..3].iter().sum();
        let (got, n) = ((twice + trace) / 3.0, f64::from(MOLECULES));
        let error = (44.0 * n).sqrt() / 3.0;
        println!("{seed}: {got} of {n} ± {error}");
        assert!((got - n).abs() < 4.0 * error, "{seed}: {got} is not {n} ± {error}");
    }
}

/// Potential energy, kinetic temperature and pressure.
fn measured<B: Backend>(simulation: &mut Simulation<B>, volume: f64) -> [f64; 3] {
    let state = block_on(simulation.snapshot()).expect("a state");
    let count = state.len() as f64;
    let potential: f64 = state.scalar("potential").expect("a column").iter().sum();
    let twice: f64 = state.velocity().iter().map(|v| v.length_squared()).sum();
    let virial = block_on(simulation.virial()).expect("a virial");
    [potential / count, twice / (3.0 * count - 3.0), (twice + virial[..3].iter().sum::<f64>()) / (3.0 * volume)]
}

/// Twenty chains of 50 from the lattice, in steps of 0.005 without a thermostat: LAMMPS 22 July 2025 (`pair_style lj/cut` to 2^(1/6), shifted; `bond_style fene`
/// with ε = 0, `special_bonds lj 1 1 1`) from the same positions and velocities, rounded to f32. Seen: 3e-8 and 3e-7 of energy and pressure at step 0,
/// that is sums of f32; 2e-7, 2e-6 and 4e-6 of energy, temperature and pressure at step 100, where rounding has grown. 2e-4 is what the
/// temperature changes by in a twentieth of a step there.
#[test]
fn a_melt_has_the_energies_and_the_pressures_of_lammps() {
    let seeds = [
        (1.0, [[23.210_705_36, 1.0, -10.985_689_71], [21.672_241_47, 2.019_786_865, 8.464_147_175]]),
        (2.0, [[23.210_705_4, 1.0, -10.985_689_75], [21.692_715_6, 2.005_822_881, 8.023_167_147]]),
    ];
    for (seed, known) in seeds {
        let (state, bounds) = chains(10.0, 50.0, seed, 1.0);
        let setup = setup(state, bead_spring("list"), bounds, 0.005);
        let shared = crate::support::device();
        let mut simulation =
            Simulation::on(crate::support::machines::gpu(&shared, 1000), &setup).expect("a simulation");
        for (steps, [potential, temperature, pressure]) in [0, 100].into_iter().zip(known) {
            simulation.step(steps).expect("steps");
            let [is, heat, push] = measured(&mut simulation, 1000.0 / 0.85);
            println!("{seed} {steps}: {is} {heat} {push}");
            let allowed = if steps == 0 { 1e-6 } else { 2e-4 };
            assert!((is / potential - 1.0).abs() < allowed, "{seed}, step {steps}: {is} is not {potential}");
            assert!((heat / temperature - 1.0).abs() < allowed, "{seed}, step {steps}: {heat} is not {temperature}");
            assert!((push / pressure - 1.0).abs() < 3.0 * allowed, "{seed}, step {steps}: {push} is not {pressure}");
        }
    }
}

/// The melt of Kremer & Grest at T = 1: bonds have a mean length of 0.97 σ there. LAMMPS from the same start, 600 000 steps of 0.006, at T = 1.0023(8):
/// mean bond 0.96472(1), mean square 0.93176(3), potential energy 20.752(1), pressure 4.935(4); the means of 40 samples that are 50 steps apart, as here, have
/// standard deviations of 0.00017, 0.0003, 0.010 and 0.057. Four of them are allowed, and what a temperature changes that is off by 0.01: 0.02 and 0.06.
#[test]
#[ignore = "minutes on a software adapter: `tests/run --test physics --test commands -- --include-ignored` runs it"]
fn a_melt_has_the_bonds_and_the_pressure_of_kremer_and_grest() {
    for seed in [1.0, 2.0] {
        let (state, bounds) = chains(10.0, 50.0, seed, 1.0);
        let bonds = state.links.springs.clone();
        let bath = [("temperature", Value::Number(1.0)), ("friction", Value::Number(0.5))];
        let mut forces = bead_spring("list");
        forces.push(force("langevin", &bath));
        let setup = setup(state, forces, bounds, 0.006);
        let shared = crate::support::device();
        let mut simulation =
            Simulation::on(crate::support::machines::gpu(&shared, 1000), &setup).expect("a simulation");
        simulation.step(3000).expect("steps");
        let mut sums = [0.0; 5];
        for _ in 0..40 {
            simulation.step(50).expect("steps");
            let [potential, heat, pressure] = measured(&mut simulation, 1000.0 / 0.85);
            let state = block_on(simulation.snapshot()).expect("a state");
            let length = |link: &Link| {
                let [a, b] = link.ends.map(|id| state.position()[id as usize]);
                bounds.shortest(b - a).length()
            };
            let count = bonds.len() as f64;
            let mean = bonds.iter().map(length).sum::<f64>() / count;
            let square = bonds.iter().map(|bond| length(bond).powi(2)).sum::<f64>() / count;
            let all = [mean, square, potential, pressure, heat];
            sums.iter_mut().zip(all).for_each(|(sum, x)| *sum += x / 40.0);
        }
        block_on(simulation.check()).expect("bonds that hold");
        println!("{seed}: {sums:?}");
        let known = [(0.964_72, 0.0007), (0.931_76, 0.0013), (20.752, 0.06), (4.935, 0.3), (1.0, 0.02)];
        for (got, (want, allowed)) in sums.into_iter().zip(known) {
            assert!((got - want).abs() < allowed, "{seed}: {got} is not {want}: {sums:?}");
        }
    }
}

/// One step of linearized backward Euler on two particles of mass 1: along the bond and across it, Δv = −2 h (F + h k v) / (1 + 2 h² k) of the relative
/// velocity, with k = K (1 + x) / (1 − x)² along and K / (1 − x) across, x = (r / R)², and F only along.
#[test]
fn implicit_steps_know_the_stiffness_of_bonds() {
    let (length, stiffness, h) = (1.2, 30.0, 0.1);
    let mut two = one(DVec3::ZERO, DVec3::ZERO);
    two.push(DVec3::new(length, 0.0, 0.0), DVec3::new(0.3, 0.2, 0.0), 1.0, 0.0);
    two.links.springs.push(bond([0, 1], stiffness));
    let solver = motes::Solver { tolerance: 1e-6, iterations: 50, ..motes::Solver::default() };
    let integrator = crate::support::states::integrator("linear_backward_euler");
    let bounds = Bounds::default();
    let mut simulation = on_cpu(&Setup { state: two, forces: vec![fene()], integrator, dt: h, bounds, solver });
    simulation.step(1).expect("a step");
    let state = block_on(simulation.snapshot()).expect("a state");
    let got = state.velocity()[1] - state.velocity()[0];
    let left = 1.0 - (length / 1.5).powi(2);
    let step = |force: f64, k: f64, v: f64| v - 2.0 * h * (force + h * k * v) / (1.0 + 2.0 * h * h * k);
    let along = step(stiffness * length / left, stiffness * (2.0 - left) / left / left, 0.3);
    let want = DVec3::new(along, step(0.0, stiffness / left, 0.2), 0.0);
    // A snapshot has single precision.
    assert!((got - want).length() < 1e-5 * want.length(), "{got} is not {want}");
}

/// A bond at 0.97 σ between beads of mass 1: k = 30 (1 + x) / (1 − x)² = 125.7, ω² = 2 k, and leapfrog is stable up to 2 / ω = 0.1261.
#[test]
fn steps_that_are_too_long_for_a_bond_are_known() {
    let mut two = one(DVec3::ZERO, DVec3::ZERO);
    two.push(DVec3::new(0.97, 0.0, 0.0), DVec3::ZERO, 1.0, 0.0);
    two.links.springs.push(bond([0, 1], 30.0));
    let safe = |forces: Vec<Box<dyn Component>>| {
        let setup = setup(two.clone(), forces, Bounds::default(), 0.01);
        let build = || crate::support::states::integrator("leapfrog");
        block_on(motes::stability::Verdict::of(&setup, &build, 10_000)).expect("a verdict").map(|verdict| verdict.safe)
    };
    let got = safe(vec![fene()]).expect("bonds");
    assert!((got / 0.126_1 - 1.0).abs() < 2e-3, "{got}");
    // With a spring of 30 beside it, of rest length 0: 2 / √(2 (125.7 + 30)).
    let both = safe(vec![fene(), force("spring", &[])]).expect("bonds");
    assert!((both / 0.113_3 - 1.0).abs() < 2e-3, "{both}");
    assert!(safe(vec![force("wca", &[])]).is_none());
}

/// A barostat counts bonds: on the lattice they pull at a pressure of −11, so that a box that is kept at none shrinks, and without them it
/// would grow. The device and the references have the same box, by a relative change of some 1e-2.
#[test]
fn a_barostat_counts_bonds() {
    let (state, bounds) = chains(6.0, 4.0, 1.0, 1.0);
    let barostat = |bonds: bool| {
        let mut setup = setup(state.clone(), bead_spring("list"), bounds, 0.002);
        setup.forces.truncate(if bonds { 2 } else { 1 });
        let numbers = [("pressure", 0.0), ("compressibility", 0.02), ("time", 0.2), ("every", 2.0)];
        setup.forces.push(force("berendsen_pressure", &numbers.map(|(key, x)| (key, Value::Number(x)))));
        setup
    };
    let side = |state: &State| (state.boxed(&bounds).high - state.boxed(&bounds).low).x;
    let start = bounds.high.x - bounds.low.x;
    let cpu = |setup: &Setup| {
        let mut simulation = on_cpu(setup);
        simulation.step(20).expect("steps");
        side(&block_on(simulation.snapshot()).expect("a state")) / start - 1.0
    };
    let shared = crate::support::device();
    let gpu = crate::support::machines::gpu(&shared, 216);
    let mut simulation = Simulation::on(gpu, &barostat(true)).expect("a simulation");
    simulation.step(20).expect("steps");
    let device = side(&block_on(simulation.snapshot()).expect("a state")) / start - 1.0;
    let (with, without) = (cpu(&barostat(true)), cpu(&barostat(false)));
    println!("{with} {device} {without}");
    assert!(with < -3e-3 && without > 1e-3, "{with} {without}");
    assert!((device / with - 1.0).abs() < 1e-3, "{device} is not {with}");
}
