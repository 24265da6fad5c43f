//! The result of a law for a particle, in its reference: an acceleration, and values of columns.

use glam::DVec4;

use super::Search;
use crate::error::Error;
use crate::kernel::{ACCELERATION, Array, Host, Name};

/// One value of a column.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Cell {
    /// Of a scalar.
    Scalar(f64),
    /// Of a vector, whose fourth number is 0, or of a quaternion.
    Vector(DVec4),
    /// Of integers.
    Whole(u32),
}

impl From<f64> for Cell {
    fn from(x: f64) -> Self {
        Self::Scalar(x)
    }
}
impl From<DVec4> for Cell {
    fn from(v: DVec4) -> Self {
        Self::Vector(v)
    }
}
impl From<glam::DVec3> for Cell {
    fn from(v: glam::DVec3) -> Self {
        Self::Vector(v.extend(0.0))
    }
}
impl From<u32> for Cell {
    fn from(n: u32) -> Self {
        Self::Whole(n)
    }
}

/// The way in which a value is stored.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Change {
    Set(Cell),
    Add(Cell),
}

/// The result of a law for one particle.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Outcome {
    acceleration: Option<DVec4>,
    changes: Vec<(Name, Change)>,
}

impl Outcome {
    /// Adds to the acceleration: `xyz` \[length / time²\], `w` the potential energy per unit mass \[length² / time²\].
    pub fn accelerate(&mut self, a: DVec4) {
        *self.acceleration.get_or_insert(DVec4::ZERO) += a;
    }
    /// Sets a column of the particle.
    pub fn set(&mut self, column: impl Into<Name>, value: impl Into<Cell>) {
        self.changes.push((column.into(), Change::Set(value.into())));
    }
    /// Adds to a column of the particle.
    pub fn add(&mut self, column: impl Into<Name>, value: impl Into<Cell>) {
        self.changes.push((column.into(), Change::Add(value.into())));
    }
    /// The outcome of a law that computes only an acceleration.
    #[must_use]
    pub fn of_acceleration(a: DVec4) -> Self {
        Self { acceleration: Some(a), changes: Vec::new() }
    }
}

/// Stores outcomes, by index. Of a potential energy each particle gets its share. Fields of a search are written at the particle's
/// place in them.
pub(super) fn write(
    host: &Host,
    share: f64,
    search: Option<&Search>,
    outcomes: impl IntoIterator<Item = (usize, Outcome)>,
) -> Result<(), Error> {
    // Each column is opened once, when it is first named.
    let mut columns: Vec<(Name, Array)> = Vec::new();
    let slots = search.map_or(Ok(Vec::new()), |search| search.places(host))?;
    let mut acceleration = None;
    for (index, outcome) in outcomes {
        if let Some(a) = outcome.acceleration {
            if acceleration.is_none() {
                acceleration = Some(host.write(ACCELERATION)?);
            }
            if let Some(all) = &mut acceleration {
                all[index] += a * DVec4::new(1.0, 1.0, 1.0, share);
            }
        }
        for (name, change) in outcome.changes {
            let own = search.and_then(|search| search.field(&name));
            // A particle outside the cell list has no slot.
            let slot = if own.is_some() { slots.get(index).copied().flatten() } else { Some(index) };
            let (Some(index), name) = (slot, own.unwrap_or(name)) else { continue };
            let place = columns.iter().position(|(known, _)| *known == name);
            let place = if let Some(place) = place {
                place
            } else {
                let array = host.get(&name).ok_or_else(|| missing(&name))?;
                columns.push((name.clone(), array));
                columns.len() - 1
            };
            change.apply(&mut columns[place].1, index).ok_or_else(|| missing(&name))?;
        }
    }
    columns.into_iter().try_for_each(|(name, array)| host.replace(&name, array))
}

fn missing(name: &str) -> Error {
    Error::Device(format!("the reference of a law writes the column `{name}`, which has no such values on the host"))
}

impl Change {
    fn apply(self, array: &mut Array, index: usize) -> Option<()> {
        match (self, array) {
            (Self::Set(Cell::Scalar(x)), Array::Float(all)) => *all.get_mut(index)? = x,
            (Self::Add(Cell::Scalar(x)), Array::Float(all)) => *all.get_mut(index)? += x,
            (Self::Set(Cell::Vector(v)), Array::Vec4(all)) => *all.get_mut(index)? = v,
            (Self::Add(Cell::Vector(v)), Array::Vec4(all)) => *all.get_mut(index)? += v,
            // Of a struct of four numbers.
            (Self::Set(Cell::Vector(v)), Array::Float(all)) => {
                all.get_mut(4 * index..4 * (index + 1))?.copy_from_slice(&v.to_array());
            }
            (Self::Set(Cell::Whole(n)), Array::Uint(all)) => *all.get_mut(index)? = n,
            (Self::Add(Cell::Whole(n)), Array::Uint(all)) => {
                let old = all.get_mut(index)?;
                *old = old.wrapping_add(n);
            }
            _ => return None,
        }
        Some(())
    }
}
