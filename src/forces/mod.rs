//! Forces. Each is one `.wgsl` and one `.rs` of the same name, and one line in the register below.

mod custom;

pub use custom::Custom;

use crate::error::Error;
pub use crate::kernel::Problem;
use crate::kernel::{Plan, Scalar};
use crate::settings::{Key, Settings, Value};
pub use crate::visit::{Body, Law, Over};

/// What pushes particles.
pub trait Force: Send + Sync {
    /// Its laws, in the order in which they are visited; a later one may read what an earlier one wrote.
    fn laws(&self) -> Vec<Law>;

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
}

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

const EACH: Key = Key::new(
    "over",
    crate::settings::Kind::Choice(&["each"]),
    Value::Text(std::borrow::Cow::Borrowed("each")),
    "who meets whom: each particle alone",
);
