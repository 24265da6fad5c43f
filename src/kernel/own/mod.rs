//! Validation of a user's law before it is compiled by a driver: it is untrusted text, and drivers do not protect themselves against it.

#[cfg(feature = "panel")]
mod called;
mod claims;
mod depth;
mod directives;
mod limits;
mod loops;
mod reach;
mod signature;
mod tokens;
mod words;

use naga::valid::ModuleInfo;
use naga::{Function, Handle, Module, Span};

use super::message;
use super::shader::Source;
use crate::error::Error;

#[cfg(feature = "panel")]
pub use called::over;
pub use claims::check as claims;
pub use depth::check as depth;
pub use directives::hoisted;
pub use loops::{has_loops, watched_sources};
pub use signature::mismatch;
pub use tokens::tokens;
pub use words::{Words, words};

/// Joined sources, some of them a user's, as parsed by naga.
pub struct Joined<'a> {
    pub module: &'a Module,
    pub info: &'a ModuleInfo,
    pub sources: &'a [Source],
}

impl Joined<'_> {
    /// Refuses laws that exceed the limits or do what a law must not do.
    ///
    /// # Errors
    /// [`Error::Shader`] with the position in the user's file.
    pub fn check(&self) -> Result<(), Error> {
        directives::check(self.sources)?;
        reach::check(self)?;
        limits::check(self)
    }
    /// The storage that the law writes, by name.
    pub fn written(&self) -> Vec<String> {
        reach::written(self)
    }
    /// Whether a span is in a user's law.
    fn is_law(&self, span: Span) -> bool {
        span.to_range()
            .and_then(|range| message::place(self.sources, range.start))
            .is_some_and(|(source, _)| source.law)
    }
    /// The functions of the law.
    fn functions(&self) -> impl Iterator<Item = (Handle<Function>, &Function)> {
        let functions = &self.module.functions;
        functions.iter().filter(|(handle, _)| self.is_law(functions.get_span(*handle)))
    }
    fn fault(&self, message: &str, span: Span, label: &str) -> Error {
        Error::Shader { message: message::with_place(message, self.sources, span, label) }
    }
}
