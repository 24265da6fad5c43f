//! Validation of fluids and of the boxes that hold them.

use super::Medium;
use crate::error::Error;
use crate::kernel::Bounds;

impl Medium {
    /// Refuses what single precision does not hold.
    ///
    /// # Errors
    /// [`Error::Setting`] with the number.
    pub fn check(&self) -> Result<(), Error> {
        let (density, sound) = (self.density, self.sound);
        // By Tait's equation at twice the density.
        let pressure = self.stiffness() * 2f64.powi(i32::try_from(self.exponent).unwrap_or(15));
        let mut numbers = vec![
            ("spacing", "the mass of a particle", self.mass()),
            ("density", "the square of the density", density * density),
            ("spacing", "the slope of the kernel", self.weight() / self.range().powi(2)),
        ];
        if sound > 0.0 {
            numbers.extend([
                ("sound_speed", "the square of sound_speed", sound * sound),
                ("sound_speed", "the pressure at twice the density", pressure),
                ("sound_speed", "the same over the square of the density", pressure / (density * density)),
            ]);
        }
        let single = f64::from(f32::MIN_POSITIVE)..=f64::from(f32::MAX);
        match numbers.into_iter().find(|(.., x)| !single.contains(x)) {
            Some((key, what, x)) => Err(Error::Setting {
                key,
                why: format!(
                    "a fluid has density = {density:e}, spacing = {:e}, sound_speed = {sound:e}: {what} would be {x:.1e}, and single \
                 precision holds 1.2e-38 to 3.4e38: choose other numbers, or other units",
                    self.spacing
                ),
            }),
            None => Ok(()),
        }
    }
    /// Refuses a periodic box in which a particle would be within range of two images of another: only the nearest is evaluated.
    ///
    /// # Errors
    /// [`Error::Setting`] with the period.
    pub fn fits(&self, bounds: &Bounds) -> Result<(), Error> {
        let (period, range) = (bounds.period(), self.range());
        // A box of as many spacings may be a rounding narrower.
        let narrow = |axis: &usize| period[*axis] > 0.0 && period[*axis] < 2.0 * range * (1.0 - 1e-9);
        match (0..3).find(narrow) {
            Some(axis) => Err(Error::Setting {
                key: "support",
                why: format!(
                    "the box is periodic along {} with a period of {}, and a fluid with support = {} reaches {range}: two images of one \
                 would be in reach, of which one counts; make the box at least {} wide, or the reach shorter",
                    ["x", "y", "z"][axis],
                    period[axis],
                    self.support,
                    2.0 * range
                ),
            }),
            None => Ok(()),
        }
    }
}
