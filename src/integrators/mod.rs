//! Integrators. Each is written in verbs (kick, drift, evaluate) and reads like its formula in a textbook.

mod adaptive;
mod block_leapfrog;
mod precision;
mod step;
mod verbs;

pub use adaptive::Adaptive;
pub use block_leapfrog::BlockLeapfrog;
pub use precision::Precise;
pub(crate) use precision::check as check_precision;
pub(crate) use step::kept_rates;
#[doc(hidden)]
pub use step::{Explicit, Form, Implicit, Step, implicit};
#[doc(hidden)]
pub use verbs::radau::{STEP as RADAU_STEP, STEP_WORDS as RADAU_STEP_WORDS};
#[doc(hidden)]
pub use verbs::solve::STATE as SOLVE_STATE;
#[doc(hidden)]
pub use verbs::solve::report::{NAME as SOLVE_REPORT, WORDS as SOLVE_REPORT_WORDS};

use crate::kernel::{AdaptiveStep, BlockSteps, Column, Precision};
use crate::settings::{Key, Settings};

/// A method that advances particles by one step.
pub trait Integrator: Copied + Send + Sync {
    /// The method that it wraps, if it is a way of using another one: what it does not say itself is answered by that.
    fn wrapped(&self) -> Option<&dyn Integrator> {
        None
    }
    /// Its name in messages: that of scenes, if it has one.
    fn name(&self) -> &'static str {
        self.wrapped().map_or("the integrator", Integrator::name)
    }
    /// The order of convergence, for forces that depend on position and time alone.
    fn order(&self) -> u32;
    /// The order when a force depends on velocity too: 1 for symplectic integrators, whose kicks use the current velocity.
    fn order_with_velocity(&self) -> u32 {
        self.wrapped().map_or(1, Integrator::order_with_velocity)
    }
    /// Whether it solves implicitly for laws with a Jacobian.
    fn is_implicit(&self) -> bool {
        self.wrapped().is_some_and(Integrator::is_implicit)
    }
    /// Whether it is symplectic with a fixed step: the energy error stays bounded.
    fn is_symplectic(&self) -> bool {
        self.wrapped().is_some_and(Integrator::is_symplectic)
    }
    /// Whether it damps fast modes at any step size.
    fn damps_at_any_step(&self) -> bool {
        self.wrapped().is_some_and(Integrator::damps_at_any_step)
    }
    /// The reason for requiring a fixed time step, if it does.
    fn fixed_step(&self) -> Option<&'static str> {
        match self.wrapped() {
            Some(method) => method.fixed_step(),
            None => self
                .is_implicit()
                .then_some("their time step limits are those of explicit methods, and the integrator is implicit"),
        }
    }
    /// Whether it estimates its own error, which limits adaptive steps in place of forces.
    fn estimates_error(&self) -> bool {
        self.wrapped().is_some_and(Integrator::estimates_error)
    }
    /// Whether it advances columns that components declare with a rate, beside positions and velocities.
    fn advances_columns(&self) -> bool {
        self.wrapped().is_none_or(Integrator::advances_columns)
    }
    /// The limits of its time step, where steps are adaptive.
    fn adaptive_step(&self) -> Option<AdaptiveStep> {
        self.wrapped().and_then(Integrator::adaptive_step)
    }
    /// Its block time steps, where particles have steps of their own.
    fn block_steps(&self) -> Option<BlockSteps> {
        self.wrapped().and_then(Integrator::block_steps)
    }
    /// The same method with a fixed step.
    fn in_fixed_steps(&self) -> Box<dyn Integrator> {
        self.copied()
    }
    /// Whether forces at the end of a step are those of the positions there.
    fn ends_with_forces(&self) -> bool {
        self.wrapped().is_some_and(Integrator::ends_with_forces)
    }
    /// The precision in which it keeps positions and velocities.
    fn precision(&self) -> Precision {
        self.wrapped().map_or(Precision::Single, Integrator::precision)
    }
    /// The columns that it needs in addition to those of all simulations: the data that a step passes to the next.
    fn columns(&self) -> Vec<Column> {
        self.wrapped().map_or_else(Vec::new, Integrator::columns)
    }
    /// Adds the kernels that run once, before the first step.
    fn start(&self, step: &mut Step) {
        if let Some(method) = self.wrapped() {
            method.start(step);
        }
    }
    /// One step.
    fn step(&self, step: &mut Step);
}

#[doc(hidden)]
/// Copying of a boxed integrator; implemented for everything that is `Clone`.
pub trait Copied {
    /// The copy.
    fn copied(&self) -> Box<dyn Integrator>;
}

impl<T: Integrator + Clone + 'static> Copied for T {
    fn copied(&self) -> Box<dyn Integrator> {
        Box::new(self.clone())
    }
}

impl Clone for Box<dyn Integrator> {
    fn clone(&self) -> Self {
        (**self).copied()
    }
}

#[doc(hidden)]
/// A line of the register.
pub struct Entry {
    /// Its name in scenes.
    pub name: &'static str,
    /// One line for a list.
    pub about: &'static str,
    /// Its settings, in `[simulation]`.
    pub keys: &'static [Key],
    /// Builds one, from checked settings of these keys.
    pub build: fn(&Settings) -> Box<dyn Integrator>,
}

impl Entry {
    /// Builds one with the defaults of its keys.
    #[must_use]
    pub fn by_default(&self) -> Box<dyn Integrator> {
        (self.build)(&Settings::defaults(self.keys))
    }
}

macro_rules! register {
    ($($module:ident: $type:ident $(($keys:ident))?, $about:literal;)*) => {
        $(mod $module; pub use $module::$type;)*
        /// All integrators, in the order of their cost.
        #[doc(hidden)]
        pub const INTEGRATORS: &[Entry] = &[$(Entry {
            name: stringify!($module),
            about: $about,
            keys: register!(@keys $module $($keys)?),
            build: register!(@build $module $type $($keys)?),
        }),*];
    };
    (@keys $module:ident) => { &[] };
    (@keys $module:ident $keys:ident) => { $module::$keys };
    (@build $module:ident $type:ident) => { |_| Box::new($type) };
    (@build $module:ident $type:ident $keys:ident) => { |settings| Box::new($module::$type::new(settings)) };
}

register! {
    forward_euler: ForwardEuler, "order 1, gains energy: for comparison only";
    symplectic_euler: SymplecticEuler, "order 1, symplectic: the energy error stays bounded";
    leapfrog: Leapfrog, "order 2, symplectic, one evaluation per step: the default";
    beeman: Beeman, "order 2, the positions of leapfrog with more accurate velocities: molecular dynamics (Beeman 1976)";
    midpoint: Midpoint, "order 2 (Runge-Kutta), for forces that depend on velocity";
    heun: Heun, "order 2 (Runge-Kutta, trapezoid rule), for forces that depend on velocity";
    rk4: RungeKutta4, "order 4 (Runge-Kutta), four evaluations: accurate over short times";
    forest_ruth: ForestRuth, "order 4, symplectic, three evaluations";
    pefrl: Pefrl, "order 4, symplectic, four evaluations: the most accurate over long times";
    gauss_radau: GaussRadau(KEYS), "order 15, some 30 evaluations per step, adaptive by its own error: few bodies, close encounters (Everhart 1985; Rein & Spiegel 2015)";
    linear_backward_euler: LinearBackwardEuler, "order 1, for stiff springs: damped at any step, by one linear solve (Baraff & Witkin 1998)";
    backward_euler: BackwardEuler, "order 1, for stiff springs: damped at any step, its equations solved by Newton's method";
    linear_trapezoid: LinearTrapezoid, "order 2, for stiff springs: conserves the energy of linear springs, by one linear solve";
    trapezoid: Trapezoid, "order 2, for stiff springs: conserves the energy of linear springs, by Newton's method";
    linear_implicit_midpoint: LinearImplicitMidpoint, "order 2, for stiff springs: conserves the energy of linear springs, by one linear solve";
    implicit_midpoint: ImplicitMidpoint, "order 2, symplectic, for stiff springs: its equations solved by Newton's method";
}

#[doc(hidden)]
/// The integrator of a name in scenes.
#[must_use]
pub fn entry(name: &str) -> Option<&'static Entry> {
    INTEGRATORS.iter().find(|e| e.name == name)
}
