//! Flexible water (SPC/Fw: Wu, Tepper & Voth, J. Chem. Phys. 124, 024503, 2006), from a scene that copies one molecule, against LAMMPS: charges of
//! all images, without pairs of bonds, in units of Å, ps and g / mol, so that energies are in 0.01 kJ / mol.

use std::path::PathBuf;

use glam::DVec3;
use motes::kernel::Backend;
use motes::scene::{Options, Scene, Source};
use motes::{Setup, Simulation};
use pollster::block_on;

use crate::matter::on_cpu;

const MOLECULES: usize = 216;
const EDGE: f64 = 18.65;

const SCENE: &str = r#"
[simulation]
dt = 0.0005
steps = 100
[box]
size = [18.65, 18.65, 18.65]
[[particles]]
bodies = [
  { position = [0, 0, 0], mass = 15.9994, species = 0, charge = -0.82 },
  { position = [1.012, 0, 0], mass = 1.008, species = 1, charge = 0.41 },
  { position = [-0.39931849294789645, 0.9298864130579717, 0], mass = 1.008, species = 1, charge = 0.41 },
]
copies = 216
arrangement = "lattice"
separation = 1.8
temperature = 249.4
[[links]]
pairs = [[0, 1], [0, 2]]
stiffness = 443153.3808
copies = 216
[[links]]
joints = [[1, 0, 2]]
angle = 113.24
stiffness = 31756.56
copies = 216
[[force]]
kind = "lennard_jones"
over = "list"
range = 9
pairs = [{ species = [0, 0], epsilon = 65.02994552, sigma = 3.165492 }, { species = [0, 1], epsilon = 0 }, { species = [1, 1], epsilon = 0 }]
exclude = 2
[[force]]
kind = "coulomb"
images = "ewald"
accuracy = 1e-9
coulomb = 138935.4576
over = "list"
range = 9
exclude = 2
[[force]]
kind = "spring"
[[force]]
kind = "joint"
"#;

/// What LAMMPS (22 July 2025, `benches/water.py`, `lj/cut/coul/long` and `ewald` to 1e-11) has of the same start, in f64.
struct Moment {
    step: u32,
    potential: f64,
    kinetic: f64,
    /// xx, yy, zz, yz, xz, xy.
    pressure: [f64; 6],
}

const LAMMPS: [Moment; 2] = [
    Moment {
        step: 0,
        potential: -236_402.044_704,
        kinetic: 242_042.700_000,
        pressure: [68.115_391_703, 72.638_064_518, 71.005_052_275, -0.368_730_230, -2.480_490_249, -6.910_356_227],
    },
    Moment {
        step: 100,
        potential: -502_533.223_378,
        kinetic: 508_250.288_776,
        pressure: [-31.477_606_174, -24.807_206_515, -25.178_784_078, -2.915_878_127, -11.004_614_043, 8.930_680_232],
    },
];
/// And where some atoms are after 100 steps, in the image in which they started.
const PLACES: [(usize, [f64; 3]); 7] = [
    (0, [1.324_374_933_735, 1.390_566_318_992, 1.209_728_042_390]),
    (1, [1.553_085_958_592, 0.404_088_454_090, 1.327_309_393_460]),
    (2, [0.428_546_912_584, 1.499_885_341_452, 1.689_518_194_501]),
    (3, [4.771_313_171_003, 1.486_646_222_156, 1.487_271_310_010]),
    (41, [5.765_927_886_515, 7.380_964_663_573, 2.014_145_512_188]),
    (70, [17.725_560_283_807, 11.195_378_301_503, 2.142_365_820_231]),
    (647, [17.642_214_006_534, 16.963_494_525_876, 17.846_091_378_636]),
];

fn start() -> Setup {
    let source = Source::Text { name: "water.toml".to_owned(), text: SCENE.to_owned(), folder: PathBuf::from(".") };
    let scene = Scene::load(&source, &[], &Options::default()).unwrap_or_else(|faults| panic!("{faults}"));
    assert_eq!(scene.particles.len(), 3 * MOLECULES);
    crate::support::scenes::setup(scene)
}

/// Energies and pressures, each off by this part of what they are made of: the kinetic energy, and that divided by the volume.
fn assert_lammps<B: Backend>(simulation: &mut Simulation<B>, part: f64) {
    let mut done = 0;
    for Moment { step, potential, kinetic, pressure } in LAMMPS {
        simulation.step(step - done).expect("steps");
        done = step;
        let state = block_on(simulation.snapshot()).expect("a state");
        let own: f64 = state.energies().expect("energies").iter().sum();
        let twice = |[a, b]: [usize; 2]| -> f64 {
            state.velocity().iter().zip(state.mass()).map(|(v, m)| m * v[a] * v[b]).sum()
        };
        let moving = 0.5 * (0..3).map(|axis| twice([axis, axis])).sum::<f64>();
        assert!((own - potential).abs() < part * kinetic, "step {step}: {own} is not {potential}");
        assert!((moving - kinetic).abs() < part * kinetic, "step {step}: {moving} is not {kinetic}");
        let virial = block_on(simulation.virial()).expect("a virial");
        for (n, axes) in [[0, 0], [1, 1], [2, 2], [1, 2], [0, 2], [0, 1]].into_iter().enumerate() {
            let push = (twice(axes) + virial[n]) / EDGE.powi(3);
            let off = (push - pressure[n]).abs();
            assert!(off < 10.0 * part * kinetic / EDGE.powi(3), "step {step}, {axes:?}: {push} is not {}", pressure[n]);
        }
    }
}

/// The references differ from LAMMPS by its erfc, which is right to 1.5e-7 of energies of charges: what is taken off for bonds is 46 000 for each of 432, and 14 000 for
/// each of 216 more, 96 times the kinetic energy, so that energies are off by 1.4e-5 of that at most. The fastest bond, ω = 700, turns by 35 in 100 steps.
#[test]
fn water_goes_where_it_goes_in_lammps() {
    let setup = start();
    let mut cpu = on_cpu(&setup);
    assert_lammps(&mut cpu, 1.4e-5);
    let state = block_on(cpu.snapshot()).expect("a state");
    for (id, place) in PLACES {
        let off = (state.position()[id] - DVec3::from(place)).abs().max_element();
        assert!(off < 1e-5, "{id}: {} is not {place:?}", state.position()[id]);
    }
}

/// On the device all is single precision: places up to 19 are rounded by 1e-6, and forces of bonds, 4.4e5 · 1e-6, by 0.5 of some 1e4.
#[test]
fn water_has_the_energies_of_lammps_on_the_device() {
    let setup = start();
    let gpu = crate::support::machines::gpu(&crate::support::device(), setup.state.len());
    assert_lammps(&mut Simulation::on(gpu, &setup).expect("a simulation"), 2e-4);
}
