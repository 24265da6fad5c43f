//! The verbs applied to columns that components declare with a rate.
//!
//! A column is advanced with velocities where evaluations compute its rate, and with positions where its rate is a state. A carried column,
//! whose rate follows from velocities, such as a density, has its rate computed in the middle of each drift. A Runge–Kutta step advances
//! all of them in its stages. Implicit methods solve for positions and velocities only: the columns are advanced explicitly, by rates
//! computed where laws without a Jacobian are evaluated.

use super::Step;
use crate::component;
use crate::error::Error;
use crate::forces::{Component, Stage};
use crate::integrators::verbs::keep::copy;
use crate::integrators::verbs::pairs::{Advanced, Part, advance, around, runge_kutta};
use crate::integrators::verbs::solve::{START_POSITION, update};
use crate::kernel::{Advance, Column, Columns, Kernel, Name, POSITION, Pair, Plan, Problem, Role, Way};
use crate::rotation::{self, Body};

/// The body whose orientation or angular velocity a pair advances.
fn body(pair: &Pair, columns: &Columns) -> Option<Body> {
    let (orientation, angular_velocity, torque, inertia) = match &pair.way {
        Way::Rotation { inertia } => {
            (&pair.column.name, &pair.rate.name, columns.get(&pair.rate.name)?.rate.as_ref()?, inertia)
        }
        Way::Torque { orientation, inertia } => (orientation, &pair.column.name, &pair.rate.name, inertia),
        Way::Kick | Way::Drift | Way::Carried => return None,
    };
    Some(Body {
        orientation: orientation.clone(),
        angular_velocity: angular_velocity.clone(),
        torque: torque.clone(),
        inertia: inertia.clone(),
    })
}

/// A column and the buffer of its slope.
fn slope(pair: &Pair, columns: &Columns) -> Advanced {
    let advanced = Advanced::of(pair, columns);
    match (&pair.way, body(pair, columns)) {
        (Way::Rotation { .. }, Some(body)) => Advanced { rate: body.rate(), ..advanced },
        (_, Some(body)) => Advanced { rate: body.acceleration(), ..advanced },
        (_, None) => advanced,
    }
}

/// The rates, other than accelerations, that evaluations compute and kicks use, one of each buffer.
fn rates(columns: &Columns) -> Vec<Column> {
    let mut known = vec![Name::from("acceleration")];
    let used = |pair: &Pair| matches!(pair.way, Way::Kick | Way::Torque { .. });
    let rates = columns.pairs().into_iter().filter(used).map(|pair| pair.rate);
    let new = |rate: &Column| {
        let new = !known.contains(&rate.place.buffer);
        known.push(rate.place.buffer.clone());
        new
    };
    rates.filter(new).collect()
}

/// The buffers of the rates, other than accelerations, that a step saves for the next one.
#[must_use]
pub fn kept_rates(columns: &Columns) -> Vec<Name> {
    rates(columns).into_iter().map(|rate| rate.place.buffer).collect()
}

impl Step<'_> {
    /// A kernel for each pair, in the order of declaration.
    fn each_pair(&mut self, write: impl Fn(&Pair, &Columns, &Problem) -> Option<Result<Kernel, Error>>) {
        let columns = self.problem.columns.clone();
        for pair in columns.pairs() {
            if let Some(kernel) = write(&pair, &columns, &self.problem) {
                self.add(kernel);
            }
        }
    }
    /// Advances columns whose rates are computed by evaluations, like velocities.
    pub(super) fn kick_pairs(&mut self, factor: f64) {
        self.each_pair(|pair, columns, problem| match (&pair.way, body(pair, columns)) {
            (Way::Kick, _) => Some(advance::advance("kick", &Advanced::of(pair, columns), factor, problem)),
            (Way::Torque { .. }, Some(body)) => Some(rotation::kick(&body, factor, problem)),
            _ => None,
        });
    }
    /// Advances columns whose rates are states, like positions.
    pub(super) fn drift_pairs(&mut self, factor: f64) {
        self.each_pair(|pair, columns, problem| match (&pair.way, body(pair, columns)) {
            (Way::Drift, _) => Some(advance::advance("drift", &Advanced::of(pair, columns), factor, problem)),
            (Way::Rotation { .. }, Some(body)) => Some(rotation::drift(&body, factor, problem)),
            _ => None,
        });
    }
    /// Whether there are carried columns.
    pub(super) fn carries(&self) -> bool {
        self.problem.columns.pairs().iter().any(|pair| pair.way == Way::Carried)
    }
    /// Whether each component computes rates of carried columns: it declares such a column, or has a law for one.
    fn carrying(&self) -> Vec<bool> {
        let declares = |force: &dyn Component| force.columns().iter().any(|column| column.advance == Advance::Carried);
        let computes = |force: &dyn Component| force.laws().iter().any(|law| component::carries(law, &self.problem));
        self.forces.iter().map(|force| declares(force.as_ref()) || computes(force.as_ref())).collect()
    }
    /// A drift with carried columns. After the rates are computed in its middle, positions are advanced the whole way from its start, not
    /// from its middle, so that they are rounded once.
    pub(super) fn drift_carrying(&mut self, factor: f64) {
        let (count, kicked) = (self.problem.capacity, self.kicked.take());
        self.add(copy(count, "start", POSITION, START_POSITION));
        self.kicked = kicked;
        self.go(0.5 * factor);
        self.carry(factor, self.drifted + 0.5 * factor);
        self.add(update::reach(count, factor));
    }
    /// Advances carried columns by `factor` of the step; positions are in the middle of that part, at `middle` of the step.
    pub(super) fn carry(&mut self, factor: f64, middle: f64) {
        self.at(middle);
        let carrying = self.carrying();
        self.neighbors(|place| carrying[place]);
        self.carried_rates();
        self.each_pair(|pair, columns, problem| {
            let carried = pair.way == Way::Carried;
            carried.then(|| advance::advance("carry", &Advanced::of(pair, columns), factor, problem))
        });
    }
    /// Computes the rates of carried columns at the current positions.
    pub(super) fn carried_rates(&mut self) {
        self.clear_sums(true);
        let mut plan = Plan::default();
        for (place, _) in self.carrying().iter().enumerate().filter(|(_, carries)| **carries) {
            let stage = Stage::Carry { earlier: component::earlier(self.forces, place) };
            if self.error.is_none() {
                self.error = self.forces[place].stage(stage, &mut plan, &self.problem).err();
            }
        }
        plan.steps().for_each(|kernel| self.add(Ok(kernel.clone())));
    }
    /// Sets sums to zero before the first law: those that are rates of carried columns, or all others.
    pub(super) fn clear_sums(&mut self, carried: bool) {
        let columns = self.problem.columns.clone();
        let rates: Vec<_> =
            columns.pairs().into_iter().filter(|pair| pair.way == Way::Carried).map(|pair| pair.rate.name).collect();
        let mut cleared = vec![crate::kernel::Name::from("acceleration")];
        for column in columns.iter().filter(|column| column.role == Role::Sum) {
            if rates.contains(&column.name) == carried && !cleared.contains(&column.place.buffer) {
                cleared.push(column.place.buffer.clone());
                self.add(around::clear(&Part::of(column, &columns), &self.problem));
            }
        }
    }
    /// Saves the columns at the start of the step.
    pub(super) fn save_pairs(&mut self) {
        self.each_pair(|pair, columns, problem| Some(runge_kutta::save(&Part::of(&pair.column, columns), problem)));
    }
    /// Computes the slopes of orientations, which differ from their rates.
    pub(super) fn slopes(&mut self) {
        self.each_pair(|pair, columns, problem| {
            let turns = matches!(pair.way, Way::Rotation { .. });
            body(pair, columns).filter(|_| turns).map(|body| rotation::slopes(&body, problem))
        });
    }
    /// A stage of the columns whose rates are states, while these have the values of the previous stage, or of all others.
    pub(super) fn stage_pairs(&mut self, drifts: bool, weight: f64, factor: f64) {
        self.each_pair(|pair, columns, problem| {
            let its = (pair.way == Way::Drift) == drifts;
            its.then(|| runge_kutta::stage(&slope(pair, columns), weight, factor, problem))
        });
    }
    /// The same at the end of the step.
    pub(super) fn finish_pairs(&mut self, drifts: bool, weight: f64) {
        self.each_pair(|pair, columns, problem| {
            let its = (pair.way == Way::Drift) == drifts;
            its.then(|| runge_kutta::finish(&slope(pair, columns), weight, problem))
        });
        if !drifts {
            self.each_pair(|pair, columns, problem| {
                let turns = matches!(pair.way, Way::Rotation { .. });
                body(pair, columns).filter(|_| turns).map(|body| rotation::unit(&body, problem))
            });
        }
    }
    /// After a solve for a part of the step: carried columns are advanced along the straight line from the start of that part to its end,
    /// where the solve leaves positions; the others are kicked and drift, as by symplectic Euler.
    pub(super) fn solved_pairs(&mut self, factor: f64, until: f64) {
        if self.carries() {
            self.add(update::reach(self.problem.capacity, 0.5 * factor));
            self.carry(factor, until - 0.5 * factor);
            self.add(update::reach(self.problem.capacity, factor));
        }
        self.kick_pairs(factor);
        self.drift_pairs(factor);
    }
    /// From the middle of the step to its end, with the rates of the middle; velocities are still those of the middle.
    pub(super) fn extrapolated_pairs(&mut self) {
        if self.carries() {
            self.add(update::reach(self.problem.capacity, 0.75));
            self.carry(0.5, 0.75);
        }
        self.drift_pairs(0.5);
        self.kick_pairs(0.5);
    }
    /// Saves or restores rates that the next step uses, around a measurement.
    pub(super) fn keep_rates(&mut self, restore: bool) {
        let columns = self.problem.columns.clone();
        for rate in rates(&columns) {
            let kernel = if restore { around::restore } else { around::keep };
            self.add(kernel(&Part::of(&rate, &columns), &self.problem));
        }
    }
    /// Raises the alarm for columns that are not finite.
    pub(super) fn watch_pairs(&mut self, ahead: u32) {
        self.each_pair(|pair, columns, problem| {
            around::watch(&Part::of(&pair.column, columns), ahead, problem).transpose()
        });
    }
}
