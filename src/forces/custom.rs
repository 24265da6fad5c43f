//! A user's own law: a WGSL file that is the equal of ours, with no Rust and no compiler.

use super::{Distant, Force, Law, Over};
use crate::kernel::{Scalar, Source};
use crate::settings::Value;

/// A user's law. It has no twin, so the CPU backend cannot run it and nothing checks it.
pub struct Custom {
    /// Its name in the plan.
    pub name: String,
    /// Who meets whom.
    pub over: Over,
    /// The text of the file; see [`Law::wgsl`] for the functions it must have.
    pub wgsl: String,
    /// The file's name, for messages.
    pub file: String,
    /// The members of its `Params`.
    pub params: Vec<(String, Value)>,
}

impl Force for Custom {
    fn laws(&self) -> Vec<Law> {
        let scalar = |value: &Value| match value {
            Value::Number(x) => Scalar::Float(*x),
            Value::Vector(v) => Scalar::Vector(*v),
            Value::Flag(on) => Scalar::Uint(u32::from(*on)),
            Value::Text(_) => Scalar::Float(f64::NAN),
        };
        vec![Law {
            name: self.name.clone(),
            over: self.over,
            wgsl: Source::theirs(self.file.clone(), self.wgsl.clone()),
            params: self.params.iter().map(|(name, value)| (name.clone(), scalar(value))).collect(),
            twin: None,
            reciprocal: false,
            jacobian: None,
            distant: Distant::default(),
            tied: None,
        }]
    }
}
