//! Dispatches.

use std::sync::Arc;

use super::{Binding, Name, Shader};
use crate::error::Error;

/// The number of invocations of a pass: `count` in the plane, times `layers`.
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

/// The location of the workgroup counts of an indirect dispatch: three consecutive words of a field.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Indirect {
    /// The field. Its name contains a space, so that no user's shader can bind it: a device may not validate the counts that it reads.
    pub field: Name,
    /// The first of the three words.
    pub word: u32,
    /// Whether the words are zero whenever the kernel is complete, so that the dispatch may be part of a loop: iterations that are not needed
    /// dispatch nothing then.
    pub rests: bool,
}

/// One dispatch.
#[derive(Debug, Clone)]
pub struct Pass {
    /// The shader.
    pub shader: Arc<Shader>,
    /// Values of its `override`s.
    pub constants: Vec<(&'static str, f64)>,
    /// Contents of its uniform blocks other than `world`, by name.
    pub uniforms: Vec<(&'static str, Vec<u8>)>,
    /// Names in the shader that stand for another field: the name there, and the field. One shader may so serve many
    /// fields: a scan scans whatever it is given.
    pub fields: Vec<(Name, Name)>,
    /// The number of invocations.
    pub threads: Threads,
    /// The location of its workgroup counts, if these are known only on the device. A dispatch without workgroups costs next to nothing.
    pub indirect: Option<Indirect>,
    /// An estimate of its work: evaluations of a pair, or one per particle. Submissions are divided by it.
    pub work: u64,
    /// Whether an invocation treats one particle alone: whatever it writes, it reads and writes only the elements of its own index there. Such
    /// dispatches can be fused, see [`Plan::fused`](super::Plan::fused).
    pub alone: bool,
}

impl Pass {
    /// A dispatch of one layer.
    #[must_use]
    pub fn new(shader: Arc<Shader>, count: u32) -> Self {
        let (constants, uniforms, fields) = (Vec::new(), Vec::new(), Vec::new());
        let (threads, work) = (Threads::new(count), u64::from(count));
        Self { shader, constants, uniforms, fields, threads, indirect: None, work, alone: false }
    }
    /// The same with fields bound to names of the shader.
    #[must_use]
    pub fn on(mut self, fields: &[(&'static str, Name)]) -> Self {
        self.fields.extend(fields.iter().map(|(inside, field)| (Name::from(*inside), field.clone())));
        self
    }
    /// The field that a name of the shader is bound to.
    #[must_use]
    pub fn field<'a>(&'a self, name: &'a str) -> &'a str {
        self.fields.iter().find(|(inside, _)| *inside == name).map_or(name, |(_, field)| field)
    }
    /// Its workgroups, folded over two dimensions where one does not suffice.
    ///
    /// # Errors
    /// [`Error::Limit`] when a device dispatches `limit` in one dimension, and that does not suffice.
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
    /// Its bindings, with the field bound to each.
    pub fn bindings(&self) -> impl Iterator<Item = (&str, &Binding)> {
        self.shader.reflection().bindings.iter().map(|binding| (self.field(&binding.name), binding))
    }
}
