//! Grains.

use crate::cli::validate::claim::{Claim, Run};

pub const CLAIMS: &[Claim] = &[
    Claim {
        name: "restitution",
        family: "grains",
        about: "a grain hits another one at rest, head on, by Hertz's law with e = 0.7",
        run: Run::Own(
            "[simulation]\ndt = 2e-6\nuntil = 0.004\n\
             [[particles]]\nshape = \"grains\"\nsize = [0.01, 0.01, 0.01]\nradius = 0.005\ngap = 0\nvelocity = [1, 0, 0]\n\
             [[particles]]\nshape = \"grains\"\nsize = [0.01, 0.01, 0.01]\nradius = 0.005\ngap = 0\ncenter = [0.011, 0, 0]\n\
             [[force]]\nkind = \"contact\"\nrange = 0.011\nmodel = \"hertz\"\nyoung_modulus = 1e7\nrestitution = 0.7\n",
        ),
        quantity: "speed at which they part, relative to that of the impact",
        published: 0.7,
        source: "Tsuji, Tanaka & Ishida, Powder Technology 71, 239, 1992",
        tolerance: 0.0005,
        because: "half a step of 516 in a contact, in which the dashpot takes 0.3: 3e-4",
        control: &["force.0.restitution=0.701"],
        long: false,
        measure: |course| {
            let v = course.last().velocity();
            v[1].x - v[0].x
        },
    },
    Claim {
        name: "slide_to_roll",
        family: "grains",
        about: "a sphere that slides on a floor with a speed of 1 m/s and does not turn, μ = 0.3, until it rolls",
        run: Run::Own(
            "[simulation]\ndt = 5e-5\nuntil = 0.2\n[[particles]]\nshape = \"grains\"\nsize = [0.01, 0.01, 0.01]\nradius = 0.005\n\
             gap = 0\ncenter = [0, 0, 0.005]\nvelocity = [1, 0, 0]\n\
             [[force]]\nkind = \"contact_wall\"\nstiffness = 1000\nrestitution = 0.5\nfriction = 0.3\n\
             [[force]]\nkind = \"uniform\"\nacceleration = [0, 0, -9.81]\n",
        ),
        quantity: "speed at the end [m/s]",
        published: 0.714_286,
        source: "Coriolis, Théorie mathématique des effets du jeu de billard, 1835: 5 / 7 of the speed, whatever the friction",
        tolerance: 0.001,
        because: "the overlap of 0.26 % of the radius makes the arm shorter by as much, and the speed by 2 / 7 of it",
        control: &["simulation.until=0.09"],
        long: false,
        measure: |course| course.last().velocity()[0].x,
    },
];
