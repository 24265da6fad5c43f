//! Particles on the host: what files and generators give, and what a simulation starts from.

pub mod block;
mod build;
pub mod chain;
pub mod cloth;
pub mod clusters;
pub mod disk;
pub mod drop;
pub mod emitter;
mod exponential_disk;
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

use glam::DVec3;

use crate::error::Error;
use crate::life::{Birth, Drain, Life, Population};
use crate::links::Links;
use crate::motion::{Held, Hold, Motion};
use crate::settings::{Key, Settings};

/// Particles, one entry per id in every array. Units are the scene's own.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Particles {
    /// Where they are \[length\].
    pub position: Vec<DVec3>,
    /// How they move \[length / time\].
    pub velocity: Vec<DVec3>,
    /// How heavy they are \[mass\]; zero is a test particle.
    pub mass: Vec<f64>,
    /// How large they are drawn \[length\]; zero lets the picture choose.
    pub radius: Vec<f64>,
    /// Of which kind they are: numbers that laws may tell apart; 0 where nobody cares.
    pub species: Vec<u32>,
    /// What ties them together.
    pub links: Links,
    /// Those that forces do not move.
    pub held: Vec<Held>,
    /// What leads some of those, and solids: [`Hold::Motion`] counts them from 0.
    pub motions: Vec<Motion>,
    /// Whether they take part; who is not told of, lives. Who does not has no velocity and no mass, whatever is said here.
    pub life: Vec<Life>,
    /// Who is to be born, when and how.
    pub births: Vec<Birth>,
    /// Where particles die.
    pub drains: Vec<Drain>,
}

/// A named generator: what a scene's `shape = "…"` may say.
pub struct Shape {
    /// The scene's word for it.
    pub name: &'static str,
    /// One line with the source of the model.
    pub about: &'static str,
    /// What it may be told.
    pub keys: &'static [Key],
    /// Makes the particles. The same settings give the same bits on every platform.
    pub build: fn(&Settings) -> Result<Particles, Error>,
    /// What follows on its first part, where it has several, in the order of ids: the key of the colour of each, and how
    /// many particles are of it. For settings that `build` takes.
    pub parts: fn(&Settings) -> Vec<(&'static str, u32)>,
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
    block::BLOCK,
    drop::DROP,
    tank::TANK,
    wall::WALL,
    random_box::RANDOM_BOX,
    spray::SPRAY,
    chain::CHAIN,
    cloth::CLOTH,
    jelly::JELLY,
    hair::HAIR,
];

/// The generator of a name.
#[must_use]
pub fn shape(name: &str) -> Option<&'static Shape> {
    SHAPES.iter().find(|shape| shape.name == name)
}

impl Particles {
    /// How many.
    #[must_use]
    pub fn len(&self) -> usize {
        self.position.len()
    }
    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.position.is_empty()
    }
    /// Whether one takes part.
    #[must_use]
    pub fn lives(&self, id: usize) -> bool {
        self.life.get(id).is_none_or(|life| *life == Life::Living)
    }
    /// Whether not everybody takes part, all the time.
    #[must_use]
    pub fn is_mortal(&self) -> bool {
        !self.births.is_empty() || !self.drains.is_empty() || self.life.iter().any(|life| *life != Life::Living)
    }
    /// How many wait, live and are dead.
    #[must_use]
    pub fn population(&self) -> Population {
        Population::of(&self.life, self.len())
    }
    /// Adds one, of species 0.
    pub fn push(&mut self, position: DVec3, velocity: DVec3, mass: f64, radius: f64) {
        self.position.push(position);
        self.velocity.push(velocity);
        self.mass.push(mass);
        self.radius.push(radius);
        self.species.push(0);
    }
    /// The same, all of one species.
    #[must_use]
    pub fn of_species(mut self, species: u32) -> Self {
        self.species = vec![species; self.len()];
        self
    }
    /// Adds all of another set; their ids follow on.
    pub fn append(&mut self, other: &Self) {
        self.position.extend_from_slice(&other.position);
        self.velocity.extend_from_slice(&other.velocity);
        self.mass.extend_from_slice(&other.mass);
        self.radius.extend_from_slice(&other.radius);
        let first = u32::try_from(self.len() - other.len()).unwrap_or(u32::MAX);
        self.species.extend_from_slice(&other.species);
        self.links.append(&other.links, first);
        let motions = u32::try_from(self.motions.len()).unwrap_or(u32::MAX);
        let by = |by| if let Hold::Motion(n) = by { Hold::Motion(n.saturating_add(motions)) } else { by };
        let held = |held: &Held| Held { id: held.id.saturating_add(first), by: by(held.by) };
        self.held.extend(other.held.iter().map(held));
        self.motions.extend_from_slice(&other.motions);
        if !other.life.is_empty() {
            self.life.resize(first as usize, Life::Living);
            self.life.extend_from_slice(&other.life);
        }
        let emitters = self.births.iter().map(|birth| birth.emitter.saturating_add(1)).max().unwrap_or(0);
        let later = |birth: &Birth| {
            let (id, emitter) = (birth.id.saturating_add(first), birth.emitter.saturating_add(emitters));
            Birth { id, emitter, ..*birth }
        };
        self.births.extend(other.births.iter().map(later));
        self.drains.extend_from_slice(&other.drains);
    }
}
