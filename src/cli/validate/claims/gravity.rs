//! Many bodies, and periodic boxes.

use crate::cli::validate::claim::{Claim, Run};

pub const CLAIMS: &[Claim] = &[
    Claim {
        name: "plummer",
        family: "gravity",
        about: "20 000 bodies of Plummer's model, of which 99.9 % of the mass is sampled, all pairs",
        run: Run::Own(
            "[simulation]\ndt = 0.001\nsteps = 1\n[[particles]]\nshape = \"plummer\"\ncount = 20000\nscale = 1\n\
             [[force]]\nkind = \"gravity\"\n",
        ),
        quantity: "potential energy [G M² / a]",
        published: -0.294_524,
        source: "Plummer, MNRAS 71, 460, 1911: −3 π / 32",
        tolerance: 0.004,
        because: "two standard deviations of a sample, each 0.55 % of the energy, and twice 0.1 % of the mass that is left out",
        control: &["particles.0.scale=1.02"],
        long: false,
        measure: |course| course.first().energies().map_or(f64::NAN, |all| all.iter().sum()),
    },
    Claim {
        name: "ewald",
        family: "gravity",
        about: "one body in a periodic cube with a neutralizing background, and all its images",
        run: Run::Own(
            "[simulation]\ndt = 0.001\nsteps = 1\n[box]\nsize = [1, 1, 1]\n\
             [[particles]]\nbodies = [{ position = [0.3, 0.4, 0.6] }]\n[[force]]\nkind = \"gravity\"\nimages = \"ewald\"\naccuracy = 1e-6\n",
        ),
        quantity: "potential energy [G m² / L]",
        published: 1.418_648_739_7,
        source: "half of the constant of the simple cubic lattice, 2.837297479 (Cichocki, Felderhof & Hinsen, Phys. Rev. A 39, 5350, 1989)",
        tolerance: 2e-5,
        because: "single precision: three times the half of waves that sum to 4.3 and are right to 3e-6, since sines and cosines are to 1e-6; the sum itself is right to 1e-6",
        control: &["box.size=[1.001, 1.001, 1.001]"],
        long: false,
        measure: |course| course.first().energies().map_or(f64::NAN, |all| all.iter().sum()),
    },
];
