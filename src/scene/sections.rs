//! The sections of a scene and their keys, as data. A later section adds its line here, its file beside this one and
//! its field in [`Scene`](super::Scene).

use crate::forces::FORCES;
use crate::particles::SHAPES;
use crate::render;
use crate::settings::Key;

use super::{bounds, drain, emitter, force, links, motion, output, particles, simulation, solver};

/// A section.
pub(super) struct Section {
    /// Its name.
    pub(super) name: &'static str,
    /// Whether it is written `[[name]]` and may come several times.
    pub(super) many: bool,
    /// Keys that the walker reads by itself.
    pub(super) keys: &'static [Key],
    /// Keys that the section's own file reads.
    pub(super) own: &'static [&'static str],
    /// More keys, of the kinds that an entry may be of.
    pub(super) kinds: fn() -> Vec<&'static [Key]>,
}

/// All sections, in the order in which the resolved scene writes them.
pub(super) const SECTIONS: &[Section] = &[
    Section { name: "simulation", many: false, keys: simulation::KEYS, own: simulation::OWN, kinds: Vec::new },
    Section { name: "solver", many: false, keys: solver::SOLVER_KEYS, own: &[], kinds: Vec::new },
    Section { name: "box", many: false, keys: bounds::BOX_KEYS, own: bounds::OWN, kinds: Vec::new },
    Section { name: "motion", many: true, keys: motion::MOTION_KEYS, own: motion::OWN, kinds: Vec::new },
    Section {
        name: "particles",
        many: true,
        keys: particles::EVERY,
        own: particles::OWN,
        kinds: || SHAPES.iter().map(|s| s.keys).chain([particles::OFFSETS]).collect(),
    },
    Section { name: "emitter", many: true, keys: emitter::EMITTER_KEYS, own: emitter::OWN, kinds: Vec::new },
    Section { name: "drain", many: true, keys: drain::DRAIN_KEYS, own: &[], kinds: Vec::new },
    Section { name: "links", many: true, keys: links::LINKS_KEYS, own: links::OWN, kinds: Vec::new },
    Section {
        name: "force",
        many: true,
        keys: &[],
        own: force::OWN,
        kinds: || FORCES.iter().map(|f| f.keys).collect(),
    },
    Section { name: "output", many: false, keys: output::KEYS, own: output::OWN, kinds: Vec::new },
    Section { name: "picture", many: false, keys: render::KEYS, own: &[], kinds: Vec::new },
];

impl Section {
    /// Whether some form of the section has this key.
    pub(super) fn knows(&self, key: &str) -> bool {
        self.own.contains(&key)
            || self.keys.iter().any(|k| k.name == key)
            || (self.kinds)().iter().any(|keys| keys.iter().any(|k| k.name == key))
    }
    /// How its header is written.
    pub(super) fn header(&self) -> String {
        if self.many { format!("[[{}]]", self.name) } else { format!("[{}]", self.name) }
    }
    /// How an override names a key of it.
    pub(super) fn path(&self, key: &str) -> String {
        if self.many { format!("{}.0.{key}", self.name) } else { format!("{}.{key}", self.name) }
    }
}
