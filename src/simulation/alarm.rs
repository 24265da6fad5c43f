//! Whether all is well.

use super::Simulation;
use crate::error::Error;
use crate::kernel::{ALARM, ALARM_WORDS, Array, Backend, Element, QUIET};

impl<B: Backend> Simulation<B> {
    /// Looks whether any number has stopped being one, or speeds run away: whether the largest has more than doubled from
    /// 16 steps to the next 16, eight times in a row. That is what steps do that are too long for a spring; a fall, a
    /// collapse or an encounter grows by less and less, or not for so long.
    ///
    /// # Errors
    /// [`Error::NotFinite`] with the first particle and step, [`Error::Runaway`] with one that is too fast and the step,
    /// [`Error::Crowded`], [`Error::TooShort`], or what reading says.
    pub async fn check(&mut self) -> Result<(), Error> {
        let alarm = self.alarm().await?;
        let [done, .., fast, particle] = [alarm[0], alarm[1], alarm[3], alarm[4]];
        // Who runs away is lost in the end: what came first is told.
        if fast != u32::MAX && fast <= done {
            return Err(Error::Runaway { particle, step: u64::from(fast.saturating_sub(1)) });
        }
        sound(&alarm)?;
        self.on_pace().await
    }
    pub(super) async fn alarm(&mut self) -> Result<[u32; ALARM_WORDS], Error> {
        let alarm = self.backend.read(ALARM.name, &Array::Uint(Vec::new()), ALARM_WORDS).await?;
        let words = u32::view(&alarm).and_then(|words| <[u32; ALARM_WORDS]>::try_from(words.as_slice()).ok());
        Ok(words.unwrap_or(QUIET))
    }
}

/// Whether numbers are numbers, and searches have found everybody.
pub(super) fn sound(alarm: &[u32; ALARM_WORDS]) -> Result<(), Error> {
    let [done, particle, crowded, ..] = *alarm;
    if done != u32::MAX {
        // The first look comes before the first step, every other one after a step that is done.
        return Err(Error::NotFinite { particle, step: u64::from(done.saturating_sub(1)) });
    }
    if crowded == u32::MAX { Ok(()) } else { Err(Error::Crowded { particle: crowded }) }
}
