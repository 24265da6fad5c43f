//! What a barostat serves, and the box of a state in place of that of a scene.

use std::borrow::Cow;

use glam::DVec3;

use super::Setup;
use crate::component::barostat::{CORNER, boxed};
use crate::error::Error;
use crate::forces::{Component, Over};
use crate::kernel::{ACCELERATION, Array, Bounds, Elastic, Side};
use crate::state::{KEPT_MOST, KEPT_PART, KEPT_SIDES, State};

/// The part of the sides for which cells are wide enough, if no smaller box is known.
pub(super) const USUAL: f64 = 0.95;
/// The multiple of the sides for which there are waves enough, if no larger box is known.
pub(super) const LARGER: f64 = 1.1;
/// How much the sides of a box may differ in the part by which they have changed: they are rounded to single precision.
const ONE_PART: f64 = 1e-5;
/// The part of its relaxation time after which a barostat changes the box at the latest.
const SPAN: f64 = 0.2;

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
    /// How far the box may change, if something changes it.
    pub(super) fn elastic(&self) -> Option<Elastic> {
        self.barostat()?;
        let kept = |name| self.state.kept.get(name).unwrap_or_default();
        let one = |name| kept(name).first().copied();
        let sides = Some(kept(KEPT_SIDES)).filter(|sides| sides.len() == 3).map(DVec3::from_slice);
        let period = self.bounds.period();
        // All sides change by one part: others are those of another box.
        let is_one = |sides: &DVec3| {
            let parts = DVec3::select(period.cmpgt(DVec3::ZERO), *sides / period, DVec3::splat(sides.x / period.x));
            parts.is_finite() && parts.x > 0.0 && parts.max_element() - parts.min_element() < ONE_PART * parts.x
        };
        Some(Elastic {
            least: one(KEPT_PART).filter(|part| (0.0..=USUAL).contains(part)).unwrap_or(USUAL),
            most: one(KEPT_MOST).filter(|most| most.is_finite() && *most >= LARGER).unwrap_or(LARGER),
            start: sides.filter(is_one).unwrap_or(period),
        })
    }
    /// The same in the box of its state, and with the box in the state, where a barostat changes it; `None` where that is so already, or
    /// nothing changes it. A state that has a box keeps all digits of it; that of a scene is rounded as all kernels know it.
    pub(super) fn stretched(&self) -> Result<Option<Self>, Error> {
        if self.barostat().is_none() {
            return Ok(None);
        }
        let bounds = self.state.boxed(&boxed(&self.bounds, self.bounds.high.as_vec3().as_dvec3()));
        if bounds == self.bounds && self.state.vector(CORNER.name).is_some() {
            return Ok(None);
        }
        let mut setup = Self { bounds, ..self.with_state(self.state.clone()) };
        for column in self.columns()?.iter().filter(|column| column.name == CORNER.name) {
            setup.state.declare(column)?;
        }
        setup.state.set(CORNER.name, Array::Vec3(vec![bounds.high]))?;
        Ok(Some(setup))
    }
    /// The same in the box of its state: what is to be said of it before a run.
    ///
    /// # Errors
    /// [`Error::Scene`] when declarations of columns differ.
    pub fn in_its_box(&self) -> Result<Cow<'_, Self>, Error> {
        Ok(self.stretched()?.map_or(Cow::Borrowed(self), Cow::Owned))
    }
    /// Refuses what a barostat does not serve.
    pub(super) fn serves_barostat(&self) -> Result<(), Error> {
        let Some(barostat) = self.barostat() else { return self.has_its_box() };
        let refuse = |why: String| Err(Error::Scene(format!("{} {why}", barostat.name())));
        if self.forces.iter().filter(|force| force.properties().barostat.is_some()).count() > 1 {
            return refuse("changes the box, and so does another barostat: leave one of them out".to_owned());
        }
        if let Some(why) = self.unserved_box().or_else(|| self.unserved_steps(barostat)) {
            return refuse(why);
        }
        for force in self.forces.iter().filter(|force| force.properties().barostat.is_none()) {
            let properties = force.properties();
            if properties.pictured.is_some() || properties.needs_forces {
                return refuse(format!("does not serve `{}`: leave one of them out", force.name()));
            }
            if properties.makes_fluid {
                return refuse(format!(
                    "knows the pressure of pairs, and `{}` has one of its own: leave one of them out",
                    force.name()
                ));
            }
            if let Some(why) = unserved_laws(force.as_ref()) {
                return refuse(why);
            }
            let listed = force.laws().iter().all(|law| matches!(law.over, Over::List { .. } | Over::Auto { .. }));
            if properties.has_waves && !listed {
                return refuse(format!(
                    "changes the box, and `{}` needs more waves in a larger one: choose over = \"list\", with which steps can be repeated",
                    force.name()
                ));
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
    /// What it does not serve of the box and the particles in it.
    fn unserved_box(&self) -> Option<String> {
        let (bounds, state) = (&self.bounds, &self.state);
        let axes = bounds.dimensions as usize;
        if bounds.sides[..axes].iter().any(|side| *side != Side::Periodic) {
            return Some(format!(
                "changes a box that is periodic on all sides, and here {bounds}: set [box] boundary = \"periodic\""
            ));
        }
        let why = if !state.held.is_empty() {
            "moves all particles with the box: leave out those that are fixed or move as prescribed"
        } else if self.has_inactive()
            || !state.births.is_empty()
            || !state.drains.is_empty()
            || state.capacity.is_some()
        {
            "keeps the same particles all the time: leave out emitters, drains and mergers"
        } else if !state.links.rods.is_empty() {
            "stretches all distances, and rods keep theirs: leave out the rods"
        } else if self.integrator.precision().is_double() {
            "moves positions of single precision: leave out precision = \"compensated\""
        } else {
            return None;
        };
        Some(why.to_owned())
    }
    /// What it does not serve of the steps.
    fn unserved_steps(&self, barostat: &dyn Component) -> Option<String> {
        if self.integrator.name() != "leapfrog" {
            let integrator = self.integrator.name();
            return Some(format!(
                "changes the box once in a step, between a drift and an evaluation, and {integrator} has other steps: choose leapfrog"
            ));
        }
        let pressed = barostat.properties().barostat?;
        (f64::from(pressed.every) * self.dt > SPAN * pressed.time).then(|| {
            format!(
                "changes the box every {} steps of {}, which is more than a fifth of its relaxation time {}: choose a longer time, or lower `every`",
                pressed.every, self.dt, pressed.time
            )
        })
    }
    /// The longest range of a law.
    pub(super) fn range(&self) -> f64 {
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

/// What a barostat does not serve of the laws of a force.
fn unserved_laws(force: &dyn Component) -> Option<String> {
    force.laws().into_iter().find_map(|law| match law.over {
        Over::Each if law.into.iter().any(|name| name == ACCELERATION.name) => Some(format!(
            "knows the pressure of pairs, and `{}` acts on single particles: leave one of them out",
            law.name
        )),
        Over::Near { .. } | Over::Nearest { .. } => Some(format!(
            "changes the cells that `{}` searches, and the order of its sums: choose over = \"list\"",
            law.name
        )),
        _ => None,
    })
}
