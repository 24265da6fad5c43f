//! Flocks.

use crate::cli::validate::claim::{Claim, Run, order};

pub const CLAIMS: &[Claim] = &[Claim {
    name: "vicsek",
    family: "flocks",
    about: "1000 particles of Vicsek's model in full noise: headings are independent; the mean of 200 steps",
    run: Run::Own(
        "[simulation]\ndt = 1\nsteps = 200\nintegrator = \"forward_euler\"\n[box]\nsize = [20, 20, 0]\n\
         [[particles]]\nshape = \"box\"\ncount = 1000\nsize = [20, 20, 0]\ncenter = [10, 10, 0]\nspeed = 0.03\n\
         [[force]]\nkind = \"vicsek\"\nnoise = 6.283185307\n[output]\nevery = 1\n",
    ),
    quantity: "order, |Σ v| / N v",
    published: 0.028_025,
    source: "Rayleigh 1880: the mean of N random steps in the plane, √(π / 4 N)",
    tolerance: 0.003_2,
    because: "three standard errors, each 0.523 / √200 of the value",
    control: &["force.0.noise=5"],
    long: false,
    measure: |course| course.mean(order),
}];
