//! Updaters, written from the register.

use std::borrow::Cow;

use super::{Field, typed};
use crate::settings::Settings;

typed! {
    force;
    /// A thermostat: all particles at a given mean temperature, by one variable of the system (Nosé 1984, Hoover 1985).
    NoseHoover "nose_hoover" nose_hoover(temperature: f64) {
        /// K T, twice the mean kinetic energy of a degree of freedom \[energy\].
        temperature: f64,
        /// τ, the relaxation time of the thermostat; some periods of the fastest motion \[time\].
        time: f64,
        /// Constrained degrees of freedom: as many as dimensions where forces conserve the total momentum, and it is 0.
        removed: u64,
        /// Variables of the system, each of which regulates the one before it; 1: the thermostat of Nosé and Hoover alone.
        chain: u32,
    }
    /// A heat bath with friction and noise on every particle (Langevin 1908, Bussi & Parrinello 2007).
    Langevin "langevin" langevin(temperature: f64) {
        /// K T, twice the mean kinetic energy of a degree of freedom \[energy\].
        temperature: f64,
        /// γ, the rate at which velocities are forgotten \[1 / time\].
        friction: f64,
        /// Seed of the random numbers, counted by id and step.
        seed: u64,
    }
    /// A heat bath with which particles collide at random (Andersen 1980).
    Andersen "andersen" andersen(temperature: f64) {
        /// K T, twice the mean kinetic energy of a degree of freedom \[energy\].
        temperature: f64,
        /// ν, the rate of collisions of a particle with the bath \[1 / time\].
        rate: f64,
        /// Seed of the random numbers, counted by id and step.
        seed: u64,
    }
    /// The temperature relaxes to a given one; for equilibration only (Berendsen et al. 1984).
    Berendsen "berendsen" berendsen(temperature: f64) {
        /// K T, twice the mean kinetic energy of a degree of freedom \[energy\].
        temperature: f64,
        /// τ, the relaxation time of the temperature \[time\].
        time: f64,
        /// Constrained degrees of freedom: as many as dimensions where forces conserve the total momentum, and it is 0.
        removed: u64,
    }
    /// A thermostat: the kinetic energy relaxes and fluctuates as it does in a heat bath, by one random factor for all velocities (Bussi, Donadio & Parrinello 2007).
    Csvr "csvr" csvr(temperature: f64) {
        /// K T, twice the mean kinetic energy of a degree of freedom \[energy\].
        temperature: f64,
        /// τ, the relaxation time of the kinetic energy \[time\].
        time: f64,
        /// Whether the motion of the centre of mass is heat; say false where forces conserve the total momentum, and it is 0.
        drift: bool,
        /// Seed of the random numbers, counted by id and step.
        seed: u64,
    }
    /// A barostat: the pressure relaxes to a given one; for equilibration only (Berendsen et al. 1984).
    BerendsenPressure "berendsen_pressure" berendsen_pressure(pressure: f64, compressibility: f64) {
        /// P₀, that of the measure `pressure` \[mass / length / time²; mass / time² in the plane\].
        pressure: f64,
        /// κ, an estimate of −(∂V / ∂P) / V: only κ / τ matters \[length · time² / mass; time² / mass in the plane\].
        compressibility: f64,
        /// τ, the relaxation time of the pressure, if the compressibility is right \[time\].
        time: f64,
        /// The number of steps from one change of the box to the next: each measures the pressure, which takes as long as the forces.
        every: u32,
    }
    /// A barostat: the volume of the box relaxes and fluctuates as it does at a given pressure (Bernetti & Bussi 2020).
    CellRescaling "cell_rescaling" cell_rescaling(pressure: f64, temperature: f64, compressibility: f64) {
        /// P₀, that of the measure `pressure` \[mass / length / time²; mass / time² in the plane\].
        pressure: f64,
        /// K T, twice the mean kinetic energy of a degree of freedom \[energy\].
        temperature: f64,
        /// κ, an estimate of −(∂V / ∂P) / V: only κ / τ matters \[length · time² / mass; time² / mass in the plane\].
        compressibility: f64,
        /// τ, the relaxation time of the pressure, if the compressibility is right \[time\].
        time: f64,
        /// The number of steps from one change of the box to the next: each measures the pressure, which takes as long as the forces.
        every: u32,
        /// Seed of the random numbers, counted by id and step.
        seed: u64,
    }
    /// Particles move to a minimum of the potential energy and rest there: FIRE (Bitzek et al. 2006).
    Minimize "minimize" minimize(tolerance: f64, largest_move: f64) {
        /// The largest force on a particle at which all rest \[force\].
        tolerance: f64,
        /// The longest way of a particle in a step, such as a tenth of a diameter \[length\].
        largest_move: f64,
        /// The longest step, in units of dt.
        longest: f64,
    }
    /// Bodies that touch merge, or bounce.
    Collide "collide" collide() {
        /// What becomes of two bodies that collide: one body, or two that part: merge, bounce.
        outcome: Cow<'static, str>,
        /// Outcome = "bounce": the speed at which they part, over that at which they approach, 1 at most: no energy is lost; 0: they keep no speed along their line of centres.
        restitution: f64,
        /// How collisions are found: among all pairs, or by a cell list, among those in `range`: pairs, near.
        over: Cow<'static, str>,
        /// Over = "near": the largest distance of the centres of bodies that touch; it must be given, and no radius may exceed half of it \[length\].
        range: f64,
    }
    /// Springs that are stretched too far break permanently.
    Tear "tear" tear() {
        /// The strain at which a spring breaks: its extension over its rest length.
        strain: f64,
        /// What breaks: springs and ropes.
        over: Cow<'static, str>,
    }
}
