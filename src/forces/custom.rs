//! A user's own law: a WGSL file with the same features as built-in laws, without Rust code or compilation.

use std::sync::Arc;

use super::{Change, Component, Law, Over, Properties};
use crate::component::{Largest, Setting};
use crate::error::Error;
use crate::grains;
use crate::kernel::{ACCELERATION, Column, Name, Scalar, Source, Table};
use crate::settings::{Kind, Value, unknown};
use crate::visit::PairTable;

/// A user's law. It has no reference, so the CPU backend cannot run it and it is not verified.
#[derive(Clone)]
pub struct Custom {
    /// Its name in the plan.
    pub name: String,
    /// The visit: which pairs are evaluated.
    pub over: Over,
    /// The text of the file; see [`Law::wgsl`] for the functions it must have.
    pub wgsl: String,
    /// The file's name, for messages.
    pub file: String,
    /// The members of its `Params`.
    pub params: Vec<(String, Value)>,
    /// Parameters of pairs of species.
    pub pairs: Option<PairTable>,
    /// Tables of data, by the names under which the file binds them.
    pub tables: Vec<Table>,
    /// The columns that it writes: see [`Law::into`].
    pub into: Vec<Name>,
    /// Over a list: pairs up to so many bonds apart are left out; 0: none.
    pub exclude: u32,
    /// Whether its particles are grains, as those of `contact`: it declares [their columns](crate::grains::columns), and torques turn them.
    pub grains: bool,
}

impl Custom {
    /// A law of such a text that gives an acceleration and has no parameters.
    #[must_use]
    pub fn new(name: &str, file: &str, wgsl: &str, over: Over) -> Self {
        let (name, wgsl, file) = (name.to_owned(), wgsl.to_owned(), file.to_owned());
        let (params, pairs, tables) = (Vec::new(), None, Vec::new());
        let into = vec![ACCELERATION.name.into()];
        Self { name, over, wgsl, file, params, pairs, tables, into, exclude: 0, grains: false }
    }
}

impl Custom {
    /// The same with another value of one of its parameters.
    fn with_param(&self, name: &str, value: &Value) -> Result<Self, Error> {
        let mut custom = self.clone();
        let Some((_, old)) = custom.params.iter_mut().find(|(known, _)| known == name) else {
            let known = self.params.iter().map(|(name, _)| name.as_str());
            return Err(Error::Scene(format!("the law `{}` {}", self.name, unknown(name, known))));
        };
        if std::mem::discriminant(old) != std::mem::discriminant(value) {
            return Err(Error::Scene(format!(
                "the parameter `{name}` of the law `{}` is {}, and the new value is {}: give it one of its kind",
                self.name,
                old.kind(),
                value.kind()
            )));
        }
        if let Some(why) = value.beyond() {
            return Err(Error::Scene(format!("the parameter `{name}` of the law `{}` {why}", self.name)));
        }
        *old = value.clone();
        Ok(custom)
    }
    /// The same with other contents of one of its tables.
    fn with_table(&self, name: &str, words: &[u32]) -> Result<Self, Error> {
        let mut custom = self.clone();
        let Some((_, old)) = custom.tables.iter_mut().find(|(known, _)| known == name) else {
            let known = self.tables.iter().map(|(name, _)| name.as_ref());
            return Err(Error::Scene(format!("the law `{}` {}", self.name, unknown(name, known))));
        };
        if old.len() != words.len() {
            return Err(Error::Scene(format!(
                "the table `{name}` of the law `{}` has {} words of 4 bytes, and these are {}: give as many, or a new setup the state \
                 of `snapshot()`",
                self.name,
                old.len(),
                words.len()
            )));
        }
        *old = Arc::new(words.to_vec());
        Ok(custom)
    }
}

impl Component for Custom {
    fn name(&self) -> &str {
        &self.name
    }
    fn settings(&self) -> Vec<Setting<'_>> {
        let kind = |value: &Value| match value {
            Value::Vector(_) => Kind::Vector,
            Value::Flag(_) => Kind::Flag,
            _ => Kind::Number,
        };
        let one = |(name, value)| {
            let (kind, about) = (kind(value), "a parameter of the law");
            Setting { table: Some("params"), name, kind, default: None, about, shared: false, value }
        };
        self.params.iter().map(|(name, value)| one((name.as_str(), value))).collect()
    }
    fn changed(&self, name: &str, to: &Change) -> Result<Box<dyn Component>, Error> {
        Ok(Box::new(match to {
            Change::Value(value) => self.with_param(name, value)?,
            Change::Table(words) => self.with_table(name, words)?,
        }))
    }
    fn columns(&self) -> Vec<Column> {
        if self.grains { grains::columns() } else { Vec::new() }
    }
    fn properties(&self) -> Properties {
        let turns = if self.grains { vec!["spins"] } else { Vec::new() };
        let (Over::List { range, .. } | Over::Near { range, .. } | Over::Within { range } | Over::Auto { range, .. }) =
            self.over
        else {
            return Properties { turns, ..Properties::default() };
        };
        let why = "its range is the largest sum of two radii at least";
        let largest = self.grains.then_some(Largest { column: "radius", value: 0.5 * range, why });
        Properties { turns, largest: largest.into_iter().collect(), ..Properties::default() }
    }
    fn laws(&self) -> Vec<Law> {
        let params = self.params.iter().map(|(name, value)| (name.clone(), scalar(value))).collect();
        let law = Law::own(&self.name, self.over, Source::law(self.file.clone(), self.wgsl.clone()), params);
        let (pairs, tables, into) = (self.pairs.clone(), self.tables.clone(), self.into.clone());
        vec![Law { pairs, tables, into, exclude: self.exclude, ..law }]
    }
}

/// A value as a member of a struct takes it.
#[must_use]
pub fn scalar(value: &Value) -> Scalar {
    match value {
        Value::Number(x) => Scalar::Float(*x),
        Value::Vector(v) => Scalar::Vector(*v),
        Value::Flag(on) => Scalar::Uint(u32::from(*on)),
        Value::Text(_) | Value::Pairs(_) => Scalar::Float(f64::NAN),
    }
}
