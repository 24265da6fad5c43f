//! A fluid, weakly compressible.

use std::borrow::Cow;

use super::{Force, Law, Problem};
use crate::error::Error;
use crate::fluids::{self, Friction, Limits, Medium, Smoothing};
use crate::kernel::Plan;
use crate::neighbors::Grid;
use crate::settings::{Key, Kind, Settings, Value};

/// What a scene may say.
pub const KEYS: &[Key] = &[
    Key::new("density", Kind::Positive, Value::Number(1000.0), "the density at rest [mass / length³, or mass / length² in two dimensions]"),
    Key::required("spacing", Kind::Positive, "how far apart particles are at rest, on a cubic lattice [length]"),
    Key::new("support", Kind::Positive, Value::Number(2.0), "how far the kernel reaches [spacings]"),
    Key::new("kernel", Kind::Choice(Smoothing::NAMES), Value::Text(Cow::Borrowed("cubic")), "what smooths: the cubic spline, or Wendland's C2"),
    Key::required("sound_speed", Kind::Positive, "the speed of sound: ten times the fastest flow makes the density vary by 1 % [length / time]"),
    Key::new("gamma", Kind::Count, Value::Number(7.0), "the exponent of Tait's equation p = (ρ₀ c² / γ) ((ρ/ρ₀)^γ − 1), 2 to 15"),
    Key::new("negative_pressure", Kind::Flag, Value::Flag(false), "whether pressure may be below 0: where there is no free surface"),
    Key::new("alpha", Kind::NotNegative, Value::Number(0.0), "the artificial viscosity α (Monaghan 1992)"),
    Key::new("viscosity", Kind::NotNegative, Value::Number(0.0), "the kinematic viscosity ν (Morris, Fox & Zhu 1997) [length² / time]"),
    Key::new("wall_friction", Kind::NotNegative, Value::Number(1.0), "how much of both viscosities walls have; 0 lets slip"),
];

/// `fluid`: smoothed particle hydrodynamics with density by summation and Tait's equation of state (Monaghan 1994; Becker &
/// Teschner 2007). Everybody is of the fluid but who is held: those are walls (Akinci et al. 2012).
pub struct Fluid(Settings);

impl Fluid {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone())
    }
    /// What flows, in the box of a problem.
    ///
    /// # Errors
    /// [`Error::Scene`] when there is no such fluid.
    pub fn medium(&self, problem: &Problem) -> Result<Medium, Error> {
        let number = |name| self.0.number(name);
        let exponent = u32::try_from(self.0.whole("gamma")).unwrap_or(u32::MAX);
        if !(2..=15).contains(&exponent) {
            return Err(Error::Scene(format!("a fluid has gamma = {exponent}: Tait's exponent is a whole number from 2 to 15; water has 7")));
        }
        let support = number("support");
        if !(1.5..=6.0).contains(&support) {
            return Err(Error::Scene(format!(
                "a fluid has support = {support} spacings: with less than 1.5 particles do not meet, and more than 6 are hundreds \
                 of neighbours; say 2 to 3"
            )));
        }
        Ok(Medium {
            density: number("density"),
            spacing: number("spacing"),
            support,
            smoothing: Smoothing::named(self.0.text("kernel")),
            sound: number("sound_speed"),
            exponent,
            negative: self.0.flag("negative_pressure"),
            dimensions: problem.bounds.dimensions,
        })
    }
    fn friction(&self) -> Friction {
        let number = |name| self.0.number(name);
        Friction { alpha: number("alpha"), viscosity: number("viscosity"), wall: number("wall_friction") }
    }
}

impl Force for Fluid {
    fn laws(&self) -> Vec<Law> {
        Vec::new()
    }
    fn grids(&self, problem: &Problem) -> Result<Vec<(Grid, bool)>, Error> {
        Ok(vec![(self.medium(problem)?.grid(problem)?, true)])
    }
    fn begin(&self, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
        let medium = self.medium(problem)?;
        if !problem.held.is_empty() {
            plan.add(medium.grid(problem)?.kernel(problem, true)?);
            plan.add(fluids::walls(&medium, problem)?);
        }
        Ok(())
    }
    fn paces(&self, plan: &mut Plan, problem: &Problem) -> Result<Option<f64>, Error> {
        let medium = self.medium(problem)?;
        let limits = Limits { sound: Some(medium.sound), viscosity: self.0.number("viscosity") };
        fluids::limits(&medium, limits, plan, problem)
    }
    fn flows(&self, problem: &Problem) -> Result<Option<Medium>, Error> {
        self.medium(problem).map(Some)
    }
    fn evaluate(&self, plan: &mut Plan, _: usize, problem: &Problem) -> Result<(), Error> {
        let medium = self.medium(problem)?;
        plan.add(fluids::density(&medium, problem)?);
        plan.add(fluids::state(&medium, problem)?);
        plan.add(fluids::pressure(&medium, self.friction(), problem)?);
        Ok(())
    }
}
