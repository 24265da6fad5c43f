//! A box that changes: what a barostat serves, and new cells where the old ones have become too narrow.

use super::grow::Room;
use super::{Setup, Simulation};
use crate::component::barostat::{CORNER, WATCH, boxed};
use crate::error::Error;
use crate::forces::{Component, Over};
use crate::kernel::{ACCELERATION, Array, Backend, Bounds, Element, Side};
use crate::neighbors::List;
use crate::state::{KEPT_PART, State};

/// The largest change of the volume at once.
const LARGEST: f64 = 0.3;
/// The part of the sides for which cells are wide enough, if no smaller box is known.
const USUAL: f64 = 0.95;
/// The part of the shortest side at which new cells are made in advance, so that no steps need to be repeated.
const AMPLE: f64 = 1.02;

/// The part of the sides for which cells were made from which on they are too wide.
const WIDE: f64 = 1.2;

/// How the cells fit the box.
enum Fit {
    Well,
    /// They will soon be too narrow.
    Soon,
    /// They were too narrow: the part of the sides for which they are to be wide enough.
    Not(f64),
}

impl State {
    /// The box of this state, where a barostat has changed it; else this one.
    #[must_use]
    pub fn boxed(&self, bounds: &Bounds) -> Bounds {
        self.vector(CORNER.name).and_then(|corner| corner.first()).map_or(*bounds, |corner| boxed(bounds, *corner))
    }
}

impl Setup {
    /// The barostat, if there is one.
    fn barostat(&self) -> Option<&dyn Component> {
        self.forces.iter().map(AsRef::as_ref).find(|force| force.properties().barostat.is_some())
    }
    /// Where the box changes, the part of its sides for which cells are to be wide enough.
    pub(super) fn elastic(&self) -> Option<f64> {
        self.barostat()?;
        let kept = self.state.kept.get(KEPT_PART).and_then(|list| list.first().copied());
        Some(kept.filter(|part| (0.0..=USUAL).contains(part)).unwrap_or(USUAL))
    }
    /// The same with the box of the state, and with the box in the state; `None` where there is no barostat.
    pub(super) fn stretched(&self) -> Result<Option<Self>, Error> {
        if self.barostat().is_none() {
            return Ok(None);
        }
        let mut bounds = self.state.boxed(&boxed(&self.bounds, self.bounds.high.as_vec3().as_dvec3()));
        bounds.high = bounds.high.as_vec3().as_dvec3();
        let mut setup = Self { bounds, ..self.with_state(self.state.clone()) };
        for column in self.columns()?.iter().filter(|column| column.name == CORNER.name) {
            setup.state.declare(column)?;
        }
        setup.state.set(CORNER.name, Array::Vec3(vec![bounds.high]))?;
        Ok(Some(setup))
    }
    /// Refuses what a barostat does not serve.
    pub(super) fn serves_barostat(&self) -> Result<(), Error> {
        let Some(barostat) = self.barostat() else { return self.has_its_box() };
        let refuse = |why: String| Err(Error::Scene(format!("{} {why}", barostat.name())));
        let others = || self.forces.iter().filter(|force| force.name() != barostat.name());
        if self.forces.iter().filter(|force| force.properties().barostat.is_some()).count() > 1 {
            return refuse("changes the box, and so does another barostat: leave one of them out".to_owned());
        }
        if self.integrator.name() != "leapfrog" {
            let integrator = self.integrator.name();
            return refuse(format!(
                "changes the box once in a step, between a drift and an evaluation, and {integrator} has other steps: choose leapfrog"
            ));
        }
        for force in others() {
            let name = force.name();
            let properties = force.properties();
            if properties.pictured.is_some() || properties.needs_forces {
                return refuse(format!("does not serve `{name}`: leave one of them out"));
            }
            for law in force.laws() {
                match law.over {
                    Over::Each if law.into.iter().any(|name| name == ACCELERATION.name) => {
                        return refuse(format!(
                            "knows the pressure of pairs, and `{}` acts on single particles: leave one of them out",
                            law.name
                        ));
                    }
                    Over::Near { .. } => {
                        return refuse(format!(
                            "changes the cells that `{}` searches, and the order of its sums: choose over = \"list\"",
                            law.name
                        ));
                    }
                    _ => {}
                }
            }
        }
        let (range, period) = (self.range(), self.bounds.period());
        let sides = period.to_array().into_iter().filter(|side| *side > 0.0);
        let shortest = sides.fold(f64::INFINITY, f64::min);
        if 2.0 * range > shortest {
            return refuse(format!(
                "has a box with a side of {shortest}, and forces reach as far as {range}, more than half of it: take more particles, or a shorter \
                 range"
            ));
        }
        Ok(())
    }
    /// The longest range of a law.
    fn range(&self) -> f64 {
        let ranges = self.forces.iter().flat_map(|force| force.laws()).filter_map(|law| law.over.range());
        ranges.fold(0.0, f64::max)
    }
    /// Refuses a state that was made in another box.
    fn has_its_box(&self) -> Result<(), Error> {
        let bounds = self.state.boxed(&self.bounds);
        let differs = |axis: &usize| {
            let [here, there] = [&self.bounds, &bounds].map(|bounds| bounds.high[*axis] - bounds.low[*axis]);
            self.bounds.sides[*axis] == Side::Periodic && (here - there).abs() > 1e-6 * here.abs()
        };
        let Some(axis) = (0..3).find(differs) else { return Ok(()) };
        let [here, there] = [&self.bounds, &bounds].map(|bounds| bounds.high[axis] - bounds.low[axis]);
        Err(Error::Scene(format!(
            "the state comes from a run with a barostat, in which the box was {there} along {} at its end, and here it is {here}: set [box] size \
             to that of the state",
            ["x", "y", "z"][axis]
        )))
    }
}

impl<B: Backend> Simulation<B> {
    /// Makes new cells where the box has become too small for the old ones, and repeats the steps since the last check, with the bits of a run
    /// that had them from the start. Returns whether anything has changed.
    pub(super) async fn fit_cells(&mut self) -> Result<bool, Error> {
        match self.fit().await? {
            Fit::Well => return Ok(false),
            Fit::Soon => {
                self.repeat.forget();
                self.grow(Room::Cells(USUAL)).await?;
            }
            Fit::Not(part) => self.again_in_new_cells(part).await?,
        }
        Ok(true)
    }
    /// How the cells fit the box.
    ///
    /// # Errors
    /// [`Error::Scene`] when the box has changed too much at once or become too small, or forces have no pressure.
    async fn fit(&mut self) -> Result<Fit, Error> {
        let watch = self.backend.read(WATCH.name, &Array::Vec4(Vec::new()), 1).await?;
        let Some([watch]) = glam::Vec4::view(&watch).map(Vec::as_slice) else { return Ok(Fit::Well) };
        let refuse = |text: String| Err(Error::Scene(text));
        if watch.z > 0.0 {
            return refuse(
                "the forces of pairs do not add up to the forces on particles, or are not finite, so that they have no pressure: leave out the \
                 barostat"
                    .to_owned(),
            );
        }
        if watch.y > LARGEST {
            return refuse(format!(
                "a barostat changed the volume by a part of {:.3} at once, and {LARGEST} is the most: the pressure is far from the given one, or the \
                 compressibility is too large: choose a longer time, or move particles apart by `minimize` before",
                watch.y
            ));
        }
        let period = self.problem.bounds.period();
        let axes = || (0..3).filter(|axis| period[*axis] > 0.0);
        let part = watch.x / period.x;
        let smallest = axes().map(|axis| 2.0 * self.setup.range() / period[axis]).fold(0.0, f64::max);
        let cells = self.list.map(|shape| Ok::<_, Error>(List::new(shape, &self.problem)?.grid.shortest_sides()));
        let least = cells.transpose()?.unwrap_or_default();
        let narrow = axes().map(|axis| least[axis] / period[axis]).fold(0.0, f64::max);
        if part <= 0.0 {
            return Ok(Fit::Well);
        }
        if part < narrow && narrow > smallest {
            return Ok(Fit::Not((part / AMPLE).clamp(smallest, USUAL)));
        }
        if part < smallest {
            return refuse(format!(
                "a barostat has made the box so small that forces, which reach as far as {}, reach over more than half of it: take more particles, \
                 or a shorter range",
                self.setup.range()
            ));
        }
        // What has grown much has cells that are too wide.
        let wide = self.list.is_some() && part > WIDE;
        Ok(if wide || part < AMPLE * narrow && narrow > smallest { Fit::Soon } else { Fit::Well })
    }
    /// Restores the copy, makes new cells, and repeats the steps since.
    async fn again_in_new_cells(&mut self, part: f64) -> Result<(), Error> {
        let Some(from) = self.repeat.take() else {
            return Err(Error::Scene(
                "a barostat has made the box so much smaller that its cells are too narrow, in steps that cannot be repeated: check the \
                 simulation more often"
                    .to_owned(),
            ));
        };
        self.backend.restore()?;
        (self.steps, self.begun) = (from.steps, from.begun);
        self.grow(Room::Cells(part)).await?;
        self.repeat_steps(from.since)
    }
}
