//! Fields that a caller may read and write, by the type of their elements.

use std::collections::{BTreeMap, BTreeSet};
use std::mem::discriminant;

use super::Plans;
use crate::error::Error;
use crate::kernel::{Access, Array, Kernel};
use crate::settings::nearest;

/// A field: the kind of its elements, as each shader declares it, and its size in bytes.
#[derive(Debug, Clone, PartialEq)]
struct Known {
    kinds: Vec<Array>,
    bytes: u64,
}

/// The fields of plans, by name.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Fields(BTreeMap<String, Known>);

impl Fields {
    /// The fields of plans for `rows` rows.
    pub fn of(plans: &Plans, rows: u32) -> Self {
        let mut all: BTreeMap<String, Known> = BTreeMap::new();
        for plan in plans.all() {
            for (name, bytes) in plan.fields(rows) {
                let known = all.entry(name).or_insert(Known { kinds: Vec::new(), bytes });
                known.bytes = known.bytes.max(bytes);
            }
            let bindings = plan.kernels.iter().flat_map(Kernel::bindings);
            for (name, binding) in bindings.filter(|(_, binding)| binding.access != Access::Uniform) {
                let Some(known) = all.get_mut(name) else { continue };
                let kind = binding.zeros(1).zeros(0);
                if !known.kinds.contains(&kind) {
                    known.kinds.push(kind);
                }
            }
        }
        Self(all)
    }
    /// The number of elements of a field, counted in elements of the kind of `like`.
    ///
    /// # Errors
    /// [`Error::Scene`] when there is no such field, or its elements are of another kind.
    pub fn len(&self, name: &str, like: &Array) -> Result<usize, Error> {
        let Some(known) = self.0.get(name) else {
            let shown = self.0.keys().map(String::as_str).filter(|name| !name.contains(' '));
            let meant = nearest(name, shown).map(|near| format!("did you mean `{near}`?"));
            let text = meant.unwrap_or_else(|| "no kernel of this simulation names one".to_owned());
            return Err(Error::Scene(format!("there is no field `{name}`: {text}")));
        };
        if !known.kinds.iter().any(|kind| discriminant(kind) == discriminant(like)) {
            let has = known.kinds.first().map_or("no elements", element);
            return Err(Error::Scene(format!(
                "the field `{name}` has elements of {has}, and {} is requested: use a Field of the other type",
                element(like)
            )));
        }
        let each = like.zeros(1).to_bytes().len() as u64;
        Ok(usize::try_from(known.bytes / each).unwrap_or(usize::MAX))
    }
    /// The names of fields that differ from those of `others`, except these.
    pub fn differ<'a>(&'a self, others: &'a Self, but: &BTreeSet<String>) -> Vec<&'a str> {
        let all = self.0.keys().chain(others.0.keys()).filter(|name| !but.contains(*name));
        all.filter(|name| self.0.get(*name) != others.0.get(*name)).map(String::as_str).collect()
    }
    /// Whether a field has room for such values from one of its elements on.
    ///
    /// # Errors
    /// As [`Fields::len`], and [`Error::Scene`] with both numbers when it is too short.
    pub fn hold(&self, name: &str, values: &Array, first: usize) -> Result<(), Error> {
        let (have, end) = (self.len(name, values)?, first.saturating_add(values.len()));
        if end > have {
            return Err(Error::Scene(format!(
                "the field `{name}` has {have} elements, and these go to {end}: write fewer, or earlier ones"
            )));
        }
        Ok(())
    }
}

fn element(array: &Array) -> &'static str {
    match array {
        Array::Vec4(_) | Array::Vec3(_) => "vec4f",
        Array::Float(_) => "f32",
        Array::Uint(_) => "u32",
    }
}
