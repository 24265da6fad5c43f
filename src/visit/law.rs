//! What happens.

use std::sync::Arc;

use glam::{DVec3, DVec4};

use super::twin::{ByTables, Sample};
use super::{Body, Group, Jacobian, Over, Tables, each, links, near, pairs, tree, twin, walk};
use crate::error::Error;
use crate::kernel::{Kernel, Problem, Scalar, Shader, Side, Source, Twin, World};
use crate::links::{Corner, Half};
use crate::neighbors::Grid;
use crate::tree::Tree;

/// A law: what happens between `me` and `you`, or to `me` alone.
#[derive(Clone)]
pub struct Law {
    /// Its name, for `motes explain` and messages.
    pub name: String,
    /// Who meets whom.
    pub over: Over,
    /// Its WGSL. Over `each` it has `fn force(me: Particle) -> vec4f`; over all others it has `fn gather` and `fn finish`,
    /// see `shaders/visit/span.wgsl`, and may have `fn acts_on(me: Particle) -> bool` to be left out of a search.
    pub wgsl: Source,
    /// The members of its `Params`, by name.
    pub params: Vec<(String, Scalar)>,
    /// The visit's twin around the law's; `None` only for a user's law.
    pub twin: Option<Twin>,
    /// Whether what two do to each other adds up to nothing, so that momentum is kept.
    pub reciprocal: bool,
    /// What it offers to implicit integrators.
    pub jacobian: Option<Jacobian>,
    /// What it makes of a far group, over `tree`.
    pub distant: Distant,
    /// Over `links`: its reference by the tables that a problem has.
    pub tied: Option<ByTables>,
}

/// What a law makes of a far group.
#[derive(Clone, Default)]
pub struct Distant {
    /// Its WGSL; without it a group is met as one particle.
    pub wgsl: Option<Source>,
    /// The twin that walks the same tree as the device.
    pub walk: Option<Twin>,
    /// What some targets feel of everybody.
    pub sample: Option<Sample>,
    /// Whether it sees all images in a periodic box, so that nothing jumps half a box away.
    pub images: bool,
}

/// Files that a law has by calling a function of theirs, and not having one of that name itself.
const ON_CALL: [(&str, Source); 5] = [
    ("is_of", crate::shader!("law/species.wgsl")),
    ("unit", crate::shader!("law/steering.wgsl")),
    ("truncated", crate::shader!("law/steering.wgsl")),
    ("signed_distance", crate::shader!("solids/distance.wgsl")),
    ("pcg4d", crate::shader!("law/random.wgsl")),
];

impl Law {
    /// A law of which nothing more is known than what happens.
    fn plain(name: &str, over: Over, wgsl: Source, params: Vec<(String, Scalar)>, twin: Twin) -> Self {
        Self {
            name: name.to_owned(),
            over,
            wgsl,
            params,
            twin: Some(twin),
            reciprocal: false,
            jacobian: None,
            distant: Distant::default(),
            tied: None,
        }
    }
    /// A law of each particle alone; `rule(me, world)` gives acceleration and potential per unit mass.
    pub fn each(
        name: &str,
        wgsl: Source,
        params: Vec<(String, Scalar)>,
        rule: impl Fn(&Body, &World) -> DVec4 + Send + Sync + 'static,
    ) -> Self {
        Self::plain(name, Over::Each, wgsl, params, twin::each(rule))
    }
    /// A law of all pairs that adds up: [`Law::between`] over [`Over::Pairs`].
    pub fn pairs(
        name: &str,
        wgsl: Source,
        params: Vec<(String, Scalar)>,
        rule: impl Fn(&Body, &Body, DVec3) -> DVec4 + Send + Sync + 'static,
    ) -> Self {
        Self::between(name, Over::Pairs, wgsl, params, rule)
    }
    /// A law that adds up; `rule(me, you, r)`, with r from me to you, gives what you add to my acceleration and
    /// potential per unit mass. What you do to me, I do to you.
    pub fn between(
        name: &str,
        over: Over,
        wgsl: Source,
        params: Vec<(String, Scalar)>,
        rule: impl Fn(&Body, &Body, DVec3) -> DVec4 + Send + Sync + 'static,
    ) -> Self {
        let gather = move |me: &Body, you: &Body, r, sum: &mut DVec4| *sum += rule(me, you, r);
        Self { reciprocal: true, ..Self::gathering(name, over, wgsl, params, gather, |_, sum, _| *sum) }
    }
    /// A law between two that depends on the box too, and that knows what a far group does: `rule(me, you, r, world)` and
    /// `far(me, group, r, world)`, with r from me to you or to the group's centre of mass, give acceleration and potential
    /// per unit mass. `distant` is the WGSL of the latter, `fn distant(me: Particle, you: Group, r: vec3f, sum:
    /// ptr<function, Sum>)`; without it the group is met as one particle.
    pub fn attracting(
        name: &str,
        over: Over,
        files: (Source, Option<Source>),
        params: Vec<(String, Scalar)>,
        rule: impl Fn(&Body, &Body, DVec3, &World) -> DVec4 + Send + Sync + 'static,
        far: impl Fn(&Body, &Group, DVec3, &World) -> DVec4 + Send + Sync + 'static,
    ) -> Self {
        let rule = Arc::new(rule);
        let (wgsl, distant) = files;
        let (every, sample) = (rule.clone(), Some(twin::sample(rule.clone())));
        let gather = move |me: &Body, you: &Body, r, world: &World, sum: &mut DVec4| *sum += every(me, you, r, world);
        let walk = match over {
            Over::Tree { opening, core, .. } => Some(walk::twin(opening, core, rule, far)),
            _ => None,
        };
        let twin = twin::meetings(over, gather, |_, sum: &DVec4, _| *sum);
        Self {
            reciprocal: true,
            distant: Distant { wgsl: distant, walk, sample, images: false },
            ..Self::plain(name, over, wgsl, params, twin)
        }
    }
    /// A law that makes something else of its neighbours than a sum of accelerations; `gather(me, you, r, sum)` takes
    /// them in, in any order, and `finish(me, sum, world)` gives acceleration and potential per unit mass.
    pub fn gathering<S: Default>(
        name: &str,
        over: Over,
        wgsl: Source,
        params: Vec<(String, Scalar)>,
        gather: impl Fn(&Body, &Body, DVec3, &mut S) + Send + Sync + 'static,
        finish: impl Fn(&Body, &S, &World) -> DVec4 + Send + Sync + 'static,
    ) -> Self {
        let gather = move |me: &Body, you: &Body, r, _: &World, sum: &mut S| gather(me, you, r, sum);
        Self::plain(name, over, wgsl, params, twin::meetings(over, gather, finish))
    }
    /// A law of springs; `gather(me, you, r, link, sum)` takes one in, with r from me to you, and `finish(me, sum)` gives
    /// acceleration and potential per unit mass, of which each end holds half.
    pub fn links<S: Default>(
        name: &str,
        wgsl: Source,
        params: Vec<(String, Scalar)>,
        gather: impl Fn(&Body, &Body, DVec3, &Half, &mut S) + Send + Sync + 'static,
        finish: impl Fn(&Body, &S) -> DVec4 + Send + Sync + 'static,
    ) -> Self {
        let tied = twin::links(gather, finish);
        let twin = tied(Tables::None);
        Self { reciprocal: true, tied: Some(tied), ..Self::plain(name, Over::Links, wgsl, params, twin) }
    }
    /// A law of joints or triangles; `rule(corners, place, stiffness, world)` gives the force on the corner of that
    /// place, and the energy of the whole, of which each corner holds a third.
    pub fn corners(
        name: &str,
        over: Over,
        wgsl: Source,
        params: Vec<(String, Scalar)>,
        rule: impl Fn([&Body; 3], &Corner, &World) -> DVec4 + Send + Sync + 'static,
    ) -> Self {
        Self::plain(name, over, wgsl, params, twin::corners(over, rule))
    }
    /// Joins the law with its visit, for such a problem.
    ///
    /// # Errors
    /// [`Error::Shader`] when the WGSL does not compile, [`Error::Scene`] when a parameter is missing or unknown.
    pub fn kernel(self, problem: &Problem) -> Result<Kernel, Error> {
        match self.chosen(problem) {
            Over::Each => each::kernel(self, problem),
            Over::Pairs | Over::Within { .. } => pairs::kernel(self, problem),
            Over::Near { .. } | Over::Nearest { .. } => near::kernel(self, problem),
            Over::Tree { opening, core, .. } => tree::kernel(self, &Tree::new(opening, core, problem), problem),
            Over::Links | Over::Joints | Over::Triangles => links::kernel(self, problem),
        }
    }
    /// The grid that it searches, if it searches one, and whether it asks there for velocities.
    ///
    /// # Errors
    /// [`Error::Scene`] when its range is none.
    pub fn grid(&self, problem: &Problem) -> Result<Option<(Grid, bool)>, Error> {
        near::grid(self, problem)
    }
    /// The same law, of all images in a periodic box.
    #[must_use]
    pub fn of_all_images(mut self) -> Self {
        self.distant.images = true;
        self
    }
    /// Whom it visits for such a problem.
    #[must_use]
    pub fn chosen(&self, problem: &Problem) -> Over {
        match self.over {
            // Half a box away nearest images jump, and no group can be met as one there.
            Over::Tree { auto: true, .. } if problem.bounds.has(Side::Periodic) && !self.distant.images => Over::Pairs,
            over => over.chosen(problem),
        }
    }
    /// The tree that it walks, if it walks one.
    #[must_use]
    pub fn tree(&self, problem: &Problem) -> Option<Tree> {
        match self.chosen(problem) {
            Over::Tree { opening, core, .. } => Some(Tree::new(opening, core, problem)),
            _ => None,
        }
    }
    pub(super) fn uniforms(&self, shader: &Shader) -> Result<Vec<(&'static str, Vec<u8>)>, Error> {
        let values: Vec<_> = self.params.iter().map(|(name, value)| (name.as_str(), *value)).collect();
        match shader.reflection().binding("params") {
            Some(binding) => Ok(vec![("params", binding.packed.pack(&self.name, &values)?)]),
            None if values.is_empty() => Ok(Vec::new()),
            None => Err(Error::Scene(format!(
                "`{}` is given parameters, but {} uses no `@group(3) @binding(0) var<uniform> params: Params`",
                self.name, self.wgsl.file
            ))),
        }
    }
    /// The functions of a law over any visit but `each`.
    pub(super) fn requires_meetings(&self) -> Result<(), Error> {
        self.requires(&[
            ("gather", "fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>)"),
            ("finish", "fn finish(me: Particle, sum: Sum) -> vec4f"),
        ])
    }
    pub(super) fn requires(&self, functions: &[(&str, &str)]) -> Result<(), Error> {
        for (name, signature) in functions {
            if !self.wgsl.says(&["fn", name, "("]) {
                let message = format!(
                    "{}: a law over \"{}\" has `{signature}`, and this file has none",
                    self.wgsl.file,
                    self.over.name()
                );
                return Err(Error::Shader { message });
            }
        }
        Ok(())
    }
    /// What the law leaves to the usual: a sum of accelerations, and that it acts on everybody; and what it calls for.
    pub(super) fn files(&self) -> Vec<Source> {
        let mut files = Vec::new();
        if self.over != Over::Each && !self.wgsl.says(&["struct", "Sum", "{"]) {
            files.push(crate::shader!("visit/sum.wgsl"));
        }
        if self.over != Over::Each && !self.wgsl.says(&["fn", "acts_on", "("]) {
            files.push(crate::shader!("visit/everybody.wgsl"));
        }
        for (function, file) in ON_CALL {
            let called = self.wgsl.says(&[function, "("]) && !self.wgsl.says(&["fn", function, "("]);
            if called && !files.contains(&file) {
                files.push(file);
            }
        }
        files.push(self.wgsl.clone());
        files
    }
}
