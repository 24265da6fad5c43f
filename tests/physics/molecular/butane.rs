//! Liquid butane of united atoms (TraPPE: Martin & Siepmann 1998), from a scene that copies one molecule, against LAMMPS: bonds, angles,
//! dihedrals, and pairs more than three bonds apart. And single dihedrals.

use std::f64::consts::PI;
use std::path::PathBuf;

use glam::DVec3;
use motes::kernel::Backend;
use motes::links::{Dihedral, Joint};
use motes::scene::{Options, Scene, Source};
use motes::{Setup, Simulation, State};
use pollster::block_on;

use super::{periodic, setup};
use crate::matter::on_cpu;
use crate::support::states::{force, one};

const MOLECULES: usize = 64;
const EDGE: f64 = 22.0;

const SCENE: &str = r#"
[simulation]
dt = 0.001
steps = 100
[box]
size = [22, 22, 22]
[[particles]]
bodies = [
  { position = [0, 0, 0], mass = 15.035, species = 0 },
  { position = [1.54, 0, 0], mass = 14.027, species = 1 },
  { position = [2.166, 1.407, 0], mass = 14.027, species = 1 },
  { position = [3.706, 1.407, 0], mass = 15.035, species = 0 },
]
copies = 64
arrangement = "lattice"
separation = 2.8
temperature = 273
[[links]]
pairs = [[0, 1], [1, 2], [2, 3]]
stiffness = 450000
copies = 64
[[links]]
joints = [[0, 1, 2], [1, 2, 3]]
angle = 114
stiffness = 62500
copies = 64
[[links]]
dihedrals = [[0, 1, 2, 3]]
stiffness = 355.03
copies = 64
[[links]]
dihedrals = [[0, 1, 2, 3]]
stiffness = 68.19
multiplicity = 2
copies = 64
[[links]]
dihedrals = [[0, 1, 2, 3]]
stiffness = 791.32
multiplicity = 3
copies = 64
[[force]]
kind = "lennard_jones"
over = "list"
range = 9
pairs = [{ species = [0, 0], epsilon = 98, sigma = 3.75 }, { species = [1, 1], epsilon = 46, sigma = 3.95 }]
exclude = 3
[[force]]
kind = "spring"
[[force]]
kind = "joint"
[[force]]
kind = "dihedral"
"#;

/// What LAMMPS (22 July 2025, `benches/butane.py`) has of the same start, in f64: the step; the potential energy, less 68.19 · 2 of each dihedral,
/// which its `opls` counts from another level; the kinetic energy; the pressure along each axis.
const LAMMPS: [(u32, f64, f64, [f64; 3]); 2] = [
    (0, 51_469.647_933, 104_422.5, [56.607_565_24, 80.012_211_90, 75.503_793_78]),
    (100, -37_545.807_526, 193_475.349_803, [40.974_455_33, 31.578_503_78, 22.442_913_94]),
];
/// And where some atoms are after 100 steps.
const PLACES: [(usize, [f64; 3]); 7] = [
    (0, [2.966_930_834_8, 3.762_881_010_6, 1.705_870_726_6]),
    (1, [3.125_450_178_2, 2.505_167_328_9, 2.561_825_980_1]),
    (2, [2.232_318_620_3, 2.444_439_671_0, 3.833_431_335_7]),
    (3, [2.641_550_862_4, 1.463_378_161_8, 4.908_490_524_4]),
    (41, [14.050_522_107_1, 14.680_752_779_5, 3.087_116_762_6]),
    (70, [8.191_512_127_6, 2.176_962_343_3, 7.811_146_381_2]),
    (255, [18.147_344_824_9, 20.995_167_861_5, 17.756_398_187_0]),
];

fn start() -> Setup {
    let source = Source::Text { name: "butane.toml".to_owned(), text: SCENE.to_owned(), folder: PathBuf::from(".") };
    let scene = Scene::load(&source, &[], &Options::default()).unwrap_or_else(|faults| panic!("{faults}"));
    assert_eq!(scene.particles.len(), 4 * MOLECULES);
    crate::support::scenes::setup(scene)
}

/// Energies and pressures, each off by these parts of what they are made of: the kinetic energy, and that divided by the volume.
fn assert_lammps<B: Backend>(simulation: &mut Simulation<B>, part: f64) {
    let mut done = 0;
    for (step, potential, kinetic, pressure) in LAMMPS {
        simulation.step(step - done).expect("steps");
        done = step;
        let state = block_on(simulation.snapshot()).expect("a state");
        let level = 2.0 * 68.19 * MOLECULES as f64;
        let own: f64 = state.energies().expect("energies").iter().sum::<f64>() - level;
        let twice = |axis: usize| -> f64 {
            state.velocity().iter().zip(state.mass()).map(|(v, m)| m * v[axis] * v[axis]).sum()
        };
        let moving = 0.5 * (0..3).map(twice).sum::<f64>();
        assert!((own - potential).abs() < part * kinetic, "step {step}: {own} is not {potential}");
        assert!((moving - kinetic).abs() < part * kinetic, "step {step}: {moving} is not {kinetic}");
        let virial = block_on(simulation.virial()).expect("a virial");
        for axis in 0..3 {
            let push = (twice(axis) + virial[axis]) / EDGE.powi(3);
            let off = (push - pressure[axis]).abs();
            assert!(
                off < 10.0 * part * kinetic / EDGE.powi(3),
                "step {step}, axis {axis}: {push} is not {}",
                pressure[axis]
            );
        }
    }
}

/// The references differ from LAMMPS by coefficients in tables, which are single precision, 6e-8: in 100 steps the fastest bond, ω = 250, turns
/// by 25, so that its phase is off by 25 · 3e-8, and a place by that of an amplitude of 0.2. Energies that go up and down by all of the kinetic
/// energy are off by as much.
#[test]
fn butane_goes_where_it_goes_in_lammps() {
    let setup = start();
    let mut cpu = on_cpu(&setup);
    assert_lammps(&mut cpu, 2e-6);
    let state = block_on(cpu.snapshot()).expect("a state");
    for (id, place) in PLACES {
        let off = (state.position()[id] - DVec3::from(place)).abs().max_element();
        assert!(off < 1e-6, "{id}: {} is not {place:?}", state.position()[id]);
    }
}

/// On the device all is single precision: places up to 22 are rounded by 1e-6, and forces of bonds, 4.5e5 · 1e-6, by 0.5 of some 1e4, so that
/// energies are off by 5e-5 of the kinetic energy times the root of what adds up, from which runs part in 100 steps by a factor of a few.
#[test]
fn butane_has_the_energies_of_lammps_on_the_device() {
    let setup = start();
    let gpu = crate::support::machines::gpu(&crate::support::device(), setup.state.len());
    assert_lammps(&mut Simulation::on(gpu, &setup).expect("a simulation"), 2e-4);
}

/// Four particles with a right angle at each of the two between, and this dihedral angle: seen along the bond between, the far one is turned
/// clockwise for angles above 0, as IUPAC has it.
fn four(angle: f64) -> State {
    let (sine, cosine) = angle.sin_cos();
    let mut state = one(DVec3::new(0.0, 1.0, 0.0), DVec3::ZERO);
    for x in [DVec3::ZERO, DVec3::X, DVec3::new(1.0, cosine, sine)] {
        state.push(x, DVec3::ZERO, 1.0, 0.0);
    }
    state
}

/// Cis is 0, trans is π, and turns have a sign, in energies and in the torque about the bond.
#[test]
fn dihedrals_have_their_angles() {
    let box_of = periodic(DVec3::splat(-5.0), DVec3::splat(5.0));
    for angle in [0.0, 0.4, -0.4, 1.5, -2.6, PI] {
        for (multiplicity, phase) in [(1, 0.0), (1, 0.5 * PI), (2, 0.3), (3, -2.0), (12, 1.0)] {
            let mut state = four(angle);
            state.links.dihedrals.push(Dihedral { ids: [0, 1, 2, 3], stiffness: 1.5, multiplicity, phase });
            state.links.check(state.mass()).expect("a dihedral");
            let setup = setup(state, vec![force("dihedral", &[])], box_of, 1e-3);
            let n = f64::from(multiplicity);
            let energy = 1.5 * (1.0 + (n * angle - phase).cos());
            // −dE / dφ, at a lever of 1.
            let torque = 1.5 * n * (n * angle - phase).sin();
            let far = torque * DVec3::new(0.0, -angle.sin(), angle.cos());
            let check = |potential: f64, pull: DVec3, allowed: f64| {
                assert!((potential - energy).abs() < allowed, "{angle}, {n}, {phase}: {potential} is not {energy}");
                assert!((pull - far).length() < n * allowed, "{angle}, {n}, {phase}: {pull} is not {far}");
            };
            let mut cpu = on_cpu(&setup);
            cpu.step(0).expect("a start");
            let total = |state: State| state.energies().expect("energies").iter().sum::<f64>();
            let at_last = block_on(cpu.read(motes::ACCELERATION)).expect("accelerations")[3].truncate().as_dvec3();
            check(total(block_on(cpu.snapshot()).expect("a state")), at_last, 3e-6);
            let gpu = crate::support::machines::gpu(&crate::support::device(), setup.state.len());
            let mut gpu = Simulation::on(gpu, &setup).expect("a simulation");
            gpu.step(0).expect("a start");
            let at_last = block_on(gpu.read(motes::ACCELERATION)).expect("accelerations")[3].truncate().as_dvec3();
            // Powers of a unit vector, each rounded: 12 · 1.2e-7 of 1.5, and n times that of the torque.
            check(total(block_on(gpu.snapshot()).expect("a state")), at_last, 1e-5);
        }
    }
}

/// Where three are in a line there is no plane and no force; nor where a joint is straight and should be bent.
#[test]
fn angles_that_are_none_exert_nothing() {
    let mut state = one(DVec3::ZERO, DVec3::ZERO);
    (1..4).for_each(|n| state.push(DVec3::X * f64::from(n), DVec3::ZERO, 1.0, 0.0));
    state.links.dihedrals.push(Dihedral { ids: [0, 1, 2, 3], stiffness: 1.0, multiplicity: 1, phase: 0.5 });
    state.links.joints.push(Joint { ids: [0, 1, 2], stiffness: 1.0, rest: 1.0 });
    let forces = vec![force("dihedral", &[]), force("joint", &[])];
    let setup = setup(state, forces, periodic(DVec3::splat(-9.0), DVec3::splat(9.0)), 1e-3);
    let mut cpu = on_cpu(&setup);
    let gpu = crate::support::machines::gpu(&crate::support::device(), setup.state.len());
    let mut gpu = Simulation::on(gpu, &setup).expect("a simulation");
    cpu.step(0).expect("a start");
    gpu.step(0).expect("a start");
    for a in [
        block_on(cpu.read(motes::ACCELERATION)).expect("numbers"),
        block_on(gpu.read(motes::ACCELERATION)).expect("numbers"),
    ] {
        // The energy of the joint, ½, is there.
        assert!(a.iter().all(|a| a.truncate().length() == 0.0 && a.w.is_finite()), "{a:?}");
        assert!((a.iter().map(|a| a.w).sum::<f32>() - 0.5).abs() < 1e-6, "{a:?}");
    }
}
