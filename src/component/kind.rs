//! Kinds of particles, by which forces distinguish them.

use std::borrow::Cow;

use crate::kernel::Scalar;
use crate::settings::{self, Key, Settings, Value};
use crate::visit::Particle;

/// One species, or all.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Kind(pub Option<u32>);

/// The species on which a force acts, where it may act on all.
pub const SPECIES: Key = Key::new(
    "species",
    settings::Kind::Species,
    Value::Text(Cow::Borrowed("all")),
    "the species that it acts on, or \"all\"",
);

impl Kind {
    /// Whether a particle is of this species.
    pub fn has(self, body: &Particle) -> bool {
        self.is(body.species())
    }
    /// Whether a species is this one.
    pub fn is(self, species: u32) -> bool {
        self.0.is_none_or(|own| own == species)
    }
    /// Its value in shaders: see `shaders/law/species.wgsl`.
    pub fn scalar(self) -> Scalar {
        Scalar::Uint(self.0.unwrap_or(u32::MAX))
    }
}

/// The value of a key of [`settings::Kind::Species`], and the same for a shader.
pub fn species(settings: &Settings, name: &str) -> (Kind, Scalar) {
    let kind = Kind(settings.species(name));
    (kind, kind.scalar())
}
