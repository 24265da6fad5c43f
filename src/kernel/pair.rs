//! Columns that integrators advance in addition to positions and velocities: a column and its rate.

use super::Name;
use super::column::{Advance, Column, Kind, Role, Shape};
use super::columns::Columns;
use crate::error::Error;

/// A column and its rate.
#[derive(Debug, Clone, PartialEq)]
pub struct Pair {
    /// The column that is advanced.
    pub column: Column,
    /// Its rate of change.
    pub rate: Column,
    /// When, and how, it is advanced.
    pub way: Way,
}

/// When a column is advanced, and how.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Way {
    /// With velocities: evaluations compute the rate.
    Kick,
    /// With positions: the rate is a state.
    Drift,
    /// With positions: the rate is computed in the middle of each drift.
    Carried,
    /// With positions: an orientation that turns, of a body with these moments of inertia. The angular velocity turns too.
    Rotation {
        /// The column of the principal moments of inertia.
        inertia: Name,
    },
    /// With velocities: the angular velocity of a body, by a torque.
    Torque {
        /// The column of the orientation.
        orientation: Name,
        /// The column of the principal moments of inertia.
        inertia: Name,
    },
}

impl Pair {
    fn of(column: &Column, columns: &Columns) -> Option<Self> {
        let rate = columns.get(column.rate.as_ref()?)?;
        let body = columns.iter().find_map(|other| match &other.advance {
            Advance::Rotation { inertia } if other.rate.as_ref() == Some(&column.name) => Some((other, inertia)),
            _ => None,
        });
        let way = match (&column.advance, body) {
            (Advance::Rotation { inertia }, _) => Way::Rotation { inertia: inertia.clone() },
            (_, Some((body, inertia))) => Way::Torque { orientation: body.name.clone(), inertia: inertia.clone() },
            (Advance::Carried, None) => Way::Carried,
            (Advance::Linear | Advance::Everywhere, None) if rate.role == Role::State => Way::Drift,
            (Advance::Linear | Advance::Everywhere, None) => Way::Kick,
        };
        Some(Self { column: column.clone(), rate: rate.clone(), way })
    }
}

impl Columns {
    /// The columns that integrators advance in addition to positions and velocities, in the order of declaration.
    #[must_use]
    pub fn pairs(&self) -> Vec<Pair> {
        let own = |column: &&Column| !["position", "velocity"].contains(&column.name.as_ref());
        self.iter().filter(own).filter_map(|column| Pair::of(column, self)).collect()
    }
    /// Whether the elements of a column's buffer are vectors, because it is a vector or lies in one; otherwise they are numbers.
    #[must_use]
    pub fn lies_in_vectors(&self, column: &Column) -> bool {
        self.get(&column.place.buffer).is_some_and(|owner| matches!(owner.kind, Kind::Vector | Kind::Quaternion))
    }
    /// Checks whether a column can be advanced as declared.
    pub(super) fn check_rate(&self, column: &Column) -> Result<(), Error> {
        let Some(rate) = &column.rate else { return Ok(()) };
        let Some(other) = self.get(rate) else {
            return Err(Error::Scene(format!(
                "the column `{}` is advanced by `{rate}`, which no component declares: declare it too",
                column.name
            )));
        };
        let turns = matches!(column.advance, Advance::Rotation { .. });
        let fits = if turns {
            column.kind == Kind::Quaternion && other.kind == Kind::Vector
        } else {
            other.kind == column.kind && column.kind != Kind::Whole
        };
        if !fits || other.shape != column.shape || column.role != Role::State {
            return Err(Error::Scene(format!(
                "the column `{}` ({}) cannot be advanced by `{rate}` ({}): both must be of one kind and shape and real, and the first a \
                 state; a quaternion turns by a vector",
                column.name,
                column.kind.name(),
                other.kind.name()
            )));
        }
        let next = other.rate.as_ref().and_then(|next| self.get(next));
        if other.role == Role::State && next.is_some_and(|next| next.role == Role::State) {
            return Err(Error::Scene(format!(
                "the column `{}` is advanced by `{rate}`, which a drift advances as well: two drifts in a row have no consistent order; \
                 let evaluations compute the rate of `{rate}`",
                column.name
            )));
        }
        if column.advance == Advance::Carried && other.role == Role::State {
            return Err(Error::Scene(format!(
                "the column `{}` is carried along by `{rate}`, which is a state: the rate of what is carried is computed in each drift",
                column.name
            )));
        }
        let alike = column.place.component == other.place.component;
        if !alike || self.lies_in_vectors(column) != self.lies_in_vectors(other) {
            return Err(Error::Scene(format!(
                "the column `{}` lies in component {} of `{}`, and its rate `{rate}` in component {} of `{}`: both must lie in the same \
                 component of buffers of one kind",
                column.name, column.place.component, column.place.buffer, other.place.component, other.place.buffer
            )));
        }
        self.check_body(column, other)
    }
    /// A rotating body requires a torque, moments of inertia, and buffers of its own.
    fn check_body(&self, column: &Column, rate: &Column) -> Result<(), Error> {
        let Advance::Rotation { inertia } = &column.advance else { return Ok(()) };
        let torque = rate.rate.as_ref().and_then(|torque| self.get(torque));
        let Some(torque) = torque.filter(|torque| torque.role != Role::State && rate.role == Role::State) else {
            return Err(Error::Scene(format!(
                "the rate of the orientation `{}` is `{}`, which must be a state with a torque that evaluations compute as its rate",
                column.name, rate.name
            )));
        };
        let moments =
            self.get(inertia).filter(|it| it.kind == Kind::Vector && it.role == Role::State && it.rate.is_none());
        let Some(moments) = moments else {
            return Err(Error::Scene(format!(
                "the orientation `{}` has its moments of inertia in `{inertia}`: declare that as a vector, a state without a rate",
                column.name
            )));
        };
        match [column, rate, torque, moments].into_iter().find(|it| it.is_packed() || it.shape != Shape::Particle) {
            Some(it) => Err(Error::Scene(format!(
                "the column `{}` belongs to a rigid body, and needs its own buffer with one value for each particle",
                it.name
            ))),
            None => Ok(()),
        }
    }
    /// Checks whether a column that is set to zero before each evaluation is only a sum.
    pub(super) fn check_sum(&self, column: &Column) -> Result<(), Error> {
        let other = self.of_buffer(&column.place.buffer).find(|other| other.role != Role::Sum);
        match other.filter(|_| column.role == Role::Sum) {
            Some(other) => Err(Error::Scene(format!(
                "the column `{}` is a sum that each evaluation begins anew, and lies in one buffer with `{}`, which is none: give it a \
                 buffer of its own",
                column.name, other.name
            ))),
            None => Ok(()),
        }
    }
}
