//! Scenes: a text in TOML becomes everything that a run needs, or all of its faults at once.
//!
//! ```
//! use motes::scene::{Options, Scene, Source};
//!
//! let text = "[simulation]\ndt = 0.1\nstep = 10\n".to_owned();
//! let source = Source::Text { name: "a.toml".to_owned(), text, folder: ".".into() };
//! let faults = Scene::load(&source, &[], &Options::default()).err().unwrap();
//! assert!(faults.to_string().contains("did you mean `steps`?"));
//! assert_eq!((faults.total, faults.exit_code()), (3, 3)); // also: no steps, and no particles
//! ```
//!
//! The sections and their keys are data (`sections.rs`), checked by one walker (`walk.rs`); nothing in a scene is ever run.

#[cfg(feature = "panel")]
mod beside;
mod bounds;
mod builtin;
mod checkpoint;
mod color;
mod column;
mod copies;
mod diagnostic;
mod draft;
mod drain;
mod emitter;
mod files;
mod fluid;
mod force;
mod held;
mod links;
mod measure;
mod motion;
mod output;
mod overrides;
mod own;
mod pairs;
mod particles;
mod plan;
mod report;
mod resolved;
mod scale;
mod sections;
mod shared;
mod simulation;
mod solver;
mod source;
mod tree;
mod value;
mod walk;

use std::ops::Range;
use std::path::{Path, PathBuf};

use crate::forces::Component;
use crate::integrators;
use crate::kernel::{AdaptiveStep, BlockSteps, Bounds, Precision, Solver};
use crate::render;
use crate::settings::Settings;
use crate::simulation::Setup;
use crate::state::State;

#[cfg(feature = "panel")]
#[doc(hidden)]
pub use beside::{Beside, with_file};
#[doc(hidden)]
pub use builtin::{Builtin, SCENES};
#[doc(hidden)]
pub use checkpoint::{Checkpoints, Every};
#[doc(hidden)]
pub use column::COLUMN_KEYS;
pub use diagnostic::{Diagnostic, Diagnostics, Excerpt, Mended};
#[doc(hidden)]
pub use measure::Chosen;
#[doc(hidden)]
pub use output::Output;
#[doc(hidden)]
pub use own::Own;
#[doc(hidden)]
pub use sections::{SECTIONS, Section};
#[doc(hidden)]
pub use shared::Shared;
pub use source::Source;

use files::Files;
use report::{Fault, Place, Report};
use resolved::Writer;
pub(crate) use resolved::plain;
#[cfg(feature = "panel")]
pub(crate) use resolved::written;
use walk::Table;

/// A scene, read and checked.
pub struct Scene {
    /// The file's name without its extension, or the name of the built-in scene.
    pub name: String,
    /// The first comment of the file: what the run shows.
    pub about: String,
    /// The length of a step \[time\]; positive.
    pub dt: f64,
    /// The step given in the scene, if `dt` was reduced so that an integer of steps ends at `until` \[time\].
    pub given_dt: Option<f64>,
    /// The number of steps; at least one. With adaptive steps, the number of the longest ones: others lie in between.
    pub steps: u64,
    /// The end time \[time\].
    pub until: f64,
    /// The adaptive time step, if steps are adaptive.
    pub adaptive_step: Option<AdaptiveStep>,
    /// The block time steps, if particles have steps of their own.
    pub block_steps: Option<BlockSteps>,
    /// The precision of positions and velocities.
    pub precision: Precision,
    /// The integrator.
    pub integrator: &'static integrators::Entry,
    /// The settings of the integrator.
    pub integrator_settings: Settings,
    /// The tolerances of implicit integrators.
    pub solver: Solver,
    /// The box and its boundaries.
    pub bounds: Bounds,
    /// All particles, in the order of the scene; at least one.
    pub particles: State,
    /// One for each `[[particles]]`, or for each of its parts (a disk, its halo), in their order; together they cover every
    /// id.
    pub groups: Vec<Group>,
    /// The forces, in the order of the scene; there may be none.
    pub forces: Vec<Box<dyn Component>>,
    /// The output.
    pub output: Output,
    /// The measures in addition to the default ones.
    pub measures: Vec<Chosen>,
    /// The checkpoints.
    pub checkpoint: Checkpoints,
    /// The settings of pictures: the values of [`render::KEYS`].
    pub picture: Settings,
    /// The scene as TOML with every default filled in and every override applied. Loading it gives the same scene again. It names files by
    /// absolute paths, so that elsewhere it must be loaded with [`Options::allow_outside`]; see [`Scene::resolved_in`]. Further comments
    /// are added at its end: the first ones are the scene's own.
    pub resolved: String,
    /// The files that were read, by absolute paths: the scene file, if there is one, and those that it names.
    pub files: Vec<PathBuf>,
    /// Remarks on a valid scene, for instance that `until` is not a whole number of steps.
    pub remarks: Vec<String>,
    /// The keys of particles and emitters that have their values from forces.
    pub shared: Vec<Shared>,
}

/// Particles that came from one entry of the scene, or one part of them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Group {
    /// Their ids.
    pub ids: Range<u32>,
    /// Red, green and blue in sRGB, if given in the scene.
    pub color: Option<[u8; 3]>,
}

/// Permissions of a scene.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Options {
    /// Whether it may name files outside of its own folder.
    pub allow_outside: bool,
    /// Files that it may name wherever they are.
    pub beside: Vec<PathBuf>,
    /// The maximum number of particles, as a protection against mistakes that fill the memory.
    pub most_particles: u32,
}

impl Default for Options {
    /// No files outside, and up to a hundred million particles (6.4 GB on the host).
    fn default() -> Self {
        Self { allow_outside: false, beside: Vec::new(), most_particles: 100_000_000 }
    }
}

impl Scene {
    /// The overrides, in the form of `--set`, that multiply its number of particles by a factor.
    ///
    /// # Errors
    /// [`Error::Scene`] if the scene has no other resolution: it names particles by their ids, or they are ions or single bodies.
    #[doc(hidden)]
    pub fn scaled(&self, factor: f64) -> Result<Vec<String>, crate::Error> {
        scale::overrides(self, factor)
    }
    /// The integrator, with the settings of the scene.
    #[must_use]
    pub fn integrator(&self) -> Box<dyn integrators::Integrator> {
        let integrator = (self.integrator.build)(&self.integrator_settings);
        match self.precision {
            Precision::Single => integrator,
            precision => Box::new(integrators::Precise { integrator, precision }),
        }
    }
    /// The setup of a simulation. It takes the particles and forces; the scene is left without them.
    pub fn setup(&mut self) -> Setup {
        Setup {
            state: std::mem::take(&mut self.particles),
            forces: std::mem::take(&mut self.forces),
            integrator: match (self.adaptive_step, self.block_steps) {
                (Some(adaptive_step), _) => {
                    Box::new(integrators::Adaptive { integrator: self.integrator(), adaptive_step })
                }
                (None, Some(steps)) => Box::new(integrators::BlockLeapfrog(steps)),
                (None, None) => self.integrator(),
            },
            dt: self.dt,
            bounds: self.bounds,
            solver: self.solver,
        }
    }
    /// Reads a scene. Each override is `key=value`: `simulation.dt=0.01`, `particles.0.count=100`, `force.0.g=2`; the value is TOML, or a
    /// text without its quotes. Files that an override names are searched where the scene's are.
    ///
    /// # Errors
    /// All faults of the scene, of the overrides, and of the files that the scene names.
    pub fn load(source: &Source, overrides: &[String], options: &Options) -> Result<Self, Diagnostics> {
        let opened = source.open()?;
        let mut report = Report::default();
        let text = report.add(Some(opened.file.clone()), &opened.text);
        let mut root = tree::parse(text, &opened.text, &mut report);
        overrides::apply(&mut root, overrides, &mut report);
        let sections = walk::sections(&root, &mut report);
        let files = Files::new(&opened, options);
        // Many particles are not created for a scene that is refused anyway.
        let refused = draft::read(&sections, &files, options.most_particles, &mut report) && report.len() > 0;
        let scene = (!refused).then(|| read(&sections, &files, options, &mut report));
        let mut scene = match (report.finish(), scene) {
            (None, Some(scene)) => scene,
            (Some(faults), _) => return Err(Diagnostics { files: files.sought(), ..faults }),
            (None, None) => return Err(Diagnostics::alone(&opened.file, "it has faults".to_owned(), Vec::new())),
        };
        scene.name = opened.name;
        scene.about = source::about(&opened.text);
        scene.files = files.found();
        if let Source::File(path) = source {
            scene.files.extend(std::fs::canonicalize(path));
        }
        let mut resolved = Writer::default();
        resolved.comment(&scene.about);
        scene.resolved.insert_str(0, &resolved.0);
        Ok(scene)
    }

    /// [`Scene::resolved`] with the files that it reads in numbered folders beside it; and the paths of these files.
    #[must_use]
    pub fn packed(&self) -> (String, Vec<(String, PathBuf)>) {
        resolved::packed(&self.resolved, &self.files)
    }
    /// [`Scene::resolved`] for a file in an existing folder: it names files by relative paths, so that it does not reveal where both are.
    #[must_use]
    pub fn resolved_in(&self, folder: &Path) -> String {
        resolved::nearby(&self.resolved, &self.files, folder)
    }
}

/// Reads all sections. If the report has faults, the result must not be used.
fn read(sections: &[(&'static str, Table<'_>)], files: &Files, options: &Options, report: &mut Report) -> Scene {
    let one = |name: &str| sections.iter().find(|(n, _)| *n == name).map(|(_, table)| table);
    let all = |name: &'static str| sections.iter().filter(move |(n, _)| *n == name).map(|(_, table)| table);

    let mut out = Writer::default();
    out.0.push('\n');
    out.comment(source::RESOLVED);
    let simulation = simulation::read(one("simulation"), all("force"), report);
    simulation.write(&mut out);
    let solver = solver::read(one("solver"), &mut out, report);
    let bounds = bounds::read(one("box"), &mut out, report);

    let floor_plan = plan::read(one("plan"), (files, bounds.dimensions), &mut out, report);
    let mut motions = Vec::new();
    for table in all("motion") {
        motions.extend(motion::read(table, &motions, (simulation.dt, &bounds), &mut out, report));
    }

    let mut forces: Vec<Box<dyn Component>> = Vec::new();
    let (mut of_forces, mut said_of_forces) = (Vec::new(), Writer::default());
    for table in all("force") {
        let faults = report.len();
        let chosen = force::read(table, (files, &motions), report);
        if let Some(chosen) = chosen.filter(|_| report.len() == faults) {
            chosen.write(&mut said_of_forces);
            forces.push(chosen.build());
            of_forces.push(table);
        }
    }
    let declared = column::read(all("column"), &mut out, report);
    let columns = column::all(&forces, simulation.columns(), &declared, report);

    let mut particles = State::default();
    let mut groups = Vec::new();
    if all("particles").chain(all("emitter")).next().is_none() {
        let fault = Fault::missing(&Place::end(), "there are no particles");
        report.push(
            fault.note("help: add\n\n         [[particles]]\n         shape = \"plummer\"\n         count = 1000"),
        );
    }
    let said = shared::said(all("force"));
    for table in all("particles") {
        let start = ids(&particles);
        let room = options.most_particles.saturating_sub(start);
        if let Some(block) = particles::read(table, room, (files, &motions, &said, &bounds), &columns, report) {
            if let Err(why) = particles.append(&block.particles) {
                report.push(Fault::at(table.place, why.to_string()));
            }
            let mut end = start;
            for (count, color) in block.parts {
                groups.push(Group { ids: end..end + count, color });
                end += count;
            }
            out.0 += &block.resolved;
        }
    }

    #[expect(clippy::cast_precision_loss, reason = "a time")]
    let end = simulation.dt * simulation.steps as f64;
    for table in all("emitter") {
        let start = ids(&particles);
        let room = options.most_particles.saturating_sub(start);
        let within = (bounds.dimensions, end, room, said.as_slice());
        if let Some(emitted) = emitter::read(table, within, &columns, &mut particles, &mut out, report) {
            groups.push(Group { ids: start..start + emitted.count, color: emitted.color });
        }
    }
    for (column, place) in &declared {
        if let Err(why) = particles.declare(column) {
            report.push(Fault::at(place, why.to_string()));
        }
    }
    let mut of_plan = Vec::new();
    if let Some(floor) = floor_plan {
        particles = particles.on_floor(floor.plan);
        of_plan = floor.remarks;
    }
    for table in all("drain") {
        particles.drains.extend(drain::read(table, bounds.dimensions, &mut out, report));
    }

    for table in all("links") {
        links::read(table, &mut particles, &bounds, files, &mut out, report);
    }

    for (table, force) in of_forces.iter().zip(&forces) {
        pairs::complete(table, force.as_ref(), particles.species(), report);
    }
    let mut flows = false;
    for (table, force) in of_forces.iter().zip(&forces) {
        let agrees = force::agrees(table, force.as_ref(), &bounds, report);
        if force.properties().makes_fluid {
            if agrees {
                fluid::check(table, &particles, flows, report);
            }
            flows = true;
        }
    }
    out.0 += &said_of_forces.0;

    // The forces depend on whether particles are spawned or removed.
    let integrator = simulation.made();
    let merges =
        of_forces.iter().zip(&forces).find(|(_, force)| force.properties().removes).map(|(table, _)| table.place);
    let first = all("emitter").chain(all("drain")).map(|table| table.place).next().or(merges);
    if let (Some(first), Err(why)) = (first, crate::simulation::serves(&particles, &forces, integrator.as_ref())) {
        report.push(Fault::at(first, why.to_string()));
    }
    if let (Some(entry), false) =
        (one("simulation").and_then(|table| table.get("integrator")), integrator.advances_columns())
    {
        force::advanced(&forces, integrator.name(), &entry.place, report);
    }
    if let Some((_, place)) = &simulation.adaptive_step {
        force::adapted(&forces, integrator.as_ref(), place, report);
        let own = integrator.estimates_error();
        if let Some(why) = crate::simulation::refuses_own_steps(&particles, &forces, &bounds).filter(|_| own) {
            report.push(Fault::at(place, why));
        }
    }
    if let Some((steps, place)) = &simulation.block_steps {
        // What is wrong with its numbers is known.
        let sound = steps.check().is_ok();
        let steps =
            if sound { *steps } else { BlockSteps { levels: 1, eta: 1.0, length: 1.0, mass: 0.0, shared: false } };
        for why in crate::simulation::refuses_blocks(steps, &particles, &forces, simulation.dt) {
            report.push(Fault::at(place, why));
        }
    }
    particles.motions = motions;
    let output = output::read(one("output"), (simulation.steps, simulation.dt), &columns, report);
    output.write(&mut out);
    let mut measures = Vec::new();
    for table in all("measure") {
        measures.extend(measure::read(table, simulation.dt, &mut out, report).map(|one| (one, table)));
    }
    let checkpoint = checkpoint::read(one("checkpoint"), simulation.dt, report);
    checkpoint.write(&mut out);
    let picture = match one("picture") {
        Some(table) => table.settings(render::KEYS, &[], report),
        None => Settings::defaults(render::KEYS),
    };
    out.header("[picture]");
    out.settings(render::KEYS, &picture);
    if let Some(table) = one("picture") {
        column::of_picture(table, &picture, &columns, report);
    }

    let remarks = simulation.remark.iter().cloned().chain(shared::contradictions(sections));
    let remarks = remarks
        .chain(force::unused(sections, &particles))
        .chain(render::styles::remark(&picture))
        .chain(of_plan)
        .collect();
    let (measures, of_measures): (Vec<_>, Vec<_>) = measures.into_iter().unzip();
    let mut scene = Scene {
        name: String::new(),
        about: String::new(),
        dt: simulation.dt,
        given_dt: simulation.given_dt,
        steps: simulation.steps,
        until: simulation.until,
        precision: simulation.precision,
        adaptive_step: simulation.adaptive_step.map(|(adaptive_step, _)| adaptive_step),
        block_steps: simulation.block_steps.map(|(steps, _)| steps),
        integrator: simulation.integrator,
        integrator_settings: simulation.integrator_settings,
        solver,
        bounds,
        particles,
        groups,
        forces,
        output,
        measures,
        checkpoint,
        picture,
        resolved: out.0,
        files: Vec::new(),
        remarks,
        shared: shared::left(sections),
    };
    if report.len() == 0 {
        measure::check(&mut scene, &of_measures, report);
    }
    scene
}

/// The number of particles, as an id. `most_particles` limits it to 32 bits.
fn ids(particles: &State) -> u32 {
    u32::try_from(particles.len()).unwrap_or(u32::MAX)
}
