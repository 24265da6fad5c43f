//! Atoms.

use crate::cli::validate::claim::{Claim, Run, temperature};

pub const CLAIMS: &[Claim] = &[
    Claim {
        name: "lj_crystal",
        family: "molecules",
        about: "32 000 Lennard-Jones atoms in a face-centred cubic crystal of density 0.8442, cut at 2.5 σ",
        run: Run::Own(
            "[simulation]\ndt = 0.005\nsteps = 1\n[box]\nlow = [-16.79596191, -16.79596191, -16.79596191]\n\
             size = [33.59192382, 33.59192382, 33.59192382]\n\
             [[particles]]\nshape = \"crystal\"\ncells = [20, 20, 20]\ndensity = 0.8442\n\
             [[force]]\nkind = \"lennard_jones\"\nrange = 2.5\ntruncation = \"cut\"\nover = \"list\"\n",
        ),
        quantity: "potential energy per atom [ε]",
        published: -6.773_368_1,
        source: "LAMMPS, bench/in.lj at step 0",
        tolerance: 1e-5,
        because: "single precision: distances are right to 2e-6 of the box's coordinates, and energies to as much",
        control: &["force.0.epsilon=1.00001"],
        long: false,
        measure: |course| {
            let state = course.first();
            state.energies().map_or(f64::NAN, |all| all.iter().sum::<f64>() / state.len() as f64)
        },
    },
    Claim {
        name: "langevin",
        family: "molecules",
        about: "20 000 free particles, at rest at the start, after 20 relaxation times in a heat bath of k T = 1.5",
        run: Run::Own(
            "[simulation]\ndt = 0.1\nsteps = 200\n[[particles]]\nshape = \"box\"\ncount = 20000\n\
             [[force]]\nkind = \"langevin\"\ntemperature = 1.5\n[output]\nevery = 200\n",
        ),
        quantity: "temperature, 2 K / 3 N [k T]",
        published: 1.5,
        source: "Maxwell 1860: equipartition",
        tolerance: 0.03,
        because: "three and a half standard deviations, each k T √(2 / 3 N) = 0.0087",
        control: &["force.0.temperature=1.6"],
        long: false,
        measure: |course| temperature(course.last()),
    },
    Claim {
        name: "madelung",
        family: "molecules",
        about: "eight ions of rock salt in a periodic cube, and all their images",
        run: Run::Own(
            "[simulation]\ndt = 0.001\nsteps = 1\n[box]\nsize = [2, 2, 2]\n[[particles]]\nbodies = [{ position = [0.5, 0.5, 0.5], charge = 1 }, { position = [0.5, 0.5, 1.5], charge = -1 }, { position = [0.5, 1.5, 0.5], charge = -1 }, { position = [0.5, 1.5, 1.5], charge = 1 }, { position = [1.5, 0.5, 0.5], charge = -1 }, { position = [1.5, 0.5, 1.5], charge = 1 }, { position = [1.5, 1.5, 0.5], charge = 1 }, { position = [1.5, 1.5, 1.5], charge = -1 }]\n\
             [[force]]\nkind = \"coulomb\"\nimages = \"ewald\"\nrange = 1\naccuracy = 1e-6\n",
        ),
        quantity: "energy of a pair of ions [k q² / d]",
        published: -1.747_564_594_6,
        source: "Madelung's constant of rock salt (Crandall & Buhler, J. Phys. A 20, 5497, 1987)",
        tolerance: 2e-5,
        because: "single precision: some 400 waves that add up to 3, each rounded by 6e-8, with sines and cosines that are right to 1e-6",
        control: &["box.size=[2.01, 2.01, 2.01]"],
        long: false,
        measure: |course| course.first().energies().map_or(f64::NAN, |all| all.iter().sum::<f64>() / 4.0),
    },
];
