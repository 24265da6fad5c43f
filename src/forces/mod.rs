//! Forces. Each is one `.wgsl` and one `.rs` of the same name, and one line in the register below.

mod custom;
mod ewald;
mod kind;

pub use custom::{Custom, scalar};
use kind::{Kind, SPECIES, species};

use crate::error::Error;
use crate::fluids::{Continuum, Rates};
pub use crate::kernel::Problem;
use crate::kernel::{Column, Plan, Scalar};
use crate::neighbors::Grid;
use crate::settings::{Key, Settings, Value};
use crate::solids::Standing;
pub use crate::visit::{Distant, Jacobian, Law, Over, Particle};

/// What pushes particles.
pub trait Force: Send + Sync {
    /// How far one looks for company \[length\], and of which species, if not of all: where a force says so, runs are
    /// measured for order and clusters.
    fn company(&self) -> Option<(f64, Option<u32>)> {
        None
    }
    /// The columns that it reads or writes beside those of all simulations.
    fn columns(&self) -> Vec<Column> {
        Vec::new()
    }
    /// Its laws, in the order in which they are visited; a later one may read what an earlier one wrote.
    fn laws(&self) -> Vec<Law>;

    /// The grids that it searches, and whether it asks there for velocities.
    ///
    /// # Errors
    /// [`Error::Scene`] when a range is none.
    fn grids(&self, problem: &Problem) -> Result<Vec<(Grid, bool)>, Error> {
        let grids = self.laws().into_iter().map(|law| law.grid(problem));
        grids.filter_map(Result::transpose).collect()
    }
    /// Adds kernels that run once, before the first step, when held particles are where they belong.
    ///
    /// # Errors
    /// When it makes no sense there.
    fn begin(&self, _plan: &mut Plan, _problem: &Problem) -> Result<(), Error> {
        Ok(())
    }
    /// Adds its kernels to a plan; `earlier` counts the forces of its kind before it in the scene. A force that no visit
    /// can express (a mesh, a Fourier transform) writes its own.
    ///
    /// # Errors
    /// When a law does not compile or lacks a parameter.
    fn evaluate(&self, plan: &mut Plan, earlier: usize, problem: &Problem) -> Result<(), Error> {
        for law in self.laws() {
            let name = if earlier == 0 { law.name.clone() } else { format!("{} {}", law.name, earlier + 1) };
            plan.push(&name, || law.kernel(problem))?;
        }
        Ok(())
    }
    /// Adds kernels that keep velocities lawful: speeds within limits. They run after every kick, and at the end of a
    /// Runge–Kutta step.
    ///
    /// # Errors
    /// When the limits make no sense.
    fn limit(&self, _plan: &mut Plan, _problem: &Problem) -> Result<(), Error> {
        Ok(())
    }
    /// The solid that pictures show for it, if any.
    fn standing(&self) -> Option<Standing> {
        None
    }
    /// Adds kernels that keep positions lawful: nobody inside of a solid. They run after every drift, by `factor` of the
    /// step.
    ///
    /// # Errors
    /// When there is no such place.
    fn confine(&self, _plan: &mut Plan, _problem: &Problem, _factor: f64) -> Result<(), Error> {
        Ok(())
    }
    /// The same after a part of the step that was no drift, as that of a Runge–Kutta or an implicit method: x − c v dt need not
    /// be where it began.
    ///
    /// # Errors
    /// When there is no such place.
    fn settle(&self, plan: &mut Plan, problem: &Problem, factor: f64) -> Result<(), Error> {
        self.confine(plan, problem, factor)
    }
    /// Adds kernels that run once at the end of each step: what breaks, breaks there.
    ///
    /// # Errors
    /// When it cannot.
    fn conclude(&self, _plan: &mut Plan, _problem: &Problem) -> Result<(), Error> {
        Ok(())
    }
    /// Whether who has no mass is met by nobody: then those who do not live may stand among those whom it meets.
    fn goes_by_mass(&self) -> bool {
        false
    }
    /// Adds kernels that say how many steps each particle would have in a longest one, were it alone: they fill
    /// [`URGES`](crate::kernel::URGES), from accelerations, positions and velocities at the end of a step. It gives the
    /// same of what is alike for everybody, as viscosity is; nothing where it does not know.
    ///
    /// # Errors
    /// When a limit makes no sense.
    fn paces(&self, _plan: &mut Plan, _problem: &Problem) -> Result<Option<f64>, Error> {
        Ok(None)
    }
    /// Why it must have steps that are all alike, if it must.
    fn keeps_to_even_steps(&self) -> Option<&'static str> {
        None
    }
    /// Whether links change as it acts.
    fn breaks(&self) -> bool {
        false
    }
    /// Whether it answers to what all others say: it is evaluated after them, wherever the scene names it.
    fn answers(&self) -> bool {
        false
    }
    /// What one should know of it before it runs in steps of `dt`.
    fn remark(&self, _dt: f64) -> Option<String> {
        None
    }
    /// Whether rods keep their lengths by it.
    fn keeps_rods(&self) -> bool {
        false
    }
    /// The fluid that it makes of everybody who is not held, if any.
    ///
    /// # Errors
    /// [`Error::Scene`] when there is no such fluid.
    fn fluid(&self, _problem: &Problem) -> Result<Option<Continuum>, Error> {
        Ok(None)
    }
    /// What it does not keep, beside what its laws tell; among the held, or where nobody is.
    fn takes(&self, _held: bool) -> Takes {
        Takes::default()
    }
    /// How fast the fluid that it makes swings and creeps, at most, if it makes one.
    ///
    /// # Errors
    /// [`Error::Scene`] when there is no such fluid.
    fn rates(&self, _problem: &Problem) -> Result<Option<Rates>, Error> {
        Ok(None)
    }
    /// Where it puts one of a species who stands somewhere before the first step, if there are places where it lets nobody be.
    ///
    /// # Errors
    /// When there is no such place.
    fn keeper(&self, _problem: &Problem) -> Result<Option<Keeper>, Error> {
        Ok(None)
    }
    /// The integrators under which it is what its paper says; none: under all.
    fn integrators(&self) -> &'static [&'static str] {
        &[]
    }
}

/// What a force takes, or gives, that none of its laws tells of.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Takes {
    /// What of it changes the energy that is measured, in a word or two each.
    pub energy: Vec<&'static str>,
    /// Whether it changes the angular momentum.
    pub angular_momentum: bool,
}

/// Where one of a species belongs who stands somewhere.
pub type Keeper = Box<dyn Fn(u32, glam::DVec3) -> glam::DVec3 + Send + Sync>;

/// A line of the register.
pub struct Entry {
    /// The scene's word for it.
    pub name: &'static str,
    /// One line for a list.
    pub about: &'static str,
    /// What a scene may say to it.
    pub keys: &'static [Key],
    /// Makes one, from checked settings.
    pub build: fn(&Settings) -> Box<dyn Force>,
}

macro_rules! register {
    ($($module:ident: $type:ident, $about:literal;)*) => {
        $(mod $module; pub use $module::$type;)*
        /// All forces that a scene may name.
        pub const FORCES: &[Entry] = &[$(Entry {
            name: stringify!($module),
            about: $about,
            keys: $module::KEYS,
            build: |settings| Box::new($type::new(settings)),
        }),*];
    };
}

register! {
    gravity: Gravity, "everybody attracts everybody, softened (Newton 1687)";
    uniform: Uniform, "the same acceleration everywhere: weight";
    drag: Drag, "linear and quadratic resistance of a medium that may move (Stokes 1851, Newton 1687)";
    wind: Wind, "a wind that blows in gusts and carries particles along";
    vortex: Vortex, "a whirl about an axis that carries particles along (Kaufmann 1962)";
    attractor: Attractor, "a fixed or moving centre: point mass, spring or logarithmic halo";
    boids: Boids, "a flock: separation, alignment and cohesion within a field of view (Reynolds 1987, 1999)";
    speed_limit: SpeedLimit, "the least and the greatest speed of a species";
    obstacle: Obstacle, "a sphere, a box or a plane that is seen ahead and avoided (after Reynolds 1999)";
    solid: Solid, "a sphere, a box, a plane or a capsule that lets nobody in, or out: bounces and friction";
    flee: Flee, "prey flee from predators";
    chase: Chase, "predators chase prey";
    goal: Goal, "a place to steer to and arrive at, or a roost to keep to (Reynolds 1999)";
    wander: Wander, "a random walk of velocities, the same numbers on every device";
    soft_turn: SoftTurn, "a box with soft walls that turn back";
    rod: Rod, "rigid rods in chains keep their lengths, whatever the other forces do (RATTLE: Andersen 1983)";
    vicsek: Vicsek, "everybody takes the mean heading around it, with noise, in the plane (Vicsek et al. 1995)";
    spring: Spring, "springs and ropes, damped along themselves (Hooke 1678)";
    strain_limit: StrainLimit, "springs that are not stretched farther than so much (Provot 1995)";
    tear: Tear, "springs that are stretched too far break, for ever";
    joint: Joint, "joints that resist bending: elastic rods, hair (Euler 1744)";
    fluid: Fluid, "a fluid by smoothed particle hydrodynamics, weakly compressible (Monaghan 1994); who is held is its wall";
    air: Air, "drag and lift on every triangle of a cloth, in gusts (Ling, Damodaran & Gay 1996)";
}

/// The force of a scene's word.
#[must_use]
pub fn entry(name: &str) -> Option<&'static Entry> {
    FORCES.iter().find(|e| e.name == name)
}

/// The settings that a shader's `Params` has by the same names.
fn params(settings: &Settings, names: &[&str]) -> Vec<(String, Scalar)> {
    let scalar = |name: &&str| {
        let value = match settings.0.get(*name) {
            Some(Value::Vector(v)) => Scalar::Vector(*v),
            _ => Scalar::Float(settings.number(name)),
        };
        ((*name).to_owned(), value)
    };
    names.iter().map(scalar).collect()
}

/// Who meets whom, where a force looks within a range; `of` are those whom it looks for.
fn over(settings: &Settings, of: Option<u32>) -> Over {
    let range = settings.number("range");
    if settings.text("over") == "within" { Over::Within { range } } else { Over::Near { range, of } }
}

const SEE_NEAR: Key = Key::new(
    "over",
    crate::settings::Kind::Choice(&["near", "within"]),
    Value::Text(std::borrow::Cow::Borrowed("near")),
    "who meets whom: everybody in range, by a grid or by force",
);

const SEED: Key = Key::new(
    "seed",
    crate::settings::Kind::Whole,
    Value::Number(1.0),
    "seed of the random numbers, counted by id and step",
);

/// The words of the seed, as shaders know them.
fn seed(settings: &Settings) -> [(String, Scalar); 2] {
    let [low, high] = crate::visit::random::words(settings.whole("seed"));
    [("seed_low".to_owned(), Scalar::Uint(low)), ("seed_high".to_owned(), Scalar::Uint(high))]
}

/// Whether r is shorter than a range, by the device's own arithmetic.
fn is_nearer(r: glam::DVec3, range: f64) -> bool {
    #[expect(clippy::cast_possible_truncation, reason = "as the device holds it")]
    let (r, range) = (r.as_vec3(), range as f32);
    r.length_squared() < range * range
}

const EACH: Key = Key::new(
    "over",
    crate::settings::Kind::Choice(&["each"]),
    Value::Text(std::borrow::Cow::Borrowed("each")),
    "who meets whom: each particle alone",
);
