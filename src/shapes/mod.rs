//! Shapes: named generators of states.

mod amount;
pub mod block;
mod build;
pub mod chain;
mod chains;
pub mod cloth;
pub mod clusters;
pub mod copies;
mod cosmological;
pub mod crowd;
pub mod crystal;
pub mod disk;
pub mod drop;
pub mod emitter;
mod exponential_disk;
pub mod grains;
pub mod hair;
mod halo;
pub mod hernquist;
pub mod jelly;
pub mod lattice;
mod mesh;
pub mod plummer;
pub mod random;
pub mod random_box;
mod rotation;
mod skin;
pub mod sphere;
pub mod spray;
pub mod tank;
pub mod wall;
mod zeldovich;

pub use amount::Amount;

use crate::error::Error;
use crate::settings::{Key, Settings};
use crate::state::State;

/// A named generator: a value of a scene's `shape = "…"`.
pub struct Shape {
    /// The scene's word for it.
    pub name: &'static str,
    /// One line with the source of the model.
    pub about: &'static str,
    /// Its keys.
    pub keys: &'static [Key],
    /// Makes the particles. The same settings give the same bits on every platform.
    pub build: fn(&Settings) -> Result<State, Error>,
    /// The maximum amount that it makes, for valid settings, so that memory is checked first. Zero where only `build` can determine it.
    pub amount: fn(&Settings) -> Amount,
    /// The parts after its first one, if it has several, in the order of ids: the key of the colour of each, or none where each has
    /// one of the palette, and its number of particles.
    /// For settings that `build` accepts.
    pub parts: fn(&Settings) -> Vec<(&'static str, u32)>,
    /// The keys by which its number of particles goes.
    pub resolution: Resolution,
}

/// The keys by which the number of particles of a shape goes, and the least that it may be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Resolution {
    /// A count of particles, or of strands of them.
    Count {
        /// Its key.
        key: &'static str,
        /// The least.
        least: u32,
    },
    /// Counts along axes, `spacing` apart.
    Grid {
        /// A key for each axis.
        keys: &'static [&'static str],
        /// The least along each.
        least: u32,
    },
    /// The same in one key.
    Cells {
        /// The key.
        key: &'static str,
        /// The least along each axis.
        least: u32,
        /// Whether it is as long as its number of spacings, so that it fills a periodic box; else it is one spacing shorter.
        periodic: bool,
    },
    /// A count along each side of a cube, which keeps its length.
    Cube {
        /// The key.
        key: &'static str,
        /// The least.
        least: u32,
    },
    /// `spacing` alone, which a fluid has for all of its shapes.
    Spacing,
    /// None: another number of particles is another thing.
    Own,
}

/// The parts of a shape that is all of one kind.
fn one_part(_: &Settings) -> Vec<(&'static str, u32)> {
    Vec::new()
}

/// Every generator.
pub const SHAPES: &[Shape] = &[
    plummer::PLUMMER,
    hernquist::HERNQUIST,
    sphere::SPHERE,
    disk::DISK,
    clusters::CLUSTERS,
    lattice::LATTICE,
    cosmological::COSMOLOGICAL,
    crystal::CRYSTAL,
    block::BLOCK,
    drop::DROP,
    tank::TANK,
    wall::WALL,
    random_box::RANDOM_BOX,
    spray::SPRAY,
    grains::GRAINS,
    crowd::CROWD,
    chain::CHAIN,
    chains::CHAINS,
    cloth::CLOTH,
    jelly::JELLY,
    hair::HAIR,
];

/// The generator of a name.
#[must_use]
pub fn shape(name: &str) -> Option<&'static Shape> {
    SHAPES.iter().find(|shape| shape.name == name)
}
