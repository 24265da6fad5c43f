//! All claims, by family.

mod flocks;
mod fluids;
mod grains;
mod gravity;
mod molecules;
mod orbits;
mod rods;

use super::claim::Claim;

/// All claims, in the order of the page.
pub fn all() -> impl Iterator<Item = &'static Claim> {
    [orbits::CLAIMS, gravity::CLAIMS, rods::CLAIMS, molecules::CLAIMS, grains::CLAIMS, fluids::CLAIMS, flocks::CLAIMS]
        .into_iter()
        .flatten()
}
