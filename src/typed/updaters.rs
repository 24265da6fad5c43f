//! Updaters, written from the register.

use std::borrow::Cow;

use super::{Field, typed};
use crate::settings::Settings;

typed! {
    force;
    /// A thermostat: all particles at a temperature on average, by one variable of the system (Nosé 1984, Hoover 1985).
    NoseHoover "nose_hoover" nose_hoover(temperature: f64) {
        /// K T, what twice the kinetic energy of a degree of freedom is on average \[energy\].
        temperature: f64,
        /// τ, over which the temperature is regulated; some periods of the fastest motion \[time\].
        time: f64,
        /// Degrees of freedom that are none: 3 where forces keep the total momentum, and it is 0.
        removed: u64,
    }
    /// Springs that are stretched too far break, for ever.
    Tear "tear" tear() {
        /// How much longer than at rest it gets before it breaks, as a part of that.
        strain: f64,
        /// What breaks: springs and ropes.
        over: Cow<'static, str>,
    }
}
