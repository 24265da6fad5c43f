//! Forces. Each is one `.wgsl` and one `.rs` of the same name, and one line in the register below.

mod custom;
mod ewald;
mod kind;
mod misnamed;

pub use custom::{Custom, scalar};
use kind::{Kind, SPECIES, species};
use misnamed::Misnamed;

pub use crate::component::{Component, Entry, Projection, Properties, Resolved, Role, Stage, evaluate, numbered};
pub use crate::kernel::Problem;
use crate::kernel::Scalar;
use crate::settings::{Key, Settings, Value};
pub use crate::visit::{Distant, Jacobian, Law, Over, Particle};

macro_rules! register {
    ($($role:ident $module:ident: $type:ident, $about:literal;)*) => {
        $(mod $module; pub use $module::$type;)*
        /// All forces that a scene may name.
        pub const FORCES: &[Entry] = &[$(Entry {
            name: stringify!($module),
            about: $about,
            keys: $module::KEYS,
            role: Role::$role,
            build: |settings| match settings.fault($module::KEYS) {
                Some(fault) => Box::new(Misnamed(format!("the force `{}` {fault}", stringify!($module)))),
                None => Box::new($type::new(settings)),
            },
        }),*];
    };
}

register! {
    Interaction gravity: Gravity, "all particles attract each other, softened (Newton 1687)";
    Interaction uniform: Uniform, "the same acceleration everywhere: weight";
    Interaction drag: Drag, "linear and quadratic resistance of a medium that may move (Stokes 1851, Newton 1687)";
    Interaction wind: Wind, "a wind that blows in gusts and carries particles along";
    Interaction vortex: Vortex, "a whirl about an axis that carries particles along (Kaufmann 1962)";
    Interaction attractor: Attractor, "a fixed or moving centre: point mass, spring or logarithmic halo";
    Interaction boids: Boids, "a flock: separation, alignment and cohesion within a field of view (Reynolds 1987, 1999)";
    Constraint speed_limit: SpeedLimit, "the least and the greatest speed of a species";
    Interaction obstacle: Obstacle, "a sphere, a box or a plane that is seen ahead and avoided (after Reynolds 1999)";
    Constraint solid: Solid, "a sphere, a box, a plane or a capsule that lets no particle in, or out: bounces and friction";
    Interaction flee: Flee, "prey flee from predators";
    Interaction chase: Chase, "predators chase prey";
    Interaction goal: Goal, "a place to steer to and arrive at, or a roost to keep to (Reynolds 1999)";
    Interaction wander: Wander, "a random walk of velocities, the same numbers on every device";
    Interaction soft_turn: SoftTurn, "a box with soft walls that turn back";
    Constraint rod: Rod, "rigid rods in chains keep their lengths, whatever the other forces do (RATTLE: Andersen 1983)";
    Interaction vicsek: Vicsek, "each particle takes the mean heading around it, with noise, in the plane (Vicsek et al. 1995)";
    Interaction spring: Spring, "springs and ropes, damped along themselves (Hooke 1678)";
    Constraint strain_limit: StrainLimit, "springs that are not stretched farther than so much (Provot 1995)";
    Updater tear: Tear, "springs that are stretched too far break, for ever";
    Interaction joint: Joint, "joints that resist bending: elastic rods, hair (Euler 1744)";
    Interaction fluid: Fluid, "a fluid by smoothed particle hydrodynamics, weakly compressible (Monaghan 1994); held particles are its walls";
    Interaction air: Air, "drag and lift on every triangle of a cloth, in gusts (Ling, Damodaran & Gay 1996)";
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

/// Which pairs are evaluated, where a force has a cut-off radius; `of` is the species of the neighbours.
fn over(settings: &Settings, of: Option<u32>) -> Over {
    let range = settings.number("range");
    let skin = Some(settings.number("skin")).filter(|skin| *skin > 0.0);
    match settings.text("over") {
        "within" => Over::Within { range },
        "list" => Over::List { range, skin, slots: 0 },
        _ => Over::Near { range, of },
    }
}

const SEE_NEAR: Key = Key::new(
    "over",
    crate::settings::Kind::Choice(&["near", "list", "within"]),
    Value::Text(std::borrow::Cow::Borrowed("near")),
    "which neighbours: all in range, by a cell list, by a list that is kept over steps, or by brute force",
);

const SKIN: Key = Key::new(
    "skin",
    crate::settings::Kind::NotNegative,
    Value::Number(0.0),
    "over = \"list\": how much farther than the range the list reaches; 0: a fifth of the range [length]",
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
    "what is evaluated: each particle alone",
);
