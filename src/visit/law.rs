//! Laws: interactions of particles, in WGSL and as an f64 reference.

use std::sync::Arc;

use glam::{DVec3, DVec4};

use super::reference::{ByTables, Sample};
use super::{
    Group, Jacobian, Loads, Memory, Outcome, Outlined, Over, PairTable, Particle, Search, Tables, each, links, list,
    near, pairs, reference, tree, two_words, virial, walk,
};
use crate::error::Error;
use crate::kernel::{
    ACCELERATION, Access, Kernel, Name, Problem, Reference, Scalar, Shader, Side, Source, Table, VELOCITY, World,
};
use crate::links::{Half, Shared};
use crate::neighbors::Grid;
use crate::tree::Tree;

/// A law: an interaction of the particles `me` and `you`, or a force on `me` alone.
#[derive(Clone)]
pub struct Law {
    /// Its name, for `motes explain` and messages.
    pub name: String,
    /// Which pairs are evaluated.
    pub over: Over,
    /// Its WGSL. Over `each` it has `fn force(me: Particle) -> vec4f`; over all others it has `fn gather` and `fn finish`,
    /// see `shaders/visit/span.wgsl`, and may have `fn acts_on(me: Particle) -> bool` to be left out of a search. Over `list` with slots
    /// it may call `recall` and `remember`, see [`Law::remembering`].
    pub wgsl: Source,
    /// The members of its `Params`, by name.
    pub params: Vec<(String, Scalar)>,
    /// Parameters of pairs of species, where it has any: `var<storage, read> pair_table: array<Pair>`.
    pub pairs: Option<PairTable>,
    /// Values for `override`s, some of which its files may not have.
    pub constants: Vec<(&'static str, f64)>,
    /// Tables of data, by the names under which its WGSL binds them.
    pub tables: Vec<Table>,
    /// The columns that it writes; by default `acceleration`. Each other column is bound as `var<storage, read_write>` under its name.
    /// Without `acceleration` its `finish` returns nothing, and over `each` it has `fn update(me: Particle)` in place of `force`.
    pub into: Vec<Name>,
    /// The visit's reference, with the law's inside; `None` for a user's law, and for an outlined one.
    pub reference: Option<Reference>,
    /// Whether the forces of a pair are equal and opposite, so that momentum is conserved.
    pub reciprocal: bool,
    /// Its Jacobian for implicit integrators, if it has one.
    pub jacobian: Option<Jacobian>,
    /// Over `links`: the length below which stiff links are \[length\], if there is one: see [`Law::shorter_than`].
    pub longest: Option<f64>,
    /// Its approximation of a far group, over `tree`.
    pub distant: Distant,
    /// Over `links`: its reference for the tables of a problem.
    pub tied: Option<ByTables>,
    /// Its search, if it needs more than a range.
    pub search: Option<Search>,
    /// The rest of a law of a method with numbers that depend on the box: see [`Law::outlined`].
    pub outlined: Option<Outlined>,
    /// Files beside its own, which have the functions that its visit calls.
    pub beside: Vec<Source>,
    /// The reference of the virial of its pairs, links or joints; `None` where there is none.
    pub virial: Option<ByTables>,
    /// Pairs up to so many bonds apart are not evaluated, over a list; 0: all are.
    pub exclude: u32,
    /// The number of laws of its name before it, which have tables of the same names: see [`Law::after`].
    pub earlier: usize,
}

/// The name of what has `earlier` of its kind before it.
#[must_use]
pub fn numbered(name: &str, earlier: usize) -> String {
    if earlier == 0 { name.to_owned() } else { format!("{name} {}", earlier + 1) }
}

/// A law's approximation of a far group.
#[derive(Clone, Default)]
pub struct Distant {
    /// Its WGSL; without it a group is evaluated as one particle.
    pub wgsl: Option<Source>,
    /// The reference that opens the same nodes as the device.
    pub walk: Option<Reference>,
    /// The accelerations of some targets by direct summation.
    pub sample: Option<Sample>,
    /// Whether it includes all images in a periodic box, so that forces do not jump at half a box.
    pub images: bool,
}

impl Law {
    /// A law with only its WGSL and its reference, which computes an acceleration.
    #[must_use]
    pub fn plain(name: &str, over: Over, wgsl: Source, params: Vec<(String, Scalar)>, reference: Reference) -> Self {
        Self { reference: Some(reference), ..Self::own(name, over, wgsl, params) }
    }
    /// The same without a reference, as a user's law is.
    #[must_use]
    pub fn own(name: &str, over: Over, wgsl: Source, params: Vec<(String, Scalar)>) -> Self {
        Self {
            name: name.to_owned(),
            over,
            wgsl,
            params,
            pairs: None,
            constants: Vec::new(),
            tables: Vec::new(),
            into: vec![ACCELERATION.name.into()],
            reference: None,
            reciprocal: false,
            jacobian: None,
            longest: None,
            distant: Distant::default(),
            tied: None,
            search: None,
            outlined: None,
            beside: Vec::new(),
            virial: None,
            exclude: 0,
            earlier: 0,
        }
    }
    /// The same law with so many of its name before it: its kernel and its tables have names of their own.
    #[must_use]
    pub fn after(self, earlier: usize) -> Self {
        Self { name: numbered(&self.name, earlier), earlier, ..self }
    }
    /// Whether it keeps history of pairs.
    #[must_use]
    pub fn remembers(&self) -> bool {
        matches!(self.over, Over::List { slots: 1.., .. })
    }
    /// A law of each particle alone; `rule(me, world)` returns acceleration and potential per unit mass.
    pub fn each(
        name: &str,
        wgsl: Source,
        params: Vec<(String, Scalar)>,
        rule: impl Fn(&Particle, &World) -> DVec4 + Send + Sync + 'static,
    ) -> Self {
        Self::plain(name, Over::Each, wgsl, params, reference::each(rule))
    }
    /// A pairwise additive law of all pairs: [`Law::between`] over [`Over::Pairs`].
    pub fn pairs(
        name: &str,
        wgsl: Source,
        params: Vec<(String, Scalar)>,
        rule: impl Fn(&Particle, &Particle, DVec3) -> DVec4 + Send + Sync + 'static,
    ) -> Self {
        Self::between(name, Over::Pairs, wgsl, params, rule)
    }
    /// A pairwise additive law; `rule(me, you, r)`, with r from me to you, returns your contribution to my acceleration and potential per
    /// unit mass. Forces are equal and opposite.
    pub fn between(
        name: &str,
        over: Over,
        wgsl: Source,
        params: Vec<(String, Scalar)>,
        rule: impl Fn(&Particle, &Particle, DVec3) -> DVec4 + Send + Sync + 'static,
    ) -> Self {
        let gather = move |me: &Particle, you: &Particle, r, sum: &mut DVec4| *sum += rule(me, you, r);
        Self { reciprocal: true, ..Self::gathering(name, over, wgsl, params, gather, |_, sum, _| *sum) }
    }
    /// A pairwise law that may depend on the box, with an approximation of far groups: `rule(me, you, r, world)` and
    /// `far(me, group, r, world)`, with r from me to you or to the group's centre of mass, return acceleration and potential per unit mass.
    /// `distant` is the WGSL of the latter, `fn distant(me: Particle, you: Group, r: vec3f, sum: ptr<function, Sum>)`; without it the group
    /// is evaluated as one particle.
    pub fn attracting(
        name: &str,
        over: Over,
        files: (Source, Option<Source>),
        params: Vec<(String, Scalar)>,
        rule: impl Fn(&Particle, &Particle, DVec3, &World) -> DVec4 + Send + Sync + 'static,
        far: impl Fn(&Particle, &Group, DVec3, &World) -> DVec4 + Send + Sync + 'static,
    ) -> Self {
        let rule = Arc::new(rule);
        let (wgsl, distant) = files;
        let (every, sample) = (rule.clone(), Some(reference::sample(rule.clone())));
        let pair = every.clone();
        let gather =
            move |me: &Particle, you: &Particle, r, world: &World, sum: &mut DVec4| *sum += every(me, you, r, world);
        let each =
            move |me: &Particle, you: &Particle, r, world: &World, sum: &mut DVec4| *sum += pair(me, you, r, world);
        let virial = Some(virial::reference(over, each, |_, sum: &DVec4, _| *sum));
        let walk = match over {
            Over::Tree { opening, core, .. } => Some(walk::reference(opening, core, rule, far)),
            _ => None,
        };
        let reference = reference::gathering(over, gather, |_, sum: &DVec4, _| *sum);
        Self {
            reciprocal: true,
            distant: Distant { wgsl: distant, walk, sample, images: false },
            virial,
            ..Self::plain(name, over, wgsl, params, reference)
        }
    }
    /// A law that computes a quantity other than a sum of accelerations from the neighbours; `gather(me, you, r, sum)` adds each neighbour,
    /// in any order, and `finish(me, sum, world)` returns acceleration and potential per unit mass.
    pub fn gathering<S: Default>(
        name: &str,
        over: Over,
        wgsl: Source,
        params: Vec<(String, Scalar)>,
        gather: impl Fn(&Particle, &Particle, DVec3, &mut S) + Send + Sync + 'static,
        finish: impl Fn(&Particle, &S, &World) -> DVec4 + Send + Sync + 'static,
    ) -> Self {
        let (gather, finish) = (Arc::new(gather), Arc::new(finish));
        let (each, end) = (gather.clone(), finish.clone());
        let gather = move |me: &Particle, you: &Particle, r, _: &World, sum: &mut S| gather(me, you, r, sum);
        let finish = move |me: &Particle, sum: &S, world: &World| finish(me, sum, world);
        let each = move |me: &Particle, you: &Particle, r, _: &World, sum: &mut S| each(me, you, r, sum);
        let end = move |me: &Particle, sum: &S, world: &World| end(me, sum, world);
        let virial = Some(virial::reference(over, each, end));
        Self { virial, ..Self::plain(name, over, wgsl, params, reference::gathering(over, gather, finish)) }
    }
    /// The same for a law that writes columns: `finish(me, sum, world, outcome)` sets their values. `into` names all that it writes,
    /// including `acceleration` if it computes one.
    pub fn computing<S: Default>(
        name: &str,
        over: Over,
        wgsl: Source,
        params: Vec<(String, Scalar)>,
        into: &[&'static str],
        gather: impl Fn(&Particle, &Particle, DVec3, &World, &mut S) + Send + Sync + 'static,
        finish: impl Fn(&Particle, &S, &World, &mut Outcome) + Send + Sync + 'static,
    ) -> Self {
        let into = into.iter().map(|name| Name::from(*name)).collect();
        Self { into, ..Self::plain(name, over, wgsl, params, reference::computing(over, gather, finish)) }
    }
    /// A law of each particle alone that writes columns; `rule(me, world, outcome)` sets their values.
    pub fn updating(
        name: &str,
        wgsl: Source,
        params: Vec<(String, Scalar)>,
        into: &[&'static str],
        rule: impl Fn(&Particle, &World, &mut Outcome) + Send + Sync + 'static,
    ) -> Self {
        let into = into.iter().map(|name| Name::from(*name)).collect();
        Self { into, ..Self::plain(name, Over::Each, wgsl, params, reference::updating(rule)) }
    }
    /// A law over [`Over::List`] that keeps history of pairs, such as friction at a contact; `gather(me, you, r, world, memory, sum)` adds
    /// a neighbour, and `finish(me, sum, world, outcome)` is that of [`Law::computing`]. Its WGSL has, in addition to the usual functions,
    /// `fn recall(you: Particle, word: u32) -> f32`, the value stored by the last step, and
    /// `fn remember(you: Particle, word: u32, value: f32)`, which stores a value for the next step. A pair that is out of range, or for
    /// which a step stores nothing, begins with zeros. Each of the two particles has words of its own.
    pub fn remembering<S: Default>(
        name: &str,
        over: (f64, Option<f64>, u32),
        wgsl: Source,
        params: Vec<(String, Scalar)>,
        into: &[&'static str],
        gather: impl Fn(&Particle, &Particle, DVec3, &World, &mut Memory<'_>, &mut S) + Send + Sync + 'static,
        finish: impl Fn(&Particle, &S, &World, &mut Outcome) + Send + Sync + 'static,
    ) -> Self {
        let (range, skin, slots) = over;
        let reference = list::remembering(range, slots as usize, gather, finish);
        let into = into.iter().map(|name| Name::from(*name)).collect();
        Self { into, ..Self::plain(name, Over::List { range, skin, slots }, wgsl, params, reference) }
    }
    /// A law of springs; `gather(me, you, r, link, sum)` adds one, with r from me to you, and `finish(me, sum)` returns acceleration and
    /// potential per unit mass, half of which belongs to each end.
    pub fn links<S: Default>(
        name: &str,
        wgsl: Source,
        params: Vec<(String, Scalar)>,
        gather: impl Fn(&Particle, &Particle, DVec3, &Half, &mut S) + Send + Sync + 'static,
        finish: impl Fn(&Particle, &S) -> DVec4 + Send + Sync + 'static,
    ) -> Self {
        let (gather, finish) = (Arc::new(gather), Arc::new(finish));
        let (each, end) = (gather.clone(), finish.clone());
        let each = move |me: &Particle, you: &Particle, r, link: &Half, sum: &mut S| each(me, you, r, link, sum);
        let virial = Some(virial::links(each, move |me: &Particle, sum: &S| end(me, sum)));
        let gather = move |me: &Particle, you: &Particle, r, link: &Half, sum: &mut S| gather(me, you, r, link, sum);
        let tied = reference::links(gather, move |me: &Particle, sum: &S| finish(me, sum));
        let reference = tied(Tables::None);
        Self { reciprocal: true, tied: Some(tied), virial, ..Self::plain(name, Over::Links, wgsl, params, reference) }
    }
    /// A law of joints or triangles (three corners) or of dihedrals (four); `rule(corners, corner, world)` returns the force on the one with the
    /// index `corner.place`, and the energy of the whole, of which each corner has the same part.
    pub fn corners<const N: usize, C: Shared<N>>(
        name: &str,
        over: Over,
        wgsl: Source,
        params: Vec<(String, Scalar)>,
        rule: impl Fn([&Particle; N], &C, &World) -> DVec4 + Send + Sync + 'static,
    ) -> Self {
        let rule = Arc::new(rule);
        let virial = (over != Over::Triangles).then(|| virial::corners(over, rule.clone()));
        let rule = move |at: [&Particle; N], corner: &C, world: &World| rule(at, corner, world);
        Self { virial, ..Self::plain(name, over, wgsl, params, reference::corners(over, rule)) }
    }
    /// The kernel of the law with its visit, for a problem.
    ///
    /// # Errors
    /// [`Error::Shader`] when the WGSL does not compile, [`Error::Scene`] when a parameter is missing or unknown.
    pub fn kernel(self, problem: &Problem) -> Result<Kernel, Error> {
        let law = self.settled(problem).made(problem)?;
        let mut kernel = law.clone().visiting(problem)?;
        law.bind_tables(&mut kernel, problem)?;
        law.check_columns(&mut kernel, problem)?;
        law.mark_alone(&mut kernel);
        Ok(kernel)
    }
    pub(super) fn visiting(self, problem: &Problem) -> Result<Kernel, Error> {
        let over = self.chosen(problem);
        two_words::check(&self, over, problem)?;
        self.check_exclusions(problem)?;
        let kernel = match over {
            Over::Each => each::kernel(self, problem),
            Over::Pairs | Over::Within { .. } => pairs::kernel(self, problem),
            Over::Near { .. } | Over::Nearest { .. } => near::kernel(self, problem),
            Over::List { range, slots, .. } => list::kernel(self, range, slots, problem),
            Over::Auto { .. } => Err(Error::Scene(format!("`{}` has no visit", self.name))),
            Over::Tree { opening, core, .. } => tree::kernel(self, &Tree::new(opening, core, problem), problem),
            Over::Links | Over::Joints | Over::Dihedrals | Over::Triangles => links::kernel(self, problem),
        };
        kernel.map(|kernel| two_words::refined(kernel, over, problem))
    }
    /// The grid that it searches, if any, and whether it reads velocities there.
    ///
    /// # Errors
    /// [`Error::Scene`] when its range is invalid.
    pub fn grid(&self, problem: &Problem) -> Result<Option<(Grid, bool)>, Error> {
        near::grid(&self.settled(problem).made(problem)?, problem)
    }
    /// Whether it reads velocities, of the particle or of neighbours.
    ///
    /// # Errors
    /// As [`Law::kernel`].
    pub fn depends_on_velocity(&self, problem: &Problem) -> Result<bool, Error> {
        Ok(self.clone().kernel(problem)?.names(VELOCITY.name))
    }
    /// The same law, including all images in a periodic box.
    #[must_use]
    pub fn of_all_images(mut self) -> Self {
        self.distant.images = true;
        self
    }
    /// Its visit for a problem.
    #[must_use]
    pub fn chosen(&self, problem: &Problem) -> Over {
        match self.over {
            // At half a box the nearest image jumps, and no group can be evaluated as one there.
            Over::Tree { auto: true, .. } if problem.bounds.has(Side::Periodic) && !self.distant.images => Over::Pairs,
            Over::Tree { .. } => self.over.chosen(problem),
            _ => self.faster(problem),
        }
    }
    /// What it loads of its neighbours.
    pub(super) fn loads(&self) -> Loads {
        if self.outlined.is_some() || self.search.is_some() {
            return Loads::Fields;
        }
        // Linked with the function that loads them.
        if self.wgsl.needs("velocity_of") { Loads::Velocities } else { Loads::Positions }
    }
    /// The same law with [`Over::Auto`] resolved: over the cell list or the kept list.
    pub(super) fn settled(&self, problem: &Problem) -> Self {
        Self { over: self.faster(problem), ..self.clone() }
    }
    /// Its visit with [`Over::Auto`] resolved; only a list can lack pairs.
    pub(super) fn faster(&self, problem: &Problem) -> Over {
        match self.over {
            Over::Auto { range, skin } if self.exclude > 0 => Over::List { range, skin, slots: 0 },
            over => over.faster(self.loads(), problem),
        }
    }
    /// The same law without pairs up to so many bonds apart (1–2, 1–3, 1–4 pairs).
    #[must_use]
    pub fn excluding(self, bonds: u32) -> Self {
        Self { exclude: bonds, ..self }
    }
    /// The tree that it walks, if any.
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
            Some(binding) => Ok(vec![("params", binding.packed.pack(&format!("the law `{}`", self.name), &values)?)]),
            None if values.is_empty() => Ok(Vec::new()),
            None => Err(Error::Scene(format!(
                "`{}` is given parameters, but {} uses no `@group(3) @binding(0) var<uniform> params: Params`",
                self.name, self.wgsl.file
            ))),
        }
    }
    /// Whether it computes an acceleration.
    #[must_use]
    pub fn accelerates(&self) -> bool {
        self.into.iter().any(|name| name == ACCELERATION.name)
    }
    /// The end of its WGSL.
    pub(super) fn finish(&self) -> (&'static str, &'static str) {
        let text = if self.accelerates() {
            "fn finish(me: Particle, sum: Sum) -> vec4f"
        } else {
            "fn finish(me: Particle, sum: Sum)"
        };
        ("finish", text)
    }
    /// Checks the functions of a law over any visit but `each`.
    pub(super) fn requires_gather(&self) -> Result<(), Error> {
        // Laws of a method have these functions in several files.
        if self.search.is_some() || !self.beside.is_empty() {
            return Ok(());
        }
        if self.is_potential() {
            let even = "fn even_energy(me: Particle, you: Particle, square: f32, inverse: f32) -> Energy";
            let energy = "fn energy(me: Particle, you: Particle, distance: f32, inverse: f32) -> Energy";
            self.requires(&[if self.is_even() { ("even_energy", even) } else { ("energy", energy) }])?;
            return self.agrees("fn acts_on(me: Particle) -> bool");
        }
        self.requires(&[
            ("gather", "fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>)"),
            self.finish(),
        ])?;
        self.agrees("fn acts_on(me: Particle) -> bool")?;
        self.agrees(super::files::MERGE)
    }
    /// Checks whether it writes the columns that it names, and whether every bound column is of the declared kind.
    fn check_columns(&self, kernel: &mut Kernel, problem: &Problem) -> Result<(), Error> {
        let file = &self.wgsl.file;
        let mut sizes = Vec::new();
        for name in &self.into {
            let known = problem.columns.get(name);
            if known.is_none() && self.search.is_none() {
                return Err(Error::Scene(format!(
                    "`{}` writes `{name}`, which is no column of this simulation: declare it (in a scene: [[column]] name = \"{name}\")",
                    self.name
                )));
            }
            // Without particles nothing is written.
            let own = self.search.as_ref().and_then(|search| search.field(name));
            let field = own.as_ref().unwrap_or(name);
            if !kernel.passes.is_empty() && !kernel.writes().iter().any(|written| written == field) {
                return Err(Error::Scene(format!(
                    "`{}` is to write the column `{name}`, but {file} binds no `var<storage, read_write> {name}` that it uses",
                    self.name
                )));
            }
        }
        for (name, binding) in kernel.bindings() {
            let Some(column) = problem.columns.get(name).filter(|column| !column.is_packed()) else { continue };
            // A struct of a method may contain all numbers of a particle.
            let struct_of = |k: u32| self.search.is_some() && k > 1 && binding.stride == 4 * u64::from(k);
            if matches!(column.shape, crate::kernel::Shape::Slots(k) if struct_of(k)) {
                continue;
            }
            let shared = problem.columns.of_buffer(name).count() > 1;
            let right = match column.kind {
                crate::kernel::Kind::Whole => !binding.float && binding.stride == 4,
                crate::kernel::Kind::Scalar if !shared => binding.float && binding.stride == 4,
                _ => binding.float && binding.stride == 16,
            };
            if !right {
                return Err(Error::Scene(format!(
                    "{file} binds the column `{name}` with elements of {} bytes; it is a {}, which is `array<{}>`",
                    binding.stride,
                    column.kind.name(),
                    column.kind.wgsl()
                )));
            }
            if binding.access == Access::Write && !self.into.iter().any(|written| written == name) {
                return Err(Error::Scene(format!(
                    "{file} binds the column `{name}` as read_write, and `into` of `{}` does not name it: add it there",
                    self.name
                )));
            }
            if column.shape != crate::kernel::Shape::Particle {
                sizes.push((column.name.clone(), column.shape.len(problem.capacity as usize) as u64));
            }
        }
        kernel.sizes.extend(sizes);
        Ok(())
    }
    pub(super) fn requires(&self, functions: &[(&str, &str)]) -> Result<(), Error> {
        for (name, signature) in functions {
            if !self.wgsl.defines(name) {
                let message = format!(
                    "{}: a law over \"{}\" requires `{signature}`, and this file has none",
                    self.wgsl.file,
                    self.over.name()
                );
                return Err(Error::Shader { message });
            }
            self.agrees(signature)?;
        }
        Ok(())
    }
    /// Refuses a user's function that differs from the one that its visit calls.
    fn agrees(&self, signature: &str) -> Result<(), Error> {
        let wrong = self.wgsl.law.then(|| self.wgsl.mismatch(signature)).flatten();
        wrong.map_or(Ok(()), |message| Err(Error::Shader { message }))
    }
}
