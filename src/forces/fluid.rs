//! A fluid, weakly compressible.

use std::borrow::Cow;

use super::{Force, Law, Problem};
use crate::error::Error;
use crate::fluids::{self, Asked, Dfsph, Friction, Medium, Smoothing};
use crate::kernel::Plan;
use crate::neighbors::Grid;
use crate::settings::{Key, Kind, Settings, Value};

/// What a scene may say.
pub const KEYS: &[Key] = &[
    Key::new("density", Kind::Positive, Value::Number(1000.0), "the density at rest [mass / length³, or mass / length² in two dimensions]"),
    Key::required("spacing", Kind::Positive, "how far apart particles are at rest, on a cubic lattice [length]"),
    Key::new("support", Kind::Positive, Value::Number(2.0), "how far the kernel reaches [spacings]"),
    Key::new("kernel", Kind::Choice(Smoothing::NAMES), Value::Text(Cow::Borrowed("cubic")), "what smooths: the cubic spline, or Wendland's C2"),
    Key::new("solver", Kind::Choice(&["wcsph", "dfsph"]), Value::Text(Cow::Borrowed("wcsph")), "pressure by an equation of state, or solved for (Bender & Koschier 2015)"),
    Key::new("sound_speed", Kind::NotNegative, Value::Number(0.0), "wcsph: the speed of sound: ten times the fastest flow makes the density vary by 1 % [length / time]"),
    Key::new("gamma", Kind::Count, Value::Number(7.0), "the exponent of Tait's equation p = (ρ₀ c² / γ) ((ρ/ρ₀)^γ − 1), 2 to 15"),
    Key::new("negative_pressure", Kind::Flag, Value::Flag(false), "whether pressure may be below 0: where there is no free surface"),
    Key::new("alpha", Kind::NotNegative, Value::Number(0.0), "the artificial viscosity α (Monaghan 1992)"),
    Key::new("viscosity", Kind::NotNegative, Value::Number(0.0), "the kinematic viscosity ν (Morris, Fox & Zhu 1997) [length² / time]"),
    Key::new("wall_friction", Kind::NotNegative, Value::Number(1.0), "how much of both viscosities walls have; 0 lets slip"),
    Key::new("tolerance", Kind::Positive, Value::Number(1e-4), "dfsph: the mean error of the density that is left [parts of the density]"),
    Key::new("divergence_tolerance", Kind::Positive, Value::Number(1e-3), "dfsph: what the velocity may compress by in a step, in the mean [parts of the density]"),
    Key::new("min_iterations", Kind::Count, Value::Number(2.0), "dfsph: the fewest iterations of a solve"),
    Key::new("max_iterations", Kind::Count, Value::Number(50.0), "dfsph: the most iterations of a solve"),
];

/// How far a particle may go in a step where pressure is solved for, in spacings (Courant, Friedrichs & Lewy 1928; 0.4 as Bender &
/// Koschier 2015 have it).
const COURANT: f64 = 0.4;

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
        let solves = self.solves();
        if !solves && number("sound_speed") == 0.0 {
            return Err(Error::Scene(
                "a fluid has no sound_speed: give ten times the speed of the fastest flow, or solver = \"dfsph\", which needs none"
                    .to_owned(),
            ));
        }
        Ok(Medium {
            density: number("density"),
            spacing: number("spacing"),
            support,
            smoothing: Smoothing::named(self.0.text("kernel")),
            sound: if solves { 0.0 } else { number("sound_speed") },
            exponent,
            negative: self.0.flag("negative_pressure"),
            dimensions: problem.bounds.dimensions,
        })
    }
    /// Whether its pressure is solved for.
    fn solves(&self) -> bool {
        self.0.text("solver") == "dfsph"
    }
    fn dfsph<'a>(&self, medium: Medium, problem: &'a Problem) -> Result<Dfsph<'a>, Error> {
        let number = |name| self.0.number(name);
        let count = |name| u32::try_from(self.0.whole(name)).unwrap_or(u32::MAX);
        let asked = Asked {
            density: number("tolerance"),
            divergence: number("divergence_tolerance"),
            least: count("min_iterations"),
            most: count("max_iterations"),
        };
        Dfsph::new(medium, asked, problem)
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
    fn evaluate(&self, plan: &mut Plan, _: usize, problem: &Problem) -> Result<(), Error> {
        let medium = self.medium(problem)?;
        let friction = self.friction();
        // Where pressure is solved for, sound and with it this pressure are none: friction is left.
        if !self.solves() || friction.viscosity > 0.0 {
            plan.add(fluids::density(&medium, problem)?);
            plan.add(fluids::state(&medium, problem)?);
            plan.add(fluids::pressure(&medium, friction, problem)?);
        }
        if self.solves() {
            self.dfsph(medium, problem)?.evaluate(plan)?;
        }
        Ok(())
    }
    fn conclude(&self, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
        if self.solves() {
            self.dfsph(self.medium(problem)?, problem)?.conclude(plan)?;
        }
        Ok(())
    }
    fn remark(&self, dt: f64) -> Option<String> {
        let speed = COURANT * self.0.number("spacing") / dt;
        let alpha = if self.0.number("alpha") > 0.0 {
            "; alpha goes with the speed of sound, which is none where pressure is solved for: give viscosity instead"
        } else {
            ""
        };
        self.solves().then(|| {
            format!("the fluid's dt = {dt} is for speeds up to {speed:.3}: in a step nobody should go farther than {COURANT} spacings{alpha}")
        })
    }
    fn answers(&self) -> bool {
        self.solves()
    }
    fn integrators(&self) -> &'static [&'static str] {
        if self.solves() { &["symplectic_euler"] } else { &[] }
    }
}
