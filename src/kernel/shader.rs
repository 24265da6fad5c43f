//! Shaders: plain WGSL files joined by the host. The order of declarations at module scope is free in WGSL.

mod joined;

use std::borrow::Cow;
use std::sync::Arc;

use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};

use super::reflect::Reflection;
use super::unused_word::{with_unused_word, written};
use super::{Binding, Pass, Scalar, message, own};
use crate::error::Error;

/// One file of WGSL.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Source {
    /// Its name in messages.
    pub file: Cow<'static, str>,
    /// Its text.
    pub text: Cow<'static, str>,
    /// Whether it is part of this crate. A user's file runs with all run-time checks.
    pub ours: bool,
    /// Whether it is a user's law, which is validated by `own`.
    pub law: bool,
}

impl Source {
    /// A file of this crate; use [`shader!`](crate::shader).
    #[must_use]
    pub const fn ours(file: &'static str, text: &'static str) -> Self {
        Self { file: Cow::Borrowed(file), text: Cow::Borrowed(text), ours: true, law: false }
    }
    /// A user's file.
    #[must_use]
    pub fn theirs(file: String, text: String) -> Self {
        Self { file: Cow::Owned(file), text: Cow::Owned(text), ours: false, law: false }
    }
    /// A user's law.
    #[must_use]
    pub fn law(file: String, text: String) -> Self {
        Self { law: true, ..Self::theirs(file, text) }
    }
    /// The names, numbers and marks of the text, comments left out.
    #[must_use]
    pub fn words(&self) -> Vec<&str> {
        own::tokens(&self.text).into_iter().map(|token| token.text).collect()
    }
    /// The fault of a function of this file, if there is one of that name that differs from `signature`: a message with the position.
    #[must_use]
    pub fn mismatch(&self, signature: &str) -> Option<String> {
        own::mismatch(self, signature)
    }
    /// Whether it has loops.
    #[must_use]
    pub fn has_loops(&self) -> bool {
        own::has_loops(&self.text)
    }
    /// The text that is compiled: in a user's file, `params` begins with an unused word.
    #[must_use]
    pub(super) fn compiled(&self) -> Cow<'_, str> {
        if self.ours { Cow::Borrowed(&self.text) } else { with_unused_word(&self.text) }
    }
    /// The position in the file that corresponds to a position in the compiled text.
    #[must_use]
    pub(super) fn written(&self, compiled: usize) -> usize {
        if self.ours { compiled } else { written(&self.text, compiled) }
    }
    /// The same file, in which a name is another.
    #[must_use]
    pub fn renamed(&self, from: &str, to: &str) -> Self {
        let (mut text, mut end) = (String::new(), 0);
        for token in own::tokens(&self.text).into_iter().filter(|token| token.text == from) {
            text.push_str(&self.text[end..token.at]);
            text.push_str(to);
            end = token.end();
        }
        text.push_str(&self.text[end..]);
        Self { text: Cow::Owned(text), ..self.clone() }
    }
    /// Whether it defines a function of that name.
    #[must_use]
    pub fn defines(&self, function: &str) -> bool {
        self.says(&["fn", function, "("])
    }
    /// Whether it calls a function of that name and does not define it, so that it is to be joined with a file that does.
    #[must_use]
    pub fn needs(&self, function: &str) -> bool {
        self.says(&[function, "("]) && !self.defines(function)
    }
    /// Whether it declares a struct of that name.
    #[must_use]
    pub fn declares(&self, name: &str) -> bool {
        self.says(&["struct", name, "{"])
    }
    /// Whether it has entry points, of any stage.
    #[must_use]
    pub fn has_entry_points(&self) -> bool {
        ["compute", "vertex", "fragment"].into_iter().any(|stage| self.says(&["@", stage]))
    }
    /// Whether the text, comments left out, contains these words in this order with only white space between.
    fn says(&self, words: &[&str]) -> bool {
        let tokens = own::tokens(&self.text);
        tokens.windows(words.len()).any(|w| w.iter().map(|token| token.text).eq(words.iter().copied()))
    }
}

/// The source of a shader of this crate, by its path under `shaders/`.
#[doc(hidden)]
#[macro_export]
macro_rules! shader {
    ($path:literal) => {
        $crate::kernel::Source::ours(
            concat!("shaders/", $path),
            include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/shaders/", $path)),
        )
    };
}

/// Joined WGSL, parsed and validated.
struct Joined {
    text: String,
    module: naga::Module,
    info: ModuleInfo,
}

impl Joined {
    fn of(sources: &[Source]) -> Result<Self, Error> {
        let mut text = String::new();
        for source in sources {
            text.push_str(&source.compiled());
            text.push('\n');
        }
        let module = naga::front::wgsl::parse_str(&text).map_err(|e| message::parse(sources, &e))?;
        let info = Validator::new(ValidationFlags::all(), Capabilities::all())
            .validate(&module)
            .map_err(|e| message::validation(sources, &e))?;
        Ok(Self { text, module, info })
    }
}

/// Joined WGSL with its reflection.
#[derive(Debug)]
pub struct Shader {
    sources: Vec<Source>,
    text: String,
    module: naga::Module,
    reflection: Reflection,
    written: Vec<String>,
}

impl Shader {
    /// Joins, parses and validates files; a result that is still in use is shared.
    ///
    /// # Errors
    /// [`Error::Shader`] with file, line and caret of naga's message.
    pub fn join(sources: &[Source]) -> Result<Arc<Self>, Error> {
        joined::once(sources, || Self::joined(sources))
    }
    fn joined(sources: &[Source]) -> Result<Arc<Self>, Error> {
        own::depth(sources)?;
        let given = sources;
        let sources = &own::hoisted(given);
        let mut joined = Joined::of(sources)?;
        let mut written = Vec::new();
        if sources.iter().any(|source| source.law) {
            let Joined { module, info, .. } = &joined;
            let own = own::Joined { module, info, sources };
            own.check()?;
            written = own.written();
            let watched = own::watched_sources(sources);
            if watched != *sources {
                joined = Joined::of(&watched)?;
            }
        }
        let Joined { text, module, info } = joined;
        let reflection = Reflection::of(&module, &info);
        Ok(Arc::new(Self { sources: given.to_vec(), text, module, reflection, written }))
    }
    /// A shader that runs those of several passes one after another, of a module that was made from theirs; `None` where that is not valid.
    pub(super) fn merged(passes: &[&Pass], text: String, module: naga::Module) -> Option<Self> {
        let info = Validator::new(ValidationFlags::all(), Capabilities::all()).validate(&module).ok()?;
        let reflection = Reflection::of(&module, &info);
        let (mut sources, mut written): (Vec<Source>, Vec<String>) = (Vec::new(), Vec::new());
        for shader in passes.iter().map(|pass| &pass.shader) {
            for source in &shader.sources {
                if !sources.contains(source) {
                    sources.push(source.clone());
                }
            }
            written.extend(shader.written.iter().cloned());
        }
        Some(Self { sources, text, module, reflection, written })
    }
    /// The files.
    #[must_use]
    pub fn sources(&self) -> &[Source] {
        &self.sources
    }
    /// The storage that a user's law writes, by name.
    #[must_use]
    pub fn written(&self) -> &[String] {
        &self.written
    }
    /// The words of the history of pairs that a user's law names.
    #[must_use]
    pub(crate) fn words(&self) -> own::Words {
        own::words(&self.module)
    }
    /// The joined text.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }
    /// The parsed text.
    #[must_use]
    pub fn module(&self) -> &naga::Module {
        &self.module
    }
    /// Its bindings and sizes.
    #[must_use]
    pub fn reflection(&self) -> &Reflection {
        &self.reflection
    }
    /// The contents of a uniform block, where the shader has it.
    ///
    /// # Errors
    /// [`Error::Scene`] when the block has other members.
    pub fn block(
        &self,
        whose: &str,
        name: &'static str,
        values: &[(&'static str, Scalar)],
    ) -> Result<Vec<(&'static str, Vec<u8>)>, Error> {
        let bytes = |binding: &Binding| Ok((name, binding.packed.pack(whose, values)?));
        self.reflection.binding(name).map(bytes).into_iter().collect()
    }
    /// Whether all of its files are part of this crate.
    #[must_use]
    pub fn trusted(&self) -> bool {
        self.sources.iter().all(|s| s.ours)
    }
}
