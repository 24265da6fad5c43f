//! A heat bath with collisions.

use super::{Component, Problem, Properties, Stage};
use crate::component::bath::{Bath, TEMPERATURE, normals};
use crate::component::keys::SEED;
use crate::component::thermostat::decayed;
use crate::error::Error;
use crate::kernel::Plan;
use crate::settings::{Key, Kind, Settings, Value};
use crate::visit::random::fraction;

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    TEMPERATURE,
    Key::new("rate", Kind::Positive, Value::Number(1.0), "ν, the rate of collisions of a particle with the bath [1 / time]"),
    SEED,
];

/// `andersen`: at the end of each step a particle collides with the probability 1 − exp(−ν dt), and then has a velocity of the Maxwell
/// distribution (Andersen, J. Chem. Phys. 72, 2384, 1980). States are canonical; velocities are forgotten, so that diffusion is not that of the
/// substance. The numbers are counted by id, step and seed.
#[derive(Clone)]
pub struct Andersen {
    bath: Bath,
    rate: f64,
}

impl Andersen {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self { bath: Bath::of(settings), rate: settings.number("rate") }
    }
}

impl Component for Andersen {
    fn properties(&self) -> Properties {
        let why = "andersen has a probability of collisions for steps of one length";
        Properties { fixed_step: Some(why), constrains: true, thermostat: true, canonical: true, temperature: Some(self.bath.temperature), ..Properties::default() }
    }
    fn stage(&self, stage: Stage, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
        if stage == Stage::EndOfStep {
            let bath = self.bath;
            let file = crate::shader!("updaters/andersen.wgsl");
            plan.add(bath.kernel("andersen", file, ("RATE", self.rate), problem, move |me, x, host| {
                let world = host.world();
                if fraction(bath.words(me, !world.step)[0]) >= decayed(x) {
                    return me.velocity;
                }
                let n = normals(bath.words(me, world.step), world.bounds.dimensions);
                (bath.temperature / me.mass).sqrt() * n
            })?);
        }
        Ok(())
    }
}
