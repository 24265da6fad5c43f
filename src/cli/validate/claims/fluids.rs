//! Fluids.

use crate::cli::validate::claim::{Claim, Run};
use motes::State;

pub const CLAIMS: &[Claim] = &[
    Claim {
        name: "poiseuille",
        family: "fluids",
        about: "a fluid that starts in a channel, 20 particles across, at t = 4, ν = 0.1, g = 0.1, width 1",
        run: Run::Builtin("poiseuille", &[]),
        quantity: "speed in the middle [length / time]",
        published: 0.122_51,
        source: "Morris, Fox & Zhu, J. Comput. Phys. 136, 214, 1997: the series of the flow that starts",
        tolerance: 0.000_6,
        because: "half a percent, the error of sums over 20 particles across, which falls with their number",
        control: &["force.1.viscosity=0.102"],
        long: false,
        measure: |course| middle(course.last()),
    },
    Claim {
        name: "taylor_green",
        family: "fluids",
        about: "vortices in a periodic square at Re = 100, 50 particles along a side, at t = 1",
        run: Run::Builtin("taylor_green", &["simulation.until=1"]),
        quantity: "rate of decay of velocities [1 / time]",
        published: 0.789_568,
        source: "Taylor & Green, Proc. R. Soc. A 158, 499, 1937: 8 π² / Re",
        tolerance: 0.02,
        because: "the rate is 1 to 2 % too fast at this spacing, and less at finer ones",
        control: &["force.0.viscosity=0.012"],
        long: true,
        measure: |course| {
            let kinetic = |state: &State| state.velocity().iter().map(|v| v.length_squared()).sum::<f64>();
            let (first, last) = (course.first(), course.last());
            -0.5 * (kinetic(last) / kinetic(first)).ln() / (last.time - first.time)
        },
    },
];

/// The mean speed of the row of particles in the middle of the channel.
fn middle(state: &State) -> f64 {
    let rows = state.position().iter().zip(state.velocity()).filter(|(x, _)| (x.y - 0.5).abs() < 0.02);
    let all: Vec<f64> = rows.map(|(_, v)| v.x).collect();
    all.iter().sum::<f64>() / all.len() as f64
}
