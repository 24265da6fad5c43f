//! Shaders: plain WGSL files joined by the host. Module scope in WGSL does not care about order.

use std::borrow::Cow;
use std::sync::Arc;

use naga::valid::{Capabilities, ValidationFlags, Validator};

use super::message;
use super::reflect::Reflection;
use super::unused_word::{with_unused_word, written};
use crate::error::Error;

/// One file of WGSL.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Source {
    /// The name that messages give.
    pub file: Cow<'static, str>,
    /// What is in it.
    pub text: Cow<'static, str>,
    /// Whether it comes with this crate. A user's file runs with every check switched on.
    pub ours: bool,
}

impl Source {
    /// A file of this crate; use [`shader!`](crate::shader).
    #[must_use]
    pub const fn ours(file: &'static str, text: &'static str) -> Self {
        Self { file: Cow::Borrowed(file), text: Cow::Borrowed(text), ours: true }
    }
    /// A user's file.
    #[must_use]
    pub fn theirs(file: String, text: String) -> Self {
        Self { file: Cow::Owned(file), text: Cow::Owned(text), ours: false }
    }
    /// The text that is compiled: in a user's file `params` begins with a word that nothing reads.
    #[must_use]
    pub(super) fn compiled(&self) -> Cow<'_, str> {
        if self.ours { Cow::Borrowed(&self.text) } else { with_unused_word(&self.text) }
    }
    /// The place in the file that a place in the compiled text stands for.
    #[must_use]
    pub(super) fn written(&self, compiled: usize) -> usize {
        if self.ours { compiled } else { written(&self.text, compiled) }
    }
    /// Whether the text, comments left out, contains these words in this order with only white space between.
    #[must_use]
    pub fn says(&self, words: &[&str]) -> bool {
        let plain: String = self.text.lines().filter_map(|l| l.split("//").next()).collect::<Vec<_>>().join("\n");
        let separate = |c: char| {
            if c.is_alphanumeric() || c == '_' { c.to_string() } else { format!(" {c} ") }
        };
        let spaced: String = plain.chars().map(separate).collect();
        let tokens: Vec<&str> = spaced.split_whitespace().collect();
        tokens.windows(words.len()).any(|w| w == words)
    }
}

/// The source of a shader of this crate, by its path under `shaders/`.
#[macro_export]
macro_rules! shader {
    ($path:literal) => {
        $crate::kernel::Source::ours(
            concat!("shaders/", $path),
            include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/shaders/", $path)),
        )
    };
}

/// Joined WGSL with what naga says of it.
#[derive(Debug)]
pub struct Shader {
    sources: Vec<Source>,
    text: String,
    reflection: Reflection,
}

impl Shader {
    /// Joins files, parses and validates them.
    ///
    /// # Errors
    /// [`Error::Shader`] with file, line and caret of naga's complaint.
    pub fn join(sources: &[Source]) -> Result<Arc<Self>, Error> {
        let mut text = String::new();
        for source in sources {
            text.push_str(&source.compiled());
            text.push('\n');
        }
        let module = naga::front::wgsl::parse_str(&text).map_err(|e| message::parse(sources, &e))?;
        let info = Validator::new(ValidationFlags::all(), Capabilities::all())
            .validate(&module)
            .map_err(|e| message::validation(sources, &e))?;
        let reflection = Reflection::of(&module, &info);
        Ok(Arc::new(Self { sources: sources.to_vec(), text, reflection }))
    }
    /// The files.
    #[must_use]
    pub fn sources(&self) -> &[Source] {
        &self.sources
    }
    /// The joined text.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }
    /// What is bound, and how large things are.
    #[must_use]
    pub fn reflection(&self) -> &Reflection {
        &self.reflection
    }
    /// Whether all of it comes with this crate.
    #[must_use]
    pub fn trusted(&self) -> bool {
        self.sources.iter().all(|s| s.ours)
    }
}
