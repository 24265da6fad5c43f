//! Kernels and plans: a step as data.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::sync::Arc;

use super::{Access, Binding, Host, Shader};
use crate::error::Error;

/// The second opinion: the same operation in f64 on the host's arrays.
pub type Twin = Arc<dyn Fn(&Host) -> Result<(), Error> + Send + Sync>;

/// The name of a field.
pub type Name = Cow<'static, str>;

/// A field that holds something from the start, and the words of its elements.
pub type Table = (Name, Arc<Vec<u32>>);

/// How many invocations a pass needs: `count` in the plane, times `layers`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Threads {
    /// Invocations in one layer; rounded up to whole workgroups, folded over two dimensions.
    pub count: u32,
    /// Layers: the third dimension of the dispatch.
    pub layers: u32,
}

impl Threads {
    /// One layer of invocations.
    #[must_use]
    pub fn new(count: u32) -> Self {
        Self { count, layers: 1 }
    }
}

/// One dispatch.
#[derive(Debug, Clone)]
pub struct Pass {
    /// What runs.
    pub shader: Arc<Shader>,
    /// Values of its `override`s.
    pub constants: Vec<(&'static str, f64)>,
    /// Contents of its uniform blocks other than `world`, by name.
    pub uniforms: Vec<(&'static str, Vec<u8>)>,
    /// Names in the shader that stand for another field: the name there, and the field. One shader may so serve many
    /// fields: a scan scans whatever it is given.
    pub fields: Vec<(&'static str, Name)>,
    /// How wide.
    pub threads: Threads,
    /// How many workgroups there are, where a field says so as it goes: three words of it, from this one on. What there is
    /// nothing to do for then costs next to nothing.
    pub told: Option<(Name, u32)>,
    /// About how much it does: meetings of two particles, or one per particle. Submissions are cut by it.
    pub work: u64,
}

impl Pass {
    /// A dispatch of one layer.
    #[must_use]
    pub fn new(shader: Arc<Shader>, count: u32) -> Self {
        let (constants, uniforms, fields) = (Vec::new(), Vec::new(), Vec::new());
        let (threads, work) = (Threads::new(count), u64::from(count));
        Self { shader, constants, uniforms, fields, threads, told: None, work }
    }
    /// The same with fields in place of names of the shader.
    #[must_use]
    pub fn on(mut self, fields: &[(&'static str, Name)]) -> Self {
        self.fields.extend_from_slice(fields);
        self
    }
    /// The field that a name of the shader stands for.
    #[must_use]
    pub fn field<'a>(&'a self, name: &'a str) -> &'a str {
        self.fields.iter().find(|(inside, _)| *inside == name).map_or(name, |(_, field)| field)
    }
    /// Its workgroups, folded over two dimensions where one is too short.
    ///
    /// # Errors
    /// [`Error::Limit`] when a device dispatches `limit` in one dimension, and that is too few.
    pub fn workgroups(&self, limit: u32) -> Result<[u32; 3], Error> {
        let workgroups = self.threads.count.div_ceil(self.shader.reflection().workgroup).max(1);
        let rows = workgroups.div_ceil(limit);
        if rows > limit || self.threads.layers > limit {
            let text = format!(
                "{} invocations need {workgroups} workgroups; this device dispatches {limit} × {limit}",
                self.threads.count
            );
            return Err(Error::Limit(text));
        }
        Ok([workgroups.div_ceil(rows), rows, self.threads.layers.max(1)])
    }
    /// What is bound, with the field that each binding stands for.
    pub fn bindings(&self) -> impl Iterator<Item = (&str, &Binding)> {
        self.shader.reflection().bindings.iter().map(|binding| (self.field(&binding.name), binding))
    }
}

/// One operation with a name: its dispatches, in order, and its twin.
#[derive(Clone)]
pub struct Kernel {
    /// What `motes explain` calls it, constants included.
    pub name: String,
    /// The dispatches.
    pub passes: Vec<Pass>,
    /// The same in f64. `None` only for a user's shader.
    pub twin: Option<Twin>,
    /// Elements of fields that do not have one element per particle.
    pub sizes: Vec<(Name, u64)>,
    /// Fields that hold nothing of worth after the last dispatch; the twin does without them.
    pub scratch: Vec<Name>,
    /// What fields hold from the start that nobody else fills: the words of their elements.
    pub tables: Vec<Table>,
}

impl Kernel {
    /// A kernel of one dispatch, named after its constants.
    #[must_use]
    pub fn new(name: &str, shader: Arc<Shader>, constants: Vec<(&'static str, f64)>, count: u32, twin: Twin) -> Self {
        let mut label = name.to_owned();
        let default = |key: &str| shader.reflection().overrides.get(key).copied().flatten();
        for (key, value) in constants.iter().filter(|(key, value)| default(key) != Some(*value)) {
            let _ = write!(label, " {key}={}", short(*value));
        }
        let pass = Pass { constants, ..Pass::new(shader, count) };
        Self {
            name: label,
            passes: vec![pass],
            twin: Some(twin),
            sizes: Vec::new(),
            scratch: Vec::new(),
            tables: Vec::new(),
        }
    }
    /// The fields that it writes, by name, without its scratch.
    #[must_use]
    pub fn writes(&self) -> Vec<String> {
        let mut names: Vec<String> = Vec::new();
        for (field, binding) in self.bindings() {
            let known = names.iter().any(|name| name == field);
            if binding.access == Access::Write && !self.is_scratch(field) && !known {
                names.push(field.to_owned());
            }
        }
        names
    }
    /// What its dispatches bind, with the field that each binding stands for.
    pub fn bindings(&self) -> impl Iterator<Item = (&str, &Binding)> {
        self.passes.iter().flat_map(Pass::bindings)
    }
    /// Whether a field holds nothing of worth after the last dispatch.
    #[must_use]
    pub fn is_scratch(&self, field: &str) -> bool {
        self.scratch.iter().any(|name| name == field)
    }
    /// The elements of a field, when it does not have one per particle.
    #[must_use]
    pub fn size(&self, field: &str) -> Option<u64> {
        self.sizes.iter().find(|(name, _)| name == field).map(|(_, elements)| *elements)
    }
    /// Whether its dispatches are those of another.
    fn runs_as(&self, other: &Self) -> bool {
        let same = |(a, b): (&Pass, &Pass)| {
            let content = a.shader.text() == b.shader.text() && a.constants == b.constants && a.uniforms == b.uniforms;
            content && a.threads == b.threads && a.fields == b.fields && a.told == b.told
        };
        self.passes.len() == other.passes.len() && self.passes.iter().zip(&other.passes).all(same)
    }
    /// Whether any of its shaders names this field.
    #[must_use]
    pub fn names(&self, field: &str) -> bool {
        self.bindings().any(|(name, _)| name == field)
    }
}

/// At most six digits: `0.675604`, `-0.5`, `1`.
#[must_use]
pub fn short(x: f64) -> String {
    let text = format!("{x:.6}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

impl std::fmt::Debug for Kernel {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Kernel({})", self.name)
    }
}

/// Kernels in the order in which they run. A kernel that runs twice is stored once.
#[derive(Debug, Default, Clone)]
pub struct Plan {
    /// The different kernels.
    pub kernels: Vec<Kernel>,
    /// Their order.
    pub order: Vec<usize>,
}

impl Plan {
    /// Adds a kernel at the end, under a name.
    ///
    /// # Errors
    /// What `make` says.
    pub fn push(&mut self, name: &str, make: impl FnOnce() -> Result<Kernel, Error>) -> Result<(), Error> {
        let mut kernel = make()?;
        name.clone_into(&mut kernel.name);
        self.add(kernel);
        Ok(())
    }
    /// Adds a kernel at the end; the same one that is there already is used again. A name alone does not make it the
    /// same: a user's force may be called `drift`.
    pub fn add(&mut self, kernel: Kernel) {
        let known = self.kernels.iter().position(|k| k.name == kernel.name && k.runs_as(&kernel));
        let index = known.unwrap_or(self.kernels.len());
        if known.is_none() {
            self.kernels.push(kernel);
        }
        self.order.push(index);
    }
    /// The kernels in order.
    pub fn steps(&self) -> impl Iterator<Item = &Kernel> {
        self.order.iter().filter_map(|i| self.kernels.get(*i))
    }
    /// What a field holds from the start, if any kernel says so.
    #[must_use]
    pub fn table(&self, field: &str) -> Option<&Arc<Vec<u32>>> {
        let tables = self.kernels.iter().flat_map(|kernel| &kernel.tables);
        tables.into_iter().find(|(name, _)| name == field).map(|(_, words)| words)
    }
    /// Dispatches in one run.
    #[must_use]
    pub fn dispatches(&self) -> usize {
        self.steps().map(|k| k.passes.len()).sum()
    }
    /// Work in one run; see [`Pass::work`].
    #[must_use]
    pub fn work(&self) -> u64 {
        self.steps().flat_map(|k| &k.passes).map(|p| p.work).sum()
    }
    /// Bytes of every storage field that the plan names, for so many particles.
    #[must_use]
    pub fn fields(&self, count: u32) -> BTreeMap<String, u64> {
        let mut fields = BTreeMap::new();
        for kernel in &self.kernels {
            for (field, binding) in kernel.bindings().filter(|(_, b)| b.access != Access::Uniform) {
                let elements = kernel.size(field).unwrap_or(u64::from(count));
                // A device binds no empty array, and no part of an element.
                let bytes = if binding.array { binding.stride * elements.max(1) } else { binding.stride };
                let entry = fields.entry(field.to_owned()).or_insert(0);
                *entry = bytes.max(*entry);
            }
            for (name, from) in kernel.passes.iter().filter_map(|pass| pass.told.as_ref()) {
                let entry = fields.entry(name.to_string()).or_insert(0);
                *entry = (4 * kernel.size(name).unwrap_or(u64::from(*from) + 3)).max(*entry);
            }
        }
        fields
    }
}

/// The shortest block of two to four names that comes more than twice in a row at the start, and how often; or one name, once.
fn repeated(names: &[String]) -> (usize, usize) {
    let times = |length: usize| {
        let Some(block) = names.get(..length) else { return (length, 0) };
        (length, names.chunks_exact(length).take_while(|next| *next == block).count())
    };
    (2..=4).map(times).find(|(_, times)| *times > 2).unwrap_or((1, 1))
}

impl std::fmt::Display for Plan {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let name = |kernel: &Kernel| match kernel.passes.len() {
            1 => kernel.name.clone(),
            n => format!("{} ×{n}", kernel.name),
        };
        let names: Vec<String> = self.steps().map(name).collect();
        let mut at = 0;
        while at < names.len() {
            let bar = if at == 0 { "" } else { " | " };
            // What comes many times in a row, as iterations do, is written once.
            let (length, times) = repeated(&names[at..]);
            let block = names[at..at + length].join(" | ");
            if times > 1 {
                write!(f, "{bar}({block}) ×{times}")?;
            } else {
                write!(f, "{bar}{block}")?;
            }
            at += length * times;
        }
        Ok(())
    }
}
