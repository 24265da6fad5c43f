//! Kernels and plans: a step as data.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::sync::Arc;

use super::{Access, Binding, Flag, Host, Indirect, Op, Pass, Shader, Walk};
use crate::error::Error;

/// The reference: the same operation in f64 on the host's arrays.
pub type Reference = Arc<dyn Fn(&Host) -> Result<(), Error> + Send + Sync>;

/// The name of a field.
pub type Name = Cow<'static, str>;

/// A field with initial contents, and the words of its elements.
pub type Table = (Name, Arc<Vec<u32>>);

/// One operation with a name: its dispatches, in order, and its reference.
#[derive(Clone)]
pub struct Kernel {
    /// Its name in `motes explain`, constants included.
    pub name: String,
    /// The dispatches.
    pub passes: Vec<Pass>,
    /// The reference in f64. `None` only for a user's shader.
    pub reference: Option<Reference>,
    /// Elements of fields that do not have one element per particle.
    pub sizes: Vec<(Name, u64)>,
    /// Fields whose contents are not needed after the last dispatch; the reference does without them.
    pub scratch: Vec<Name>,
    /// The initial contents of fields that no kernel fills: the words of their elements.
    pub tables: Vec<Table>,
}

impl Kernel {
    /// A kernel of one dispatch, named after its constants.
    #[must_use]
    pub fn new(
        name: &str,
        shader: Arc<Shader>,
        constants: Vec<(&'static str, f64)>,
        count: u32,
        reference: Reference,
    ) -> Self {
        let mut label = name.to_owned();
        let default = |key: &str| shader.reflection().overrides.get(key).copied().flatten();
        for (key, value) in constants.iter().filter(|(key, value)| default(key) != Some(*value)) {
            let _ = write!(label, " {key}={}", short(*value));
        }
        let pass = Pass { constants, ..Pass::new(shader, count) };
        Self {
            name: label,
            passes: vec![pass],
            reference: Some(reference),
            sizes: Vec::new(),
            scratch: Vec::new(),
            tables: Vec::new(),
        }
    }
    /// The same, of dispatches that treat each particle alone; see [`Pass::alone`].
    #[must_use]
    pub fn alone(mut self) -> Self {
        self.passes.iter_mut().for_each(|pass| pass.alone = true);
        self
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
    /// The bindings of its dispatches, with the field bound to each.
    pub fn bindings(&self) -> impl Iterator<Item = (&str, &Binding)> {
        self.passes.iter().flat_map(Pass::bindings)
    }
    /// Whether the contents of a field are not needed after the last dispatch.
    #[must_use]
    pub fn is_scratch(&self, field: &str) -> bool {
        self.scratch.iter().any(|name| name == field)
    }
    /// The elements of a field, when it does not have one per particle.
    #[must_use]
    pub fn size(&self, field: &str) -> Option<u64> {
        self.sizes.iter().find(|(name, _)| name == field).map(|(_, elements)| *elements)
    }
    /// Whether its dispatches equal those of another.
    fn runs_as(&self, other: &Self) -> bool {
        let same = |(a, b): (&Pass, &Pass)| {
            let content = a.shader.text() == b.shader.text() && a.constants == b.constants && a.uniforms == b.uniforms;
            content && a.threads == b.threads && a.fields == b.fields && a.indirect == b.indirect
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

/// Kernels and the order in which they run. A kernel that runs twice is stored once.
#[derive(Debug, Default, Clone)]
pub struct Plan {
    /// The different kernels.
    pub kernels: Vec<Kernel>,
    /// The kernels, in order.
    pub ops: Vec<Op>,
}

impl Plan {
    /// Kernels, one after another.
    #[must_use]
    pub fn of(kernels: impl IntoIterator<Item = Kernel>) -> Self {
        let mut plan = Self::default();
        kernels.into_iter().for_each(|kernel| plan.add(kernel));
        plan
    }
    /// Whether it has no operations.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.ops.is_empty()
    }
    /// Adds a kernel at the end, under a name.
    ///
    /// # Errors
    /// Errors of `make`.
    pub fn push(&mut self, name: &str, make: impl FnOnce() -> Result<Kernel, Error>) -> Result<(), Error> {
        let mut kernel = make()?;
        name.clone_into(&mut kernel.name);
        self.add(kernel);
        Ok(())
    }
    /// Adds a kernel at the end; an identical one that is already there is reused. The same name does not make kernels identical: a user's
    /// force may be called `drift`.
    pub fn add(&mut self, kernel: Kernel) {
        let index = self.place(kernel);
        self.ops.push(Op::Run(index));
    }
    /// Appends all operations of another plan.
    pub fn append(&mut self, other: Self) {
        let body = self.taken(other);
        self.ops.extend(body);
    }
    /// Adds a loop: runs `body` repeatedly until `member` of an element of `field` is not zero, at most `most` times. The member is a
    /// number of the struct that a kernel of the body writes there.
    ///
    /// # Errors
    /// [`Error::Device`] when the body does not write such a member: the loop would not end by itself.
    pub fn repeat(
        &mut self,
        most: u32,
        field: impl Into<Name>,
        element: u32,
        member: &'static str,
        body: Self,
    ) -> Result<(), Error> {
        let field = field.into();
        let written = |binding: &Binding| {
            let its = binding.packed.members.iter().find(|its| its.name == member && its.components == 1)?;
            let bytes = binding.stride * u64::from(element) + its.offset as u64;
            (binding.access == Access::Write).then(|| u32::try_from(bytes / 4).ok()).flatten()
        };
        let mut its = body.kernels.iter().flat_map(Kernel::bindings).filter(|(name, _)| *name == field);
        let word = its.find_map(|(_, binding)| written(binding));
        drop(its);
        let Some(word) = word else {
            return Err(Error::Device(format!(
                "a loop ends by `{member}` of `{field}`, which none of its kernels writes"
            )));
        };
        let body = self.taken(body);
        let until = Flag { field, word, member };
        self.ops.push(Op::Repeat { most, until, body });
        Ok(())
    }
    /// Removes operations of unwanted kernels; the kernels stay in the list.
    pub fn retain(&mut self, wanted: impl Fn(&Kernel) -> bool) {
        let kept = |index: usize| self.kernels.get(index).is_some_and(&wanted).then_some(index);
        self.ops = self.ops.iter().filter_map(|op| op.mapped(&kept)).collect();
    }
    /// The kernel that runs first, unless it runs again later or in a loop.
    pub fn first_mut(&mut self) -> Option<&mut Kernel> {
        let Some(Op::Run(first)) = self.ops.first() else { return None };
        let again = self.ops.iter().skip(1).flat_map(Op::kernels).any(|index| index == *first);
        self.kernels.get_mut(*first).filter(|_| !again)
    }
    /// The kernels in order; those of a loop once.
    pub fn steps(&self) -> impl Iterator<Item = &Kernel> {
        self.ops.iter().flat_map(Op::kernels).filter_map(|index| self.kernels.get(index))
    }
    /// A run of it, for a backend that can read the flags of loops on the way.
    #[must_use]
    pub fn walk(&self) -> Walk<'_> {
        Walk::new(self)
    }
    pub(super) fn place(&mut self, kernel: Kernel) -> usize {
        let known = self.kernels.iter().position(|k| k.name == kernel.name && k.runs_as(&kernel));
        known.unwrap_or_else(|| {
            self.kernels.push(kernel);
            self.kernels.len() - 1
        })
    }
    /// Takes the kernels of another plan, and returns its operations with the indices of this one.
    fn taken(&mut self, other: Self) -> Vec<Op> {
        let places: Vec<usize> = other.kernels.into_iter().map(|kernel| self.place(kernel)).collect();
        other.ops.iter().filter_map(|op| op.mapped(&|index| places.get(index).copied())).collect()
    }
    /// The initial contents of a field, if any kernel gives them.
    #[must_use]
    pub fn table(&self, field: &str) -> Option<&Arc<Vec<u32>>> {
        let tables = self.kernels.iter().flat_map(|kernel| &kernel.tables);
        tables.into_iter().find(|(name, _)| name == field).map(|(_, words)| words)
    }
    /// Dispatches in one run, loops in full.
    #[must_use]
    pub fn dispatches(&self) -> u64 {
        self.total(|kernel| kernel.passes.len() as u64)
    }
    /// Work in one run, loops in full; see [`Pass::work`].
    #[must_use]
    pub fn work(&self) -> u64 {
        self.total(|kernel| kernel.passes.iter().map(|pass| pass.work).sum())
    }
    fn total(&self, of: impl Fn(&Kernel) -> u64) -> u64 {
        let of = |index: usize| self.kernels.get(index).map_or(0, &of);
        self.ops.iter().map(|op| op.total(&of)).sum()
    }
    /// Bytes of every storage field that the plan names, for `count` particles.
    #[must_use]
    pub fn fields(&self, count: u32) -> BTreeMap<String, u64> {
        let mut fields = BTreeMap::new();
        for kernel in &self.kernels {
            for (field, binding) in kernel.bindings().filter(|(_, b)| b.access != Access::Uniform) {
                let elements = kernel.size(field).unwrap_or(u64::from(count));
                // A device binds neither empty arrays nor parts of elements.
                let bytes = if binding.array { binding.stride * elements.max(1) } else { binding.stride };
                let entry = fields.entry(field.to_owned()).or_insert(0);
                *entry = bytes.max(*entry);
            }
            for Indirect { field, word, .. } in kernel.passes.iter().filter_map(|pass| pass.indirect.as_ref()) {
                let entry = fields.entry(field.to_string()).or_insert(0);
                *entry = (4 * kernel.size(field).unwrap_or(u64::from(*word) + 3)).max(*entry);
            }
        }
        fields
    }
}
