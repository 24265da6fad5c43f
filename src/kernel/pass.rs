//! Dispatches.

use std::sync::Arc;

use super::{Binding, Name, Shader};
use crate::error::Error;

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

/// Where the workgroups of a dispatch stand: three words of a field, from one of them on.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Indirect {
    /// The field. Its name holds a space, so that no user's shader can bind it: a device may not check what it reads there.
    pub field: Name,
    /// The first of the three words.
    pub word: u32,
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
    /// Where the number of its workgroups stands, if it is known only on the device. Without work it costs next to nothing
    /// then.
    pub indirect: Option<Indirect>,
    /// About how much it does: evaluations of a pair, or one per particle. Submissions are cut by it.
    pub work: u64,
}

impl Pass {
    /// A dispatch of one layer.
    #[must_use]
    pub fn new(shader: Arc<Shader>, count: u32) -> Self {
        let (constants, uniforms, fields) = (Vec::new(), Vec::new(), Vec::new());
        let (threads, work) = (Threads::new(count), u64::from(count));
        Self { shader, constants, uniforms, fields, threads, indirect: None, work }
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
