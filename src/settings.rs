//! Settings of forces and shapes: names, kinds, defaults and units, declared once, next to their component.

mod kind;
mod nearest;
mod number;

use std::borrow::Cow;
use std::collections::BTreeMap;

use glam::DVec3;

pub use kind::{Kind, LARGEST_WHOLE, Outside, is_lost};
pub use nearest::{listed, nearest, unknown};
pub use number::plain;

/// A value of a scene.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// A number.
    Number(f64),
    /// Three numbers.
    Vector(DVec3),
    /// A word.
    Text(Cow<'static, str>),
    /// Yes or no.
    Flag(bool),
    /// Coefficients of pairs of species.
    Pairs(Vec<Pair>),
}

impl Value {
    /// Its kind, in words.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Number(_) => "a number",
            Self::Vector(_) => "three numbers",
            Self::Text(_) => "a text",
            Self::Flag(_) => "true or false",
            Self::Pairs(_) => "a list of pairs of species",
        }
    }
    /// The reason why single precision cannot hold it, if it cannot.
    #[must_use]
    pub fn beyond(&self) -> Option<String> {
        let bad = |x: &f64| Kind::Number.outside(*x).is_some();
        let numbers = match self {
            Self::Number(x) => vec![*x],
            Self::Vector(v) => v.to_array().to_vec(),
            Self::Text(_) | Self::Flag(_) | Self::Pairs(_) => Vec::new(),
        };
        let first = numbers.into_iter().find(bad)?;
        Some(format!(
            "is {first:e}: it must be finite, and of a size that single precision holds (1.2e-38 to 3.4e38, or 0)"
        ))
    }
}

impl From<f64> for Value {
    fn from(x: f64) -> Self {
        Self::Number(x)
    }
}
impl From<u32> for Value {
    fn from(n: u32) -> Self {
        Self::Number(f64::from(n))
    }
}
impl From<DVec3> for Value {
    fn from(v: DVec3) -> Self {
        Self::Vector(v)
    }
}
impl From<bool> for Value {
    fn from(flag: bool) -> Self {
        Self::Flag(flag)
    }
}
impl From<&'static str> for Value {
    fn from(word: &'static str) -> Self {
        Self::Text(Cow::Borrowed(word))
    }
}

/// The coefficients of a pair of species.
#[derive(Debug, Clone, PartialEq)]
pub struct Pair {
    /// The two, in any order.
    pub species: [u32; 2],
    /// The coefficients, by the names of their keys.
    pub values: Vec<(String, f64)>,
}

impl Pair {
    /// A coefficient; 0 where there is none of that name.
    #[must_use]
    pub fn number(&self, name: &str) -> f64 {
        self.values.iter().find(|(known, _)| known == name).map_or(0.0, |(_, x)| *x)
    }
    /// Whether it has a number for every key, and no others.
    fn fits(&self, keys: &[Key]) -> bool {
        let has = |key: &Key| self.values.iter().any(|(name, _)| name == key.name);
        self.values.len() == keys.len() && keys.iter().all(has)
    }
}

/// The names of the sides of a box, in scenes.
pub const SIDES: &[&str] = &["-x", "+x", "-y", "+y", "-z", "+z"];

/// A key: its name in the scene, the accepted values, the default (`None`: it must be given), and its meaning.
#[derive(Debug, Clone, PartialEq)]
pub struct Key {
    /// The name in the scene; for a force also the member of `Params` in its shader.
    pub name: &'static str,
    /// The accepted values.
    pub kind: Kind,
    /// Its value when the scene leaves it out.
    pub default: Option<Value>,
    /// One line: what it means, and its unit.
    pub about: &'static str,
    /// Whether it is one value for a force and for the particles on which it acts: shapes and emitters that leave it out use that of the force.
    pub shared: bool,
    /// What its words change, if anything, in the defaults of other keys.
    pub presets: &'static [Preset],
}

/// A word of a key that changes the defaults of other keys of the same owner; values that are given win.
#[derive(Debug, PartialEq)]
pub struct Preset {
    /// The word.
    pub word: &'static str,
    /// The keys, with their defaults under it.
    pub defaults: &'static [(&'static str, Value)],
}

impl Key {
    /// The same, whose words change the defaults of other keys.
    #[must_use]
    pub const fn with_presets(mut self, presets: &'static [Preset]) -> Self {
        self.presets = presets;
        self
    }
    /// The defaults of other keys under one of its words.
    #[must_use]
    pub fn preset(&self, word: &str) -> &'static [(&'static str, Value)] {
        self.presets.iter().find(|preset| preset.word == word).map_or(&[], |preset| preset.defaults)
    }
    /// The same, as one value for a force and the shapes and emitters of a scene.
    #[must_use]
    pub const fn shared(mut self) -> Self {
        self.shared = true;
        self
    }
    /// A key with a default.
    #[must_use]
    pub const fn new(name: &'static str, kind: Kind, default: Value, about: &'static str) -> Self {
        Self { name, kind, default: Some(default), about, shared: false, presets: &[] }
    }
    /// A key that must be given.
    #[must_use]
    pub const fn required(name: &'static str, kind: Kind, about: &'static str) -> Self {
        Self { name, kind, default: None, about, shared: false, presets: &[] }
    }
}

/// Checked values by name, defaults filled in. Reading an undeclared name is a programming error and returns zero (an empty word, `false`);
/// a test reads every declared key of every entry.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Settings(pub BTreeMap<&'static str, Value>);

impl Settings {
    /// The defaults of some keys; keys that must be given are left out.
    #[must_use]
    pub fn defaults(keys: &[Key]) -> Self {
        Self(keys.iter().filter_map(|k| Some((k.name, k.default.clone()?))).collect())
    }
    /// The same with a word of a key, and what it changes in the defaults of other keys.
    #[must_use]
    pub fn under(self, keys: &[Key], name: &'static str, word: &'static str) -> Self {
        let changed = keys.iter().find(|key| key.name == name).map_or(&[][..], |key| key.preset(word));
        let all = changed.iter().fold(self, |all, (name, value)| all.with(name, value.clone()));
        all.with(name, word.into())
    }
    /// The same with one value set. A name that the force, shape or picture does not have is reported when it is built.
    #[must_use]
    pub fn with(mut self, name: &'static str, value: Value) -> Self {
        self.0.insert(name, value);
        self
    }
    /// The first fault of these settings, given the keys of their owner: an unknown name, a value of another kind or out of its range, or a
    /// missing one.
    #[must_use]
    pub fn fault(&self, keys: &[Key]) -> Option<String> {
        let refused = |(name, value): (&&'static str, &Value)| {
            let key = keys.iter().find(|key| key.name == *name)?;
            let why = key.kind.refuses(value)?;
            Some(format!("has a key `{name}` ({}) that must be {}, and it is {why}", key.about, key.kind.wanted()))
        };
        self.misnamed(keys).or_else(|| self.0.iter().find_map(refused)).or_else(|| {
            let missing = keys.iter().find(|key| key.default.is_none() && !self.0.contains_key(key.name))?;
            Some(format!("requires a value for its key `{}`: {}", missing.name, missing.about))
        })
    }
    /// The same for names and kinds only, for an owner that checks ranges itself.
    #[must_use]
    pub fn misnamed(&self, keys: &[Key]) -> Option<String> {
        self.0.iter().find_map(|(name, value)| {
            let Some(key) = keys.iter().find(|key| key.name == *name) else {
                return Some(unknown(name, keys.iter().map(|key| key.name)));
            };
            (!key.kind.takes(value))
                .then(|| format!("has a key `{name}` of another kind than {value:?}: {}", key.about))
        })
    }
    /// A number.
    #[must_use]
    pub fn number(&self, name: &str) -> f64 {
        match self.0.get(name) {
            Some(Value::Number(x)) => *x,
            _ => 0.0,
        }
    }
    /// A number of a kind that accepts only integers.
    #[must_use]
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "Kind::Count and Kind::Whole are whole and not negative"
    )]
    pub fn whole(&self, name: &str) -> u64 {
        self.number(name) as u64
    }
    /// A species; `None`: all.
    #[must_use]
    pub fn species(&self, name: &str) -> Option<u32> {
        match self.0.get(name) {
            Some(Value::Number(_)) => u32::try_from(self.whole(name)).ok(),
            _ => None,
        }
    }
    /// Three numbers.
    #[must_use]
    pub fn vector(&self, name: &str) -> DVec3 {
        match self.0.get(name) {
            Some(Value::Vector(v)) => *v,
            _ => DVec3::ZERO,
        }
    }
    /// A word.
    #[must_use]
    pub fn text(&self, name: &str) -> &str {
        match self.0.get(name) {
            Some(Value::Text(t)) => t,
            _ => "",
        }
    }
    /// Coefficients of pairs of species.
    #[must_use]
    pub fn pairs(&self, name: &str) -> &[Pair] {
        match self.0.get(name) {
            Some(Value::Pairs(rows)) => rows,
            _ => &[],
        }
    }
    /// Yes or no.
    #[must_use]
    pub fn flag(&self, name: &str) -> bool {
        matches!(self.0.get(name), Some(Value::Flag(true)))
    }
}
