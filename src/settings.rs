//! What a scene may say to a force or a shape: names, kinds, defaults and units, declared once, next to the thing itself.

use std::borrow::Cow;
use std::collections::BTreeMap;

use glam::DVec3;

/// One value out of a scene.
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
    /// Whether it has a number for every key, and nothing else.
    fn fits(&self, keys: &[Key]) -> bool {
        let has = |key: &Key| self.values.iter().any(|(name, _)| name == key.name);
        self.values.len() == keys.len() && keys.iter().all(has)
    }
}

/// What values a key accepts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kind {
    /// Any finite number.
    Number,
    /// A finite number above zero.
    Positive,
    /// A finite number, zero or above.
    NotNegative,
    /// A number above zero, one at most.
    Fraction,
    /// A whole number, one or above, that fits 32 bits.
    Count,
    /// A whole number, zero or above, that fits 53 bits (a seed).
    Whole,
    /// A species: a whole number below 2³² − 1, or the word `all`.
    Species,
    /// Three finite numbers.
    Vector,
    /// Three finite numbers, not all zero: a direction.
    Direction,
    /// One of these words.
    Choice(&'static [&'static str]),
    /// Yes or no.
    Flag,
    /// The name of a motion of the scene, or an empty text: none.
    Motion,
    /// The name of a file of the scene, or an empty text: none. A shape gets what is in it.
    File,
    /// Some of [`SIDES`], with blanks between them, or an empty text: none.
    Sides,
    /// A colour by name or as "#ffcc88", or an empty text: none.
    Color,
    /// Coefficients of each pair of species, by these keys, as in `[{ species = [0, 1], epsilon = 1.0 }, …]`. Every pair of species that
    /// particles have is given once, in any order.
    Pairs(&'static [Key]),
}

impl Kind {
    /// Whether a value is of the sort that it accepts, whatever its range.
    fn takes(self, value: &Value) -> bool {
        match self {
            Self::Number | Self::Positive | Self::NotNegative | Self::Fraction | Self::Count | Self::Whole => {
                matches!(value, Value::Number(_))
            }
            Self::Species => matches!(value, Value::Number(_) | Value::Text(_)),
            Self::Vector | Self::Direction => matches!(value, Value::Vector(_)),
            Self::Choice(_) | Self::Motion | Self::File | Self::Sides | Self::Color => matches!(value, Value::Text(_)),
            Self::Flag => matches!(value, Value::Flag(_)),
            Self::Pairs(keys) => matches!(value, Value::Pairs(rows) if rows.iter().all(|row| row.fits(keys))),
        }
    }
}

/// The sides of a box, as scenes call them.
pub const SIDES: &[&str] = &["-x", "+x", "-y", "+y", "-z", "+z"];

/// A key: its name in the scene, what it accepts, what it is when left out (`None`: it must be given), and what it means.
#[derive(Debug, Clone, PartialEq)]
pub struct Key {
    /// The name in the scene; for a force also the member of `Params` in its shader.
    pub name: &'static str,
    /// What it accepts.
    pub kind: Kind,
    /// Its value when the scene leaves it out.
    pub default: Option<Value>,
    /// One line: what it means, and its unit.
    pub about: &'static str,
    /// Whether it says something of a scene's fluid: the force says it for shapes and emitters that leave it out.
    pub of_fluid: bool,
}

impl Key {
    /// The same, of the scene's fluid.
    #[must_use]
    pub const fn of_fluid(mut self) -> Self {
        self.of_fluid = true;
        self
    }
    /// A key with a default.
    #[must_use]
    pub const fn new(name: &'static str, kind: Kind, default: Value, about: &'static str) -> Self {
        Self { name, kind, default: Some(default), about, of_fluid: false }
    }
    /// A key that must be given.
    #[must_use]
    pub const fn required(name: &'static str, kind: Kind, about: &'static str) -> Self {
        Self { name, kind, default: None, about, of_fluid: false }
    }
}

/// Checked values by name, defaults filled in. Reading a name that was never declared is a bug of the reader and
/// gives a zero (an empty word, `false`); a test reads every declared key of every entry.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Settings(pub BTreeMap<&'static str, Value>);

impl Settings {
    /// The defaults of some keys; keys that must be given are left out.
    #[must_use]
    pub fn defaults(keys: &[Key]) -> Self {
        Self(keys.iter().filter_map(|k| Some((k.name, k.default.clone()?))).collect())
    }
    /// The same with one value set. A name that the force, shape or picture does not have is an error where that is built.
    #[must_use]
    pub fn with(mut self, name: &'static str, value: Value) -> Self {
        self.0.insert(name, value);
        self
    }
    /// What is wrong with these, for the owner of such keys: a name that is none of them, or a value of another kind.
    #[must_use]
    pub fn fault(&self, keys: &[Key]) -> Option<String> {
        self.0.iter().find_map(|(name, value)| {
            let Some(key) = keys.iter().find(|key| key.name == *name) else {
                let known: Vec<_> = keys.iter().map(|key| key.name).collect();
                return Some(format!("has no key `{name}`; its keys are {}", known.join(", ")));
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
    /// A number that its kind promises to be whole.
    #[must_use]
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "Kind::Count and Kind::Whole are whole and not negative"
    )]
    pub fn whole(&self, name: &str) -> u64 {
        self.number(name) as u64
    }
    /// A species; `None` stands for all.
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
