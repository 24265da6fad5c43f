//! Who meets whom. A law says what happens; a visit says between whom, and joins the law's WGSL with its own.

mod each;
mod pairs;
mod problem;

pub use problem::Problem;

use glam::{DVec3, DVec4};

use crate::error::Error;
use crate::kernel::{Kernel, POSITION, Scalar, Source, Twin, VELOCITY, World};

/// The visits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Over {
    /// Each particle alone.
    Each,
    /// Everybody meets everybody else.
    Pairs,
}

impl Over {
    /// The scene's words for the visits, in the order of [`Over::from_name`].
    pub const NAMES: &'static [&'static str] = &["each", "pairs"];

    /// The visit of a scene's word.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        match name {
            "each" => Some(Self::Each),
            "pairs" => Some(Self::Pairs),
            _ => None,
        }
    }
}

/// A law: what happens between `me` and `you`, or to `me` alone.
pub struct Law {
    /// Its name, for `motes explain` and messages.
    pub name: String,
    /// Who meets whom.
    pub over: Over,
    /// Its WGSL. Over `each` it has `fn force(me: Particle) -> vec4f`; over `pairs` it has `fn gather` and `fn finish`,
    /// see `shaders/visit/span.wgsl`.
    pub wgsl: Source,
    /// The members of its `Params`, by name.
    pub params: Vec<(String, Scalar)>,
    /// The visit's twin around the law's; `None` only for a user's law.
    pub twin: Option<Twin>,
}

/// A particle as a law's twin sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Body {
    /// Its id.
    pub index: usize,
    /// Where it is.
    pub position: DVec3,
    /// How it moves.
    pub velocity: DVec3,
    /// How heavy it is.
    pub mass: f64,
}

impl Body {
    fn new(index: usize, position: DVec4, velocity: DVec4) -> Self {
        Self { index, position: position.truncate(), velocity: velocity.truncate(), mass: position.w }
    }
}

impl Law {
    /// A law of each particle alone; `rule(me, time)` gives acceleration and potential per unit mass.
    pub fn each(
        name: &str,
        wgsl: Source,
        params: Vec<(String, Scalar)>,
        rule: impl Fn(&Body, f64) -> DVec4 + Send + Sync + 'static,
    ) -> Self {
        Self::each_in(name, wgsl, params, move |me, world| rule(me, world.time))
    }
    /// The same for a law that asks for more than the time: `rule(me, world)` knows the box too.
    pub fn each_in(
        name: &str,
        wgsl: Source,
        params: Vec<(String, Scalar)>,
        rule: impl Fn(&Body, &World) -> DVec4 + Send + Sync + 'static,
    ) -> Self {
        Self { name: name.to_owned(), over: Over::Each, wgsl, params, twin: Some(each::twin(rule)) }
    }
    /// A law of pairs; `rule(me, you, r)`, with r from me to your nearest image, gives what you add to my acceleration and potential
    /// per unit mass.
    pub fn pairs(
        name: &str,
        wgsl: Source,
        params: Vec<(String, Scalar)>,
        rule: impl Fn(&Body, &Body, DVec3) -> DVec4 + Send + Sync + 'static,
    ) -> Self {
        Self { name: name.to_owned(), over: Over::Pairs, wgsl, params, twin: Some(pairs::twin(rule)) }
    }
    /// Joins the law with its visit, for so many particles on such a machine.
    ///
    /// # Errors
    /// [`Error::Shader`] when the WGSL does not compile, [`Error::Scene`] when a parameter is missing or unknown.
    pub fn kernel(self, problem: &Problem) -> Result<Kernel, Error> {
        match self.over {
            Over::Each => each::kernel(self, problem),
            Over::Pairs => pairs::kernel(self, problem),
        }
    }
    fn uniforms(&self, shader: &crate::kernel::Shader) -> Result<Vec<(&'static str, Vec<u8>)>, Error> {
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
    fn requires(&self, functions: &[(&str, &str)]) -> Result<(), Error> {
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
}

impl Over {
    /// The scene's word for it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Each => "each",
            Self::Pairs => "pairs",
        }
    }
}

fn bodies(host: &crate::kernel::Host) -> Result<Vec<Body>, Error> {
    let count = host.world().count as usize;
    let (position, velocity) = (host.read(POSITION)?, host.read(VELOCITY)?);
    Ok((0..count.min(position.len())).map(|i| Body::new(i, position[i], velocity[i])).collect())
}
