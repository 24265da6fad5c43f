//! A box that changes: new cells where the old ones have become too narrow, and more waves where it has grown.

use super::Simulation;
use super::barostat::{LARGER, USUAL};
use super::grow::Room;
use crate::component::barostat::{CORNER, WATCH, boxed};
use crate::error::Error;
use crate::kernel::{Array, Backend, Bounds, Element};
use crate::neighbors::List;

/// The largest change of the volume at once.
const LARGEST: f64 = 0.3;
/// The part of the shortest side, and of the longest, at which plans are written in advance, so that no steps need to be repeated.
const AMPLE: f64 = 1.02;

/// How far the box may change from what it is, as parts of its sides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Change {
    /// That for which cells are to be wide enough.
    pub least: f64,
    /// That for which there are to be waves enough.
    pub most: f64,
}

impl Default for Change {
    fn default() -> Self {
        Self { least: USUAL, most: LARGER }
    }
}

/// How the cells and the waves fit the box, and whether a barostat can go on.
pub(super) enum Fit {
    Well,
    /// Cells will soon be too narrow, or waves too few.
    Soon,
    /// They were: how far the box is to be able to change.
    Not(Change),
    /// They fit, and there is nothing that would heal this.
    Refused(String),
}

/// What a barostat has recorded.
struct Watch {
    /// The shortest side along x so far \[length\]; 0 before the first step.
    shortest: f64,
    /// The longest one.
    longest: f64,
    /// The largest change of the logarithm of the volume at once.
    largest: f64,
    /// How many particles had forces that did not add up.
    unpaired: f64,
}

impl<B: Backend> Simulation<B> {
    /// The box at the end of the last step: that of the setup, unless a barostat has changed it.
    ///
    /// # Errors
    /// Errors of reading.
    pub async fn bounds(&mut self) -> Result<Bounds, Error> {
        self.settle().await?;
        let given = self.problem.bounds;
        if self.problem.elastic.is_none() {
            return Ok(given);
        }
        let corner = self.backend.read(CORNER.name, &Array::Vec4(Vec::new()), 1).await?;
        let corner = glam::Vec4::view(&corner).and_then(|all| all.first()).map(|corner| corner.truncate());
        Ok(corner.map_or(given, |corner| boxed(&given, corner)))
    }
    /// How the cells and the waves fit the box: what a repetition heals comes before what nothing heals.
    ///
    /// # Errors
    /// Errors of reading; and numbers that are not finite, which are the cause of whatever else is wrong: as of [`Simulation::snapshot`].
    pub(super) async fn fit(&mut self) -> Result<Fit, Error> {
        let Some(watch) = self.watched().await? else { return Ok(Fit::Well) };
        let period = self.problem.bounds.period();
        let axes = || (0..3).filter(|axis| period[*axis] > 0.0);
        let part = watch.shortest / period.x;
        let smallest = axes().map(|axis| 2.0 * self.setup.range() / period[axis]).fold(0.0, f64::max);
        let cells = self.list.map(|shape| Ok::<_, Error>(List::new(shape, &self.problem)?.grid.shortest_sides()));
        let least = cells.transpose()?.unwrap_or_default();
        let narrow = axes().map(|axis| least[axis] / period[axis]).fold(0.0, f64::max);
        let begun = watch.shortest != 0.0;
        let is_narrow = |part: f64| begun && part < narrow && narrow > smallest;
        let (times, most) = (watch.longest / period.x, self.most_waves());
        if is_narrow(part) || times > most {
            let least = if is_narrow(part) { (part / AMPLE).max(smallest).min(USUAL) } else { USUAL };
            return Ok(Fit::Not(Change { least, most: (AMPLE * times).max(LARGER) }));
        }
        // Before what follows from it, as numbers that are not finite.
        if let Some(why) = too_fast(&watch).filter(|_| watch.largest.is_finite()) {
            return Ok(Fit::Refused(why));
        }
        if let Some(why) = self.refusal(&watch, begun.then_some([part, smallest])) {
            let alarm = self.alarm().await?;
            self.sound(&alarm)?;
            return Ok(Fit::Refused(why));
        }
        Ok(if is_narrow(part / AMPLE) || AMPLE * times > most { Fit::Soon } else { Fit::Well })
    }
    /// The multiple of the sides for which there are waves enough.
    fn most_waves(&self) -> f64 {
        let has_waves = self.setup.forces.iter().any(|force| force.properties().has_waves);
        self.problem.elastic.filter(|_| has_waves).map_or(f64::INFINITY, |elastic| elastic.most)
    }
    /// Why a barostat cannot go on; `sides` are the part of the sides that is left, and the smallest for which forces end within half of them.
    fn refusal(&self, watch: &Watch, sides: Option<[f64; 2]>) -> Option<String> {
        // Written so that numbers that are not finite are refused.
        let good = watch.unpaired <= 0.0;
        if !good {
            return Some(
                "the forces of pairs do not add up to the forces on particles, or are not finite, so that they have no pressure: leave out the \
                 barostat"
                    .to_owned(),
            );
        }
        if let Some(why) = too_fast(watch) {
            return Some(why);
        }
        let [part, smallest] = sides?;
        let good = part >= smallest;
        (!good).then(|| {
            format!(
                "a barostat has made the box so small that forces, which reach as far as {}, reach over more than half of it: take more particles, \
                 or a shorter range",
                self.setup.range()
            )
        })
    }
    /// What the barostat has recorded, if there is one.
    async fn watched(&mut self) -> Result<Option<Watch>, Error> {
        if self.problem.elastic.is_none() {
            return Ok(None);
        }
        let watch = self.backend.read(WATCH.name, &Array::Vec4(Vec::new()), 1).await?;
        let Some([watch]) = glam::Vec4::view(&watch).map(Vec::as_slice) else { return Ok(None) };
        Ok(Some(Watch { shortest: watch.x, longest: watch.w, largest: watch.y, unpaired: watch.z }))
    }
    /// Restores the copy, makes new cells and waves, and repeats the steps since, with the bits of a run that had them from the start.
    pub(super) async fn again_in_new_box(&mut self, change: Change) -> Result<(), Error> {
        let lost = || {
            Error::Scene(
                "a barostat has changed the box so much that its cells are too narrow, or waves too few, in steps that cannot be repeated: check the \
                 simulation more often"
                    .to_owned(),
            )
        };
        let Some(from) = self.repeat.take() else { return Err(lost()) };
        let watch = self.backend.read(WATCH.name, &Array::Vec4(Vec::new()), 1).await?;
        self.backend.restore()?;
        (self.steps, self.begun) = (from.steps, from.begun);
        // The copied state may itself have come from cells that were too narrow, or have lacked neighbours.
        let whole = self.list_sufficed().await? && !matches!(self.fit().await?, Fit::Not(_));
        let grown = if whole { self.grow(Room::Box(change)).await } else { Err(lost()) };
        if let Err(why) = grown {
            // Each later check finds it again.
            self.backend.write(WATCH.name, &watch)?;
            return Err(why);
        }
        self.repeat_steps(from.since)
    }
}

/// That a barostat has changed the box by too much at once, if it has.
fn too_fast(watch: &Watch) -> Option<String> {
    (watch.largest > LARGEST).then(|| {
        format!(
            "a barostat changed the volume by a part of {:.3} at once, and {LARGEST} is the most: the pressure is far from the given one, or the \
             compressibility is too large: choose a longer time, or move particles apart by `minimize` before",
            watch.largest
        )
    })
}
