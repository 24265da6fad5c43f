//! The sections of a scene and their keys, as data. A new section needs a line here, a file beside this one and a field in
//! [`Scene`](super::Scene).

use crate::forces;
use crate::integrators::INTEGRATORS;
use crate::measure::MEASURES;
use crate::render;
use crate::settings::Key;
use crate::shapes::SHAPES;

use super::own::{self, Own};
use super::{
    bounds, checkpoint, column, copies, drain, emitter, links, motion, output, particles, plan, simulation, solver,
};

/// A section.
pub struct Section {
    /// Its name.
    pub name: &'static str,
    /// A one-line description.
    pub about: &'static str,
    /// Whether it is written `[[name]]` and may come several times.
    pub many: bool,
    /// Keys that the generic reader handles.
    pub keys: &'static [Key],
    /// Descriptions of the keys that the section's own file reads.
    pub own: &'static [Own],
    /// More keys, of all kinds that an entry may have.
    pub(super) kinds: fn() -> Vec<&'static [Key]>,
}

/// All sections, in the order in which the resolved scene writes them.
pub const SECTIONS: &[Section] = &[
    Section {
        about: "the time step, the number of steps and the integrator",
        own: own::SIMULATION,
        kinds: || INTEGRATORS.iter().map(|i| i.keys).collect(),
        ..Section::new("simulation", false, simulation::KEYS)
    },
    Section {
        about: "tolerances of the solver of implicit integrators",
        ..Section::new("solver", false, solver::SOLVER_KEYS)
    },
    Section { about: "the domain and its boundaries", own: own::BOX, ..Section::new("box", false, bounds::BOX_KEYS) },
    Section {
        about: "a floor plan: walls and exits of pedestrians",
        own: own::PLAN,
        ..Section::new("plan", false, plan::PLAN_KEYS)
    },
    Section {
        about: "prescribed motions of fixed particles and obstacles, by keyframes",
        own: own::MOTION,
        ..Section::new("motion", true, motion::MOTION_KEYS)
    },
    Section {
        about: "an additional quantity of particles, which laws read and write and files hold",
        own: own::COLUMN,
        ..Section::new("column", true, column::COLUMN_KEYS)
    },
    Section {
        about: "particles of a shape, of a file, or written out",
        own: own::PARTICLES,
        kinds: || SHAPES.iter().map(|s| s.keys).chain([particles::OFFSETS, copies::COPIES]).collect(),
        ..Section::new("particles", true, particles::EVERY)
    },
    Section {
        about: "a source that spawns particles during the run",
        own: own::EMITTER,
        ..Section::new("emitter", true, emitter::EMITTER_KEYS)
    },
    Section { about: "a region where particles are removed", ..Section::new("drain", true, drain::DRAIN_KEYS) },
    Section {
        about: "springs, rods, ropes, joints and dihedrals of particles: from a file, or as lists of ids",
        own: own::LINKS,
        ..Section::new("links", true, links::LINKS_KEYS)
    },
    Section {
        about: "what acts on particles: a force by its kind, or a law of your own",
        own: own::FORCE,
        kinds: || forces::entries().map(|f| f.keys).collect(),
        ..Section::new("force", true, &[])
    },
    Section {
        about: "how often states are written, and in which formats",
        own: own::OUTPUT,
        ..Section::new("output", false, output::KEYS)
    },
    Section {
        about: "a table of something that is measured during the run",
        own: own::MEASURE,
        kinds: || MEASURES.iter().map(|m| m.keys).collect(),
        ..Section::new("measure", true, &[])
    },
    Section {
        about: "how often a checkpoint is written",
        own: own::CHECKPOINT,
        ..Section::new("checkpoint", false, checkpoint::KEYS)
    },
    Section { about: "pictures: camera, style and colours", ..Section::new("picture", false, render::KEYS) },
];

impl Section {
    const fn new(name: &'static str, many: bool, keys: &'static [Key]) -> Self {
        Self { name, about: "", many, keys, own: &[], kinds: Vec::new }
    }
    /// Whether every form of the section may have this key.
    pub(super) fn has(&self, key: &str) -> bool {
        self.own.iter().any(|own| own.name == key) || self.keys.iter().any(|k| k.name == key)
    }
    /// Whether some form of the section has this key.
    pub(super) fn knows(&self, key: &str) -> bool {
        self.has(key) || (self.kinds)().iter().any(|keys| keys.iter().any(|k| k.name == key))
    }
    /// Its header in a scene.
    #[must_use]
    pub fn header(&self) -> String {
        if self.many { format!("[[{}]]", self.name) } else { format!("[{}]", self.name) }
    }
    /// The path of one of its keys in an override.
    pub(super) fn path(&self, key: &str) -> String {
        if self.many { format!("{}.0.{key}", self.name) } else { format!("{}.{key}", self.name) }
    }
}

#[cfg(test)]
mod tests {
    use super::{SECTIONS, bounds, checkpoint, emitter, links, motion, plan, simulation};
    use crate::scene::{force, measure, output};

    /// What a section reads by itself has its line in `own.rs`.
    #[test]
    fn own_keys_are_those_that_are_read() {
        let names = |name: &str| -> Vec<&str> {
            let section = SECTIONS.iter().find(|section| section.name == name).expect("a section");
            section.own.iter().map(|own| own.name).collect()
        };
        assert_eq!(names("simulation"), simulation::OWN);
        assert_eq!(names("box"), bounds::OWN);
        assert_eq!(names("plan"), plan::OWN);
        assert_eq!(names("motion"), motion::OWN);
        assert_eq!(names("emitter"), emitter::OWN);
        assert_eq!(names("links"), links::OWN);
        assert_eq!(names("force"), force::OWN);
        assert_eq!(names("output"), output::OWN);
        assert_eq!(names("measure"), measure::OWN);
        assert_eq!(names("checkpoint"), checkpoint::OWN);
    }
}
