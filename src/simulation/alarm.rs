//! The alarm: numbers that are not finite, runaways, searches and laws that failed.

use std::collections::BTreeMap;

use super::{Plans, Simulation};
use crate::error::Error;
use crate::kernel::{ALARM, ALARM_WORDS, Array, Backend, Element, LAW, Plan, QUIET};
use crate::visit::Law;

/// The marks by which an alarm names users' laws, and their names with their files.
pub type Marks = BTreeMap<u32, String>;

/// The marks of all laws of these plans that have a mark.
pub fn marks(plans: &Plans) -> Marks {
    plans.all().flat_map(marked).collect()
}

fn marked(plan: &Plan) -> impl Iterator<Item = (u32, String)> {
    plan.kernels.iter().filter_map(|kernel| {
        let pass = kernel.passes.first()?;
        let (_, mark) = pass.constants.iter().find(|(name, _)| *name == LAW)?;
        let file = pass.shader.sources().iter().find(|source| source.law).map(|source| &source.file)?;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it was made of a word")]
        let mark = *mark as u32;
        Some((mark, format!("`{}` ({file})", kernel.name)))
    })
}

impl<B: Backend> Simulation<B> {
    /// Checks whether all numbers are finite, and whether speeds run away: whether the maximum has more than doubled from
    /// 16 steps to the next 16, eight times in a row. So it grows if steps are too long for a spring; in a fall, a
    /// collapse or an encounter it grows more slowly, or not for that long.
    ///
    /// # Errors
    /// [`Error::NotFinite`] with the first particle and step, [`Error::Runaway`] with one that is too fast and the step,
    /// [`Error::TooManyNeighbors`], [`Error::CutShort`], [`Error::Endless`], [`Error::TooShort`], [`Error::Outgrown`], or what reading says.
    pub async fn check(&mut self) -> Result<(), Error> {
        let mut alarm = self.alarm().await?;
        let [_, _, _, _, _, _, _, _, cut, endless, ..] = alarm;
        // Sums that lack neighbours lead to numbers that are not finite, and to runaway speeds.
        if cut == u32::MAX && endless == u32::MAX && self.settle().await? {
            alarm = self.alarm().await?;
        }
        let [done, .., fast, particle] = [alarm[0], alarm[1], alarm[3], alarm[4]];
        // A runaway leads to numbers that are not finite in the end: the first cause is reported.
        let [_, _, _, _, _, _, _, _, cut, endless, _, _, long, ..] = alarm;
        if fast != u32::MAX && fast <= done && long == u32::MAX && cut == u32::MAX && endless == u32::MAX {
            let particle = self.named(particle);
            return Err(Error::Runaway { particle, step: u64::from(fast.saturating_sub(1)) });
        }
        self.sound(&alarm)?;
        self.on_block_clock().await?;
        self.on_step_clock().await
    }
    pub(super) async fn alarm(&mut self) -> Result<[u32; ALARM_WORDS], Error> {
        let alarm = self.backend.read(ALARM.name, &Array::Uint(Vec::new()), ALARM_WORDS).await?;
        let words = u32::view(&alarm).and_then(|words| <[u32; ALARM_WORDS]>::try_from(words.as_slice()).ok());
        Ok(words.unwrap_or(QUIET))
    }
    /// Evaluates the laws of the present state once more, for what is measured then; [`Simulation::end_measurement`] has to follow.
    pub(super) async fn begin_measurement(&mut self) -> Result<(), Error> {
        let alarm = self.alarm().await?;
        self.sound(&alarm)?;
        self.repeatable(None)?;
        // The start plan computes the masses of a fluid's walls and its rest density.
        if self.begins {
            self.begin()?;
        }
        self.backend.run(&self.measure.0, 1)
    }
    /// Restores what the evaluation of a measurement overwrote. The alarm of that evaluation; `None` where a list was too short for it, so that
    /// the measurement has to be repeated.
    pub(super) async fn end_measurement(&mut self) -> Result<Option<[u32; ALARM_WORDS]>, Error> {
        let alarm = self.alarm().await?;
        self.backend.run(&self.measure.1, 1)?;
        Ok((!self.settle().await?).then_some(alarm))
    }
    /// The error of a bond that is too long, by the row of its lower end.
    fn overlong(&self, row: u32, step: u32) -> Error {
        let springs = self.ties.springs().iter().filter(|link| link.ends[0].min(link.ends[1]) == row);
        let partners: Vec<String> =
            springs.map(|link| self.named(link.ends[0].max(link.ends[1])).to_string()).collect();
        let particle = self.named(row);
        let bond = match &partners[..] {
            [partner] => format!("the bond of particles {particle} and {partner}"),
            all => format!("a bond of particle {particle}, with one of {},", all.join(", ")),
        };
        let laws = self.setup.forces.iter().flat_map(|force| force.laws());
        let longest = laws.filter_map(|law| law.longest).fold(f64::INFINITY, f64::min);
        Error::Overlong { particle, bond, longest, step: u64::from(step) }
    }
    /// The error of a body that has outgrown the search for its collisions.
    fn outgrown(&self, row: u32) -> Error {
        let properties = self.setup.forces.iter().map(|force| force.properties()).filter(|one| one.collides.is_some());
        let limits = properties.flat_map(|one| one.largest).map(|limit| limit.value);
        Error::Outgrown { particle: self.named(row), largest: limits.fold(f64::INFINITY, f64::min) }
    }
    /// Whether laws were evaluated completely, all numbers are finite, and searches have found all particles.
    pub(super) fn sound(&self, alarm: &[u32; ALARM_WORDS]) -> Result<(), Error> {
        let [done, particle, crowded, _, _, _, _, _, cut, endless, folded, beyond, long, end, grown] = *alarm;
        if folded != u32::MAX {
            return Err(Error::Device(format!(
                "the driver folds compensated sums, so that precision = \"{}\" would keep no more digits than single: choose precision = \
                 \"single\", another --adapter, or --backend cpu",
                self.setup.integrator.precision().name()
            )));
        }
        if beyond != u32::MAX {
            let laws = self.setup.forces.iter().flat_map(|force| force.laws()).find(Law::remembers);
            return Err(laws.map_or_else(|| Error::Device("a word of no history".to_owned()), |law| law.lacks(!beyond)));
        }
        let law = |mark: u32| self.marks.get(&mark).cloned().unwrap_or_else(|| "a law".to_owned());
        // A wrong law leads to numbers that are not finite, and to searches that do not end.
        if endless != u32::MAX {
            return Err(Error::Endless { law: law(endless) });
        }
        if cut != u32::MAX {
            return Err(Error::CutShort { law: law(cut) });
        }
        if long != u32::MAX {
            return Err(self.overlong(end, long));
        }
        if grown != u32::MAX {
            return Err(self.outgrown(grown));
        }
        if done != u32::MAX {
            // The first check comes before the first step, every other one after a completed step.
            let particle = self.named(particle);
            return Err(Error::NotFinite { particle, step: u64::from(done.saturating_sub(1)) });
        }
        if crowded == u32::MAX { Ok(()) } else { Err(Error::TooManyNeighbors { particle: self.named(crowded) }) }
    }
}
